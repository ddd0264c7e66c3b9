#pragma once

#include "couplingStep/fluidCoupling.h"
#include "couplingStep/fluidCourantNumber.h"
#include "couplingStep/fluidModels.h"
#include "couplingStep/couplingStepLength.h"
#include "insertionAndRemoval/insertionAndRemoval.h"

#include <functional>
#include <memory>

namespace clepsydra
{

/// Advances particles and fluid by coupling steps. The order of operations within a coupling step is defined here only.
///
/// What the ranks must know of each other is reduced at two points of a coupling step (RankTotals): after the particles
/// have been distributed, before the fluid's equations contain them, and at the end. An adjustable coupling step, parts of
/// the DEM box without mesh, and the pressure where it is fixed nowhere and patches are not noSlip need further reductions,
/// each where it is used at once.
class CouplingStep
{
public:
    /// Initialises the engine.
    /// \param models  null for DEM only
    /// \param resumed  true where particles and fields are those of a checkpoint
    CouplingStep(const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
        DemEngine& engine, FluidModels* models, PhaseTimers& timers, bool resumed);

    /// Computes the first void fraction and the fluid forces of the first coupling step. Call once, before the first
    /// coupling step, in a run with fluid. In a run that is not resumed, the drag of the first coupling step is
    /// subtracted from the fluid's momentum by changing U, see SemiImplicitSource.
    /// \param phi  flux of U [m3/s]
    void start(Foam::volVectorField& U, const Foam::surfaceScalarField& phi, const Foam::volScalarField& p);

    /// Length of the next coupling step [s]. An adjustable coupling step is shortened where the next time that must be
    /// hit has come nearer since the length was chosen, as in a run that is resumed with an earlier end time.
    /// \param timeLeft  to the next time that must be hit [s]
    double lengthWithin(double timeLeft)
    {
        length_.fitInto(timeLeft);
        return length_.seconds();
    }

    /// Recomputes what depends on the points of the mesh, after they have moved. Call before advanceParticles() of the
    /// coupling step at whose end they are there. Collective.
    void meshMoved();

    /// Advances the particles of a run with fluid by one coupling step. Collective.
    /// \param timeLeft  from the end of this coupling step to the next time that must be hit [s], VGREAT for none
    /// \return what the fluid's equations over this coupling step contain of the particles
    ParticlesInFluid advanceParticles(double timeLeft);

    /// Adds numbers whose totals are needed after the coupling step to those of its last reduction.
    using AddToTotals = std::function<void(RankTotals&)>;

    /// Ends the coupling step: gives the particles the fluid that has been solved, checks what was exchanged, and removes
    /// the particles that have left. Collective.
    /// \param phi  flux of U [m3/s]
    /// \param addMore  called on all ranks, before particles are removed; null for nothing
    void fluidToParticles(const SolvedStep& solved, const Foam::volVectorField& U, const Foam::surfaceScalarField& phi,
        const Foam::volScalarField& p, const AddToTotals& addMore = nullptr);

    /// Advances a DEM-only run by one coupling step. Collective.
    /// \param addMore  as for fluidToParticles()
    void advance(const AddToTotals& addMore = nullptr);

    /// Call after a checkpoint. Discards all state that the checkpoint does not hold, so that a run that continues and
    /// a run that is resumed give the same results.
    void restartInPlace();
    void restartInPlace(const Foam::volVectorField& U, const Foam::volScalarField& p);

    /// \pre the settings have a fluid
    const FluidCoupling& fluid() const
    {
        return *fluid_;
    }

    PhaseTimers& timers() const
    {
        return timers_;
    }

    const ConservationCheck& conservation() const
    {
        return conservation_;
    }

    /// At the end of the last coupling step.
    const FluidCourantNumber& courantNumber() const
    {
        return courantNumber_;
    }

private:
    /// The checks are complete when the totals are reduced.
    void advanceDem(RankTotals& totals);
    /// Takes the result of the last DEM steps out of the particles, which then begin with nothing received.
    DemResult takeDemResult(double timeStep);
    /// Finds the particles outside the mesh where these are allowed; null where they are not.
    FindOutsideMesh findOutsideMesh();
    /// Removes particles that are entirely beyond an outlet. The engine has then been prepared for its next step. \pre the
    /// totals of advanceDem() have been reduced
    void removeParticlesThatLeft();
    /// Upper limits of the next coupling step, one line for each reason. Collective.
    std::vector<CouplingStepLimit> limits() const;

    const Foam::fvMesh& mesh_;
    const CouplingSettings& settings_;
    DemEngine& engine_;
    /// Length of the next coupling step. After `advanceParticles()`: of the step after that.
    CouplingStepLength length_;
    /// Length of the coupling step over which the fluid is solved [s].
    double couplingTimeStep_;
    /// Length over which the fluid changes, computed with the smallest cell [m].
    double lengthOfChange_ = 0;
    const bool resumed_;
    PhaseTimers& timers_;
    ConservationCheck conservation_;
    FluidCourantNumber courantNumber_;
    InsertionAndRemoval insertionAndRemoval_;
    /// Null for DEM only.
    ParticleForces* forces_;
    std::unique_ptr<FluidCoupling> fluid_;
};

} // namespace clepsydra
