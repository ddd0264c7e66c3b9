#pragma once

#include "forces/modelType.h"

#include "IOdictionary.H"
#include "Switch.H"
#include "Time.H"
#include "fvMesh.H"

#include <optional>
#include <string>
#include <vector>

namespace clepsydra
{

/// What intervals of changing length keep to: `adjustableCouplingTimeStep yes; maxCo; minCouplingTimeStep; maxCouplingTimeStep`.
struct AdjustableCouplingTimeStep
{
    double largestCourantNumber;
    double shortest; ///< [s]
    double longest;  ///< [s]
};

/// What constant/couplingProperties says, checked. What is a member here is read here and nowhere else; models that are
/// selected by name, outlets, conservation check and engine read what is theirs from dict().
///
/// FatalIOError naming file, entry and what is allowed where something is missing or wrong.
class CouplingSettings
{
public:
    explicit CouplingSettings(const Foam::Time& time);

    const Foam::IOdictionary& dict() const
    {
        return dict_;
    }

    /// False for DEM only, `fluid none;`.
    bool hasFluid() const
    {
        return hasFluid_;
    }

    /// A where there is no fluid.
    ModelType modelType() const
    {
        return modelType_;
    }

    /// Time between exchanges of particles and fluid [s]; equals the fluid's time step. Of the first interval only, where
    /// adjustableCouplingTimeStep() is there.
    double couplingTimeStep() const
    {
        return couplingTimeStep_;
    }

    /// Empty for intervals that are all alike, and in a dry run.
    const std::optional<AdjustableCouplingTimeStep>& adjustableCouplingTimeStep() const
    {
        return adjustableCouplingTimeStep_;
    }

    /// d(eps)/dt in the fluid's continuity equation.
    bool ddtVoidFraction() const
    {
        return ddtVoidFraction_;
    }

    /// Time constant of the low-pass through which the void fraction enters d(eps)/dt [s]; 0 for none.
    double ddtSmoothingTime() const
    {
        return ddtSmoothingTime_;
    }

    /// Drag implicit in the fluid's momentum equation.
    bool implicitCoupling() const
    {
        return implicitCoupling_;
    }

    /// Below this the void fraction is clipped (and the conservation check reported).
    double minimumVoidFraction() const
    {
        return minimumVoidFraction_;
    }

    /// Particles for ParaView at write times: `particleOutput { writeVtk on; }`, off by default.
    bool writeVtk() const
    {
        return dict_.subOrEmptyDict("particleOutput").getOrDefault<Foam::Switch>("writeVtk", false);
    }

    /// The choices of this file for the start of the log, a line each.
    std::vector<std::string> descriptions() const;

    /// The file that the particles are written to at the end of the run, empty for none.
    Foam::fileName finalRestart() const;

    /// DEM steps in an interval. FatalIOError where that is no whole number.
    int demStepsPerCouplingStep(double demTimeStep) const;

    /// FatalIOError where a time [s] that an entry of `dict` states is no whole number of DEM steps.
    /// \return that number
    double wholeSteps(const Foam::dictionary& dict, const Foam::word& entry, double time, double demTimeStep) const;

    const Foam::dictionary& demDict() const
    {
        return dict_.subDict("DEM");
    }

private:
    void readChoices();
    void readAdjustableCouplingTimeStep();
    void checkTimeStep() const;

    const Foam::Time& time_;
    Foam::IOdictionary dict_;
    bool hasFluid_ = true;
    ModelType modelType_ = ModelType::A;
    double couplingTimeStep_ = 0;
    std::optional<AdjustableCouplingTimeStep> adjustableCouplingTimeStep_;
    bool ddtVoidFraction_ = true;
    double ddtSmoothingTime_ = 0;
    bool implicitCoupling_ = true;
    double minimumVoidFraction_ = 0.1;
};

} // namespace clepsydra
