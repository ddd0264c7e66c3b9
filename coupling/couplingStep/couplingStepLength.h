#pragma once

#include "couplingStep/couplingSettings.h"

#include <string>
#include <vector>

namespace clepsydra
{

/// An upper limit of the coupling step and its reason.
struct CouplingStepLimit
{
    std::string reason;
    double longest; ///< [s], the same on all ranks
};

/// Length of the next coupling step, a whole number of DEM steps. With `adjustableCouplingTimeStep yes;` it follows the
/// limits: it falls to them at once and grows by at most a fifth, or one DEM step, per coupling step. The number of DEM
/// steps is part of checkpoints (uniform/couplingTimeStep), so a resumed run has the same coupling steps as an
/// uninterrupted one.
class CouplingStepLength
{
public:
    /// FatalIOError where entries of couplingProperties or controlDict are incompatible with the DEM step.
    /// \param resumed  true to continue with the length in the checkpoint, if it has one
    CouplingStepLength(const CouplingSettings& settings, const Foam::Time& time, double demTimeStep, bool resumed);

    bool isAdjustable() const
    {
        return settings_.adjustableCouplingTimeStep().has_value();
    }

    int steps() const
    {
        return steps_;
    }

    /// Length of the next coupling step [s].
    double seconds() const
    {
        return isAdjustable() ? steps_ * demTimeStep_ : settings_.couplingTimeStep();
    }

    /// Chooses the length of the coupling step after the next one.
    /// \pre isAdjustable()
    /// \param limits  upper limits, at least one
    /// \param timeLeft  from that step's start to the next time that must be hit [s], VGREAT for none
    void choose(const std::vector<CouplingStepLimit>& limits, double timeLeft);

    /// Shortens the coupling step where the given time would not be hit, or only with a much shorter step at the end.
    /// Does not change a length that was chosen with the same time left.
    void fitInto(double timeLeft);

private:
    void checkTimes() const;
    void setSteps(int steps);
    /// Shortens the coupling step so that a whole number of steps of about this length ends at the given time.
    void divideTimeLeft(double timeLeft);

    const CouplingSettings& settings_;
    const Foam::Time& time_;
    const double demTimeStep_;
    int steps_;
    int fewestSteps_ = 0;
    int mostSteps_ = 0;
    bool warned_ = false;
    /// The part of the state that checkpoints hold.
    Foam::autoPtr<Foam::IOdictionary> state_;
};

} // namespace clepsydra
