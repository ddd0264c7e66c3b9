#pragma once

#include "couplingStep/fluidCoupling.h"
#include "couplingStep/fluidModels.h"
#include "couplingStep/couplingStepLength.h"
#include "insertionAndRemoval/insertionAndRemoval.h"

#include <functional>
#include <memory>

namespace clepsydra
{

/// Results of the fluid's equations that the conservation check needs.
struct SolvedFluid
{
    /// Integral of the particles' source in the momentum equation over this rank's cells [m4/s2].
    Foam::vector sourceOfParticles;
    /// Residual of the continuity equation, d(eps)/dt + div(eps U) [1/s].
    Foam::tmp<Foam::volScalarField> continuityError;
};

/// Advances particles and fluid by coupling steps. The order of operations within a coupling step is defined here only.
class CouplingStep
{
public:
    /// Initialises the engine and computes the first void fraction.
    /// \param models  null for DEM only
    /// \param resumed  true where particles and fields are those of a checkpoint
    CouplingStep(const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
        DemEngine& engine, FluidModels* models, PhaseTimers& timers, bool resumed);

    /// Evaluates the fluid forces of the first coupling step. Call once, before advance(), in a run with fluid. In a
    /// run that is not resumed, the drag of the first coupling step is subtracted from the fluid's momentum by changing
    /// U, see SemiImplicitSource.
    void start(Foam::volVectorField& U, const Foam::volScalarField& p);

    /// Length of the next coupling step [s]. An adjustable coupling step is shortened where the next time that must be
    /// hit has come nearer since the length was chosen, as in a run that is resumed with an earlier end time.
    /// \param timeLeft  to the next time that must be hit [s]
    double lengthWithin(double timeLeft)
    {
        length_.fitInto(timeLeft);
        return length_.seconds();
    }

    /// Advances a run with fluid by one coupling step.
    /// \param phi  flux of U [m3/s]
    /// \param timeLeft  from the end of this coupling step to the next time that must be hit [s], VGREAT for none
    /// \param solveFluid  solves the fluid's equations over the coupling step with fluid()
    void advance(const Foam::volVectorField& U, const Foam::volScalarField& p, const Foam::surfaceScalarField& phi,
        double timeLeft, const std::function<SolvedFluid()>& solveFluid);

    /// Advances a DEM-only run by one coupling step.
    void advance();

    /// Call after a checkpoint. Discards all state that the checkpoint does not hold, so that a run that continues and
    /// a run that is resumed give the same results.
    void restartInPlace();
    void restartInPlace(const Foam::volVectorField& U, const Foam::volScalarField& p);

    /// Fields and sources for the fluid's equations. \pre the settings have a fluid
    const FluidCoupling& fluid() const
    {
        return *fluid_;
    }

    /// Distributes the volume imbalance of a closed tank over its cells, before the pressure is solved: see
    /// VoidFractionRate::spreadImbalance(). Collective.
    /// \param outflow  of fluid through the boundary of this rank [m3/s]
    void spreadImbalance(double outflow)
    {
        conservation_.recordImbalance(couplingTimeStep_ * fluid_->spreadImbalance(outflow));
    }

    /// Call when the fluid's equations have been solved: see VoidFractionRate::close().
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
    /// Evaluates the fluid forces before the first step of a run, whose first half (velocity Verlet) already uses them.
    void evaluateFluidForces(const Foam::volVectorField& U, const Foam::volScalarField& p);
    /// Finds the particles outside the mesh where these are allowed; null where they are not.
    FindOutsideMesh findOutsideMesh();
    /// Removes particles that are entirely beyond an outlet. \return true if there were any; the engine has then been
    /// prepared for its next step
    bool removeParticlesThatLeft();
    /// Compares the impulse that the pressure gradient gave the particles in the last coupling step with the fluid's.
    /// Collective.
    void checkPressureForce();
    /// Sets the received impulses of all particles to zero. \return their sum over all ranks
    ExchangedMomentum resetReceivedImpulse();
    /// Upper limits of the next coupling step, one line for each reason. Collective.
    std::vector<CouplingStepLimit> limits(const Foam::surfaceScalarField& phi) const;

    const CouplingSettings& settings_;
    DemEngine& engine_;
    /// Length of the next coupling step. After `advanceParticles()`: of the step after that.
    CouplingStepLength length_;
    /// Length of the coupling step over which the fluid is solved [s].
    double couplingTimeStep_;
    /// Length over which the fluid changes, computed with the smallest cell [m].
    double lengthOfChange_ = 0;
    const bool resumed_;
    const double fluidDensity_;
    PhaseTimers& timers_;
    ConservationCheck conservation_;
    InsertionAndRemoval insertionAndRemoval_;
    /// Null for DEM only.
    ParticleForces* forces_;
    /// DEM time of the last coupling step: the number of DEM steps times their length [s].
    double demTime_ = 0;
    std::unique_ptr<FluidCoupling> fluid_;
};

} // namespace clepsydra
