#pragma once

#include "couplingStep/couplingSettings.h"

#include <string>
#include <vector>

namespace clepsydra
{

/// A reason why an interval may not be longer.
struct CouplingStepLimit
{
    std::string reason;
    double longest; ///< [s], the same on all ranks
};

/// Length of the coming coupling step, a whole number of DEM steps. With `adjustableCouplingTimeStep yes;` it follows the
/// limits: down at once, up by at most a fifth or one DEM step from one interval to the next. The number of steps is
/// part of checkpoints (uniform/couplingTimeStep), so a resumed run has the intervals of one that was never stopped.
class CouplingStepLength
{
public:
    /// FatalIOError where entries of couplingProperties or controlDict do not go with the DEM step.
    /// \param resumed  goes on with the length that the checkpoint holds, if any
    CouplingStepLength(const CouplingSettings& settings, const Foam::Time& time, double demTimeStep, bool resumed);

    bool isAdjustable() const
    {
        return settings_.adjustableCouplingTimeStep().has_value();
    }

    int steps() const
    {
        return steps_;
    }

    /// [s]
    double seconds() const
    {
        return isAdjustable() ? steps_ * demTimeStep_ : settings_.couplingTimeStep();
    }

    /// Chooses the length of another interval.
    /// \pre isAdjustable()
    /// \param timeLeft  from that interval's start to the next time that must be hit [s], VGREAT for none
    void choose(const std::vector<CouplingStepLimit>& limits, double timeLeft);

    /// Shortens it where that time would not be hit, or only by a much shorter interval afterwards. Does nothing to an
    /// interval that was chosen with the same time left.
    void fitInto(double timeLeft);

private:
    void checkTimes() const;
    void setSteps(int steps);
    /// Shortens it so that intervals of about this length end at that time.
    void divideTimeLeft(double timeLeft);

    const CouplingSettings& settings_;
    const Foam::Time& time_;
    const double demTimeStep_;
    int steps_;
    int fewestSteps_ = 0;
    int mostSteps_ = 0;
    bool warned_ = false;
    /// What checkpoints hold.
    Foam::autoPtr<Foam::IOdictionary> state_;
};

} // namespace clepsydra
