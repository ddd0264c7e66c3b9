#pragma once

#include "interval/fluidCoupling.h"
#include "interval/fluidModels.h"
#include "interval/intervalLength.h"
#include "traffic/beadTraffic.h"

#include <functional>
#include <memory>

namespace clepsydra
{

/// What the ledger asks of the fluid's equations as they were solved.
struct SolvedFluid
{
    /// Integral over this rank's cells of the beads' source in the momentum equation [m4/s2].
    Foam::vector sourceOfBeads;
    /// d(eps)/dt + div(eps U) [1/s]: what is left of the continuity equation.
    Foam::tmp<Foam::volScalarField> continuityError;
};

/// One coupling interval from start to end: the only place where the order of its steps is written.
class CouplingInterval
{
public:
    /// Initialises the engine, puts the first beads on the mesh.
    /// \param models  null for a dry run
    /// \param resumed  beads and fields are those of a checkpoint
    CouplingInterval(const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
        DemEngine& engine, FluidModels* models, PhaseTimers& timers, bool resumed);

    /// What the beads feel in the first interval. Call once, before advance(), where there is a fluid. In a run that is
    /// not resumed the drag of the first interval is taken from U, see CarriedMomentum.
    void start(Foam::volVectorField& U, const Foam::volScalarField& p);

    /// Length of the coming interval [s]. \param timeLeft  to the next time that must be hit [s]: an adjustable interval
    /// is shortened where that time has come nearer since its length was chosen, as in a run that is resumed to end sooner
    double lengthWithin(double timeLeft)
    {
        length_.fitInto(timeLeft);
        return length_.seconds();
    }

    /// A run with fluid. \param phi  flux of U [m3/s]
    /// \param timeLeft  from the end of this interval to the next time that must be hit [s], VGREAT for none
    /// \param solveFluid  solves the fluid's equations over the interval with fluid().
    void advance(const Foam::volVectorField& U, const Foam::volScalarField& p, const Foam::surfaceScalarField& phi,
        double timeLeft, const std::function<SolvedFluid()>& solveFluid);

    /// A dry run.
    void advance();

    /// After a checkpoint: forgets all that the checkpoint does not hold, so that going on equals being resumed.
    void restartInPlace();
    void restartInPlace(const Foam::volVectorField& U, const Foam::volScalarField& p);

    /// What the fluid's equations need. \pre the settings have a fluid.
    const FluidCoupling& fluid() const
    {
        return *fluid_;
    }

    /// In a closed tank, before the pressure is solved for: see VoidFractionRate::spreadImbalance(). Collective.
    /// \param outflow  of fluid through the boundary of this rank [m3/s]
    void spreadImbalance(double outflow)
    {
        ledger_.bookImbalance(interval_ * fluid_->spreadImbalance(outflow));
    }

    /// When the fluid's equations have been solved: see VoidFractionRate::close().
    void closeContinuity(const Foam::surfaceScalarField& anticipatedFlux)
    {
        fluid_->closeContinuity(anticipatedFlux);
    }

    PhaseTimers& timers() const
    {
        return timers_;
    }

    const Ledger& ledger() const
    {
        return ledger_;
    }

private:
    void advanceBeads();
    /// Before the first step of a run, whose first half uses the forces at its beginning: with the fluid, not without.
    void feelFluid(const Foam::volVectorField& U, const Foam::volScalarField& p);
    /// \return true if there were any, and the engine is prepared anew.
    bool removeBeadsThatLeft();
    /// \return what the beads of all ranks had received, taken from the beads themselves.
    ReceivedMomentum forgetGiven();
    /// What keeps the next interval short: every such reason is a line of this. Collective.
    std::vector<IntervalLimit> limits(const Foam::surfaceScalarField& phi) const;

    const CouplingSettings& settings_;
    DemEngine& engine_;
    /// Of the coming interval; from the moment on that the beads have been advanced, of the one after.
    IntervalLength length_;
    /// Of the interval that the fluid is solved for [s].
    double interval_;
    /// By the smallest cell [m].
    double lengthOfChange_ = 0;
    const bool resumed_;
    const double fluidDensity_;
    PhaseTimers& timers_;
    Ledger ledger_;
    BeadTraffic traffic_;
    std::unique_ptr<FluidCoupling> fluid_;
};

} // namespace clepsydra
