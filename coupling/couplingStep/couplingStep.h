#pragma once

#include "couplingStep/fluidCoupling.h"
#include "couplingStep/fluidModels.h"
#include "couplingStep/couplingStepLength.h"
#include "insertionAndRemoval/insertionAndRemoval.h"

#include <functional>
#include <memory>

namespace clepsydra
{

/// What the conservation check asks of the fluid's equations as they were solved.
struct SolvedFluid
{
    /// Integral over this rank's cells of the particles' source in the momentum equation [m4/s2].
    Foam::vector sourceOfParticles;
    /// d(eps)/dt + div(eps U) [1/s]: what is left of the continuity equation.
    Foam::tmp<Foam::volScalarField> continuityError;
};

/// One coupling step from start to end: the only place where the order of its steps is written.
class CouplingStep
{
public:
    /// Initialises the engine, puts the first particles on the mesh.
    /// \param models  null for a dry run
    /// \param resumed  particles and fields are those of a checkpoint
    CouplingStep(const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
        DemEngine& engine, FluidModels* models, PhaseTimers& timers, bool resumed);

    /// What the particles feel in the first interval. Call once, before advance(), where there is a fluid. In a run that is
    /// not resumed the drag of the first interval is taken from U, see SemiImplicitSource.
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
        conservation_.recordImbalance(couplingTimeStep_ * fluid_->spreadImbalance(outflow));
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

    const ConservationCheck& conservation() const
    {
        return conservation_;
    }

private:
    void advanceParticles();
    /// Before the first step of a run, whose first half uses the forces at its beginning: with the fluid, not without.
    void evaluateFluidForces(const Foam::volVectorField& U, const Foam::volScalarField& p);
    /// \return true if there were any, and the engine is prepared again.
    bool removeParticlesThatLeft();
    /// \return what the particles of all ranks had received, taken from the particles themselves.
    ReceivedMomentum resetReceivedImpulse();
    /// What keeps the next interval short: every such reason is a line of this. Collective.
    std::vector<CouplingStepLimit> limits(const Foam::surfaceScalarField& phi) const;

    const CouplingSettings& settings_;
    DemEngine& engine_;
    /// Of the coming interval; from the moment on that the particles have been advanced, of the one after.
    CouplingStepLength length_;
    /// Of the interval that the fluid is solved for [s].
    double couplingTimeStep_;
    /// By the smallest cell [m].
    double lengthOfChange_ = 0;
    const bool resumed_;
    const double fluidDensity_;
    PhaseTimers& timers_;
    ConservationCheck conservation_;
    InsertionAndRemoval insertionAndRemoval_;
    std::unique_ptr<FluidCoupling> fluid_;
};

} // namespace clepsydra
