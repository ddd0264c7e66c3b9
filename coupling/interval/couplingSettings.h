#pragma once

#include "engine/liggghts/liggghtsEngine.h"

#include "IOdictionary.H"
#include "Time.H"
#include "fvMesh.H"

namespace clepsydra
{

/// What constant/couplingProperties says, checked. Every member of a case is read here and nowhere else, apart from
/// the coefficients of run-time selected models.
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

    /// False for a dry run, `fluid none;`.
    bool hasFluid() const
    {
        return hasFluid_;
    }

    /// Time between exchanges of beads and fluid [s]; equals the fluid's time step.
    double couplingInterval() const
    {
        return couplingInterval_;
    }

    /// d(eps)/dt in the fluid's continuity equation.
    bool ddtVoidFraction() const
    {
        return ddtVoidFraction_;
    }

    /// Drag implicit in the fluid's momentum equation.
    bool implicitCoupling() const
    {
        return implicitCoupling_;
    }

    /// Below this the void fraction is clipped (and the ledger told).
    double minimumVoidFraction() const
    {
        return minimumVoidFraction_;
    }

    /// The engine's script and variables, paths made absolute for a decomposed case.
    LiggghtsSetup engineSetup() const;

    /// The file that the beads are written to at the end of the run, empty for none.
    Foam::fileName finalRestart() const;

    /// DEM steps in an interval. FatalIOError where that is no whole number.
    int stepsPerInterval(double demTimeStep) const;

    const Foam::dictionary& demDict() const
    {
        return dict_.subDict("DEM");
    }

private:
    void readChoices();
    void checkTimeStep() const;

    const Foam::Time& time_;
    Foam::IOdictionary dict_;
    bool hasFluid_ = true;
    double couplingInterval_ = 0;
    bool ddtVoidFraction_ = true;
    bool implicitCoupling_ = true;
    double minimumVoidFraction_ = 0.1;
};

} // namespace clepsydra
