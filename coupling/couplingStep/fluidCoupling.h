#pragma once

#include "couplingStep/contributions.h"
#include "couplingStep/demResult.h"
#include "couplingStep/dragTimeChecks.h"
#include "couplingStep/fluidSampling.h"
#include "couplingStep/particlesInFluid.h"

#include <optional>

namespace clepsydra
{

/// What particles and fluid give each other in a coupling step. Each function returns what the next one takes:
///
///     DemResult --particlesToFluid()--> ParticlesInFluid --the fluid's equations--> SolvedStep --fluidToParticles()-->
///     FluidAtParticles, stored in CouplingState
class FluidCoupling
{
public:
    /// \param needs  quantities of the fluid that the forces need at the particles
    FluidCoupling(const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
        const ForceNeeds& needs, DemEngine& engine, Distribution& distribution, const ViscousStress& viscousStress,
        MeanPressureGradient& meanPressureGradient, ConservationCheck& conservation, PhaseTimers& timers);

    /// Computes the void fraction of the first particles, of which no motion is anticipated. Collective.
    /// \param resumed  true where the fields are those of a checkpoint; they are then left unchanged to the last bit
    AnticipatedParticles start(bool resumed);

    /// Subtracts from U the drag that the particles will receive in the first coupling step. Collective.
    /// \param oneStep  the forces of one DEM step, in which the particles have not moved
    AnticipatedParticles subtractFirstDrag(DemResult oneStep, Foam::volVectorField& U, double couplingTimeStep);

    /// Recomputes what depends on the points of the mesh, after they have moved, and lets each cell keep what it holds of
    /// particles. Call at the beginning of a coupling step. Collective.
    void meshMoved();

    /// Computes the void fraction and the sources of the fluid's equations from the particles' present positions and
    /// from what they received. Collective; one reduction in most coupling steps.
    /// \param result  of the DEM steps of one coupling step, over which the fluid is solved next
    /// \param next  length of the coupling step after it, whose drag is in the semi-implicit source [s]
    /// \param ofDem  of the DEM steps; they are reduced and used before the void fraction is checked
    ParticlesInFluid particlesToFluid(const DemResult& result, double next, const RankTotals& ofDem);

    /// Ends the fluid's step, before it is sampled for the next one: see FluidSampling.
    void endStep(const Foam::volVectorField& U, double couplingTimeStep)
    {
        sampling_.updateAcceleration(U, couplingTimeStep);
        sampling_.endWalks(engine_.particles());
    }

    /// Samples the fluid at the particles, for the next DEM steps. Collective.
    void sample(const AnticipatedParticles& particles, const Foam::volVectorField& U, const Foam::volScalarField& p);

    /// Samples the fluid, and gives each particle its part of the drag that the fluid's equation held semi-implicitly,
    /// see SemiImplicitSource. Collective.
    void fluidToParticles(
        const AnticipatedParticles& particles, const Foam::volVectorField& U, const Foam::volScalarField& p);

    /// Momentum that the fluid has given semi-implicitly and that the particles have not received yet, on this rank. Its
    /// magnitudes include those of the terms c U and c v of drag, whose difference is given. Local.
    ExchangedMomentum semiImplicitMomentum(const AnticipatedParticles& anticipated) const;

    /// Compares the force of the pressure gradient on the particles since the last sample() with its reaction when the
    /// totals are reduced. Local.
    /// \param onParticles  mean over the DEM steps, of this rank's particles [N]
    void checkPressureForce(const Vector3d& onParticles, RankTotals& totals) const
    {
        fields_.pressure.check(onParticles, totals);
    }

    /// See bedEdge.h; of the particles of the last coupling step. Collective.
    std::optional<double> partNearClearFluid() const;

    const Foam::volScalarField& voidFraction() const
    {
        return fields_.voidFraction();
    }

    ParticleMapping& mapping()
    {
        return mapping_;
    }

    const ParticleMapping& mapping() const
    {
        return mapping_;
    }

private:
    std::vector<AnticipatedMotion> anticipate(const DemResult& result, double next) const;
    /// See implicitAddedMass(). \param addedMass  of the particle in the last coupling step [kg]
    void anticipateAddedMass(
        const ParticlesView& particles, Eigen::Index particle, double addedMass, AnticipatedMotion& motion) const;
    /// What each particle adds to its cells, a column per particle with rows_.
    Eigen::MatrixXd contributions(const DemResult& result, const std::vector<AnticipatedMotion>& anticipated) const;
    AnticipatedParticles locate(const DemResult& result, double next);
    /// Smoothed densities of what the particles add to the cells.
    /// \param rowCount  number of rows to compute, from the first one on
    Eigen::MatrixXd densities(const LocatedParticles& particles, Eigen::Index rowCount) const;
    /// Computes the densities for the Sauter mean diameter, where a force needs it. Collective.
    /// \pre the void fraction is that of these particles
    void updateSizes(const LocatedParticles& located);
    void assignSemiImplicitDrag(
        const AnticipatedParticles& anticipated, const Foam::volVectorField& U, const Foam::volScalarField& p);

    const Foam::fvMesh& mesh_;
    const CouplingSettings& settings_;
    const FluidProperties fluid_;
    DemEngine& engine_;
    ConservationCheck& conservation_;
    PhaseTimers& timers_;
    MeanPressureGradient& meanPressureGradient_;
    ParticleMapping mapping_;
    FluidSampling sampling_;
    DragTimeChecks dragTimes_;
    const ContributionRows rows_;
    ParticleFields fields_;
};

} // namespace clepsydra
