#pragma once

#include "distribution/distribution.h"
#include "engine/demEngine.h"
#include "exchange/particleExchange.h"
#include "forces/anticipatedMotion.h"
#include "forces/forceModel.h"
#include "couplingStep/semiImplicitSource.h"
#include "couplingStep/couplingSettings.h"
#include "couplingStep/selfInducedVelocityCorrection.h"
#include "couplingStep/torqueReaction.h"
#include "couplingStep/viscousStress.h"
#include "couplingStep/voidFractionRate.h"
#include "conservation/conservationCheck.h"
#include "phaseTimers.h"

#include <memory>
#include <optional>

namespace clepsydra
{

/// The fields that particles and fluid exchange, and the operations that compute them.
///
/// The fluid's equations are model A of Anderson & Jackson, divided by the fluid's density:
///
///     d(eps)/dt + div(eps U) = 0
///     d(eps U)/dt + div(eps U U) = -eps grad p + div(tau) + momentumSource
///
/// p is kinematic and without its hydrostatic part. In model B grad p has no factor eps, see ModelType.
class FluidCoupling
{
public:
    /// \param needs  quantities of the fluid that the forces need at the particles
    FluidCoupling(const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
        const ForceNeeds& needs, DemEngine& engine, Distribution& distribution, ConservationCheck& conservation,
        PhaseTimers& timers);

    /// Computes the void fraction of the first particles. Collective.
    /// \param resumed  true where the fields are those of a checkpoint; they are then left unchanged to the last bit
    void start(bool resumed);

    /// Subtracts from U the drag that the particles will receive in the first coupling step. Collective.
    /// \pre the particles hold the impulse that they receive in one DEM step
    void subtractFirstDrag(Foam::volVectorField& U, double couplingTimeStep);

    /// Computes the void fraction and the sources of the fluid's equations from the particles' present positions and
    /// from what they received in the last coupling step. Collective.
    /// \param couplingTimeStep  length of that coupling step, over which the fluid is solved next [s]
    /// \param next  length of the coupling step after it, whose drag is in the semi-implicit source [s]
    void particlesToFluid(double couplingTimeStep, double next);

    /// Call when the fluid's equations have been solved. \param anticipatedFlux  see VoidFractionRate::close()
    void closeContinuity(const Foam::surfaceScalarField& anticipatedFlux)
    {
        voidFractionRate_.close(anticipatedFlux);
    }

    /// Computes the part of its drag that each particle has been given semi-implicitly, see SemiImplicitSource. Call
    /// after fluidToParticles(). Collective.
    /// \pre the particles have not moved since particlesToFluid()
    void assignSemiImplicitDrag(const Foam::volVectorField& U, const Foam::volScalarField& p);

    /// See VoidFractionRate::spreadImbalance(). Collective.
    double spreadImbalance(double outflow)
    {
        return voidFractionRate_.spreadImbalance(outflow);
    }

    /// Computes DU/Dt over the coupling step that has just been solved, where a force needs it. It is stored as a
    /// field, so that a resumed run has it too.
    void updateAcceleration(const Foam::volVectorField& U, double couplingTimeStep);

    /// Compares the force of the pressure gradient on the particles with its reaction in the fluid's equation.
    /// \param onParticles  mean over the coupling step since fluidToParticles(), sum over all ranks [N]
    void checkPressureForce(const Foam::vector& onParticles);

    /// Samples the fluid at the particles, for the next coupling step. Collective.
    void fluidToParticles(const Foam::volVectorField& U, const Foam::volScalarField& p);

    /// Part of the particles in dense regions that are within a smoothing bandwidth of clear fluid, where the smoothed
    /// void fraction is one between those of the bed and of the fluid beyond it [-]; empty without a bed.
    /// It describes the particles of the last particlesToFluid(). Collective.
    std::optional<double> partNearClearFluid() const;

    const Foam::volScalarField& voidFraction() const
    {
        return voidFraction_;
    }

    /// Factor of grad p in the fluid's equation. In model A it is eps plus the part of the particles' pressure force
    /// that drag will transfer to the fluid in the next coupling step; in model B it is 1.
    const Foam::volScalarField& pressureFactor() const
    {
        return pressureFactor_;
    }

    /// The part of the pressure term in the fluid's equation that acts on the particles [m/s2], see pressureFactor().
    Foam::tmp<Foam::volVectorField> sourceOfPressure(const Foam::volScalarField& p) const;

    const VoidFractionRate& ddtVoidFraction() const
    {
        return voidFractionRate_;
    }

    /// See SemiImplicitSource::source(); with the reaction of the particles' torques, where there are any.
    Foam::tmp<Foam::fvVectorMatrix> momentumSource(Foam::volVectorField& U) const
    {
        return torqueReaction_ ? semiImplicitSource_.source(U) + torqueReaction_->source()
                               : semiImplicitSource_.source(U);
    }

    /// Momentum that the fluid has given semi-implicitly and that the particles have not received yet. Its magnitudes
    /// include those of the terms c U and c v of drag, whose difference is given. Collective.
    /// \pre the particles are those of the last particlesToFluid() or start()
    ExchangedMomentum semiImplicitMomentum() const;

    /// Whether each particle of this rank is in no cell of the mesh on any rank. Collective.
    std::vector<bool> particlesOutsideMesh();

    /// See VoidFractionRate::filteredVolume(). Collective.
    double filteredVolume() const
    {
        return voidFractionRate_.filteredVolume();
    }

    /// Number of values that the coupling needs in ParticlesView::memory, after those of the forces.
    static constexpr int memory = 7;

    const ParticleExchange& exchange() const
    {
        return exchange_;
    }

private:
    void findCells();
    /// What `communicate` returns; its time is that of the exchange.
    template<class Communicate>
    auto exchanged(const Communicate& communicate);
    /// Computes anticipated_ for every particle of this rank, from what it received in the last coupling step.
    void anticipate(double lastTimeStep, double nextTimeStep);
    Reactions reactions() const;
    /// Smoothed densities of what the particles add to the cells, with the rows of DensityRow.
    /// \param rowCount  number of rows to compute, from the first one on
    Eigen::MatrixXd densitiesOfParticles(Eigen::Index rowCount);
    /// The self-induced velocity is computed from drag and selfMobility. They are stored before fluidToParticles() and
    /// restored in a resumed run.
    void storeSelfInducedVelocity();
    void restoreSelfInducedVelocity();
    /// The part of each particle's coupling state that checkpoints hold, writable, with the rows of CheckpointRow.
    static Eigen::Map<Eigen::Matrix<double, memory, Eigen::Dynamic>, 0, Eigen::OuterStride<>> checkpointedState(
        const ParticlesView& particles);
    void updateVoidFraction(const Eigen::MatrixXd& densities);
    /// \param velocityResponse  volume of particles that follows the fluid's response to the pressure, per volume of
    /// each cell
    void updatePressureFactor(const Eigen::Ref<const Eigen::RowVectorXd>& velocityResponse);
    void smooth(Eigen::MatrixXd& densities);
    /// Sum over all ranks of the magnitudes of the pressure forces on the particles [N].
    double magnitudeOfPressureForces();
    /// Whether the pressure gradient acts on the particles: in model A, unless it is left out.
    bool pressureActsOnParticles() const;
    /// Sends the particles to the ranks of their cells. \return the sums of their shares over all ranks. Collective.
    Eigen::MatrixXd locate(const Reactions& reactions);
    /// Collective. FatalError where a particle has no share, and particles outside the mesh are not allowed.
    void requireWithinMesh(const Eigen::MatrixXd& shareSums) const;
    [[noreturn]] void reportOutsideMesh(Foam::label count, Foam::label id) const;
    Foam::string describeCell(Foam::label cell) const;

    const Foam::fvMesh& mesh_;
    const CouplingSettings& settings_;
    const FluidProperties fluid_;
    const ForceNeeds needs_;
    DemEngine& engine_;
    ConservationCheck& conservation_;
    PhaseTimers& timers_;

    Distribution& distribution_;
    ParticleExchange exchange_;
    SelfInducedVelocityCorrection selfInducedVelocityCorrection_;

    Foam::volScalarField voidFraction_;
    Foam::volScalarField pressureFactor_;
    VoidFractionRate voidFractionRate_;
    SemiImplicitSource semiImplicitSource_;
    /// Null where no force has a torque.
    std::unique_ptr<TorqueReaction> torqueReaction_;
    const ViscousStress viscousStress_;
    /// Anticipated motion of this rank's particles over the next coupling step.
    std::vector<AnticipatedMotion> anticipated_;
    double anticipatedTime_ = 0;
    /// Drag coefficient of all particles per volume [kg/(m3 s)]; null where the self-induced velocity is not removed.
    Foam::autoPtr<Foam::volScalarField> resistance_;
    /// Force whose reaction to the particles is in the fluid's equation, and the sum of the magnitudes of the forces on
    /// the particles in the next coupling step, over all ranks [N]; model A only.
    Foam::vector pressureForceInFluid_ = Foam::vector::zero;
    double magnitudeOfPressureForces_ = 0;
    /// DU/Dt [m/s2]; null where no force needs it.
    Foam::autoPtr<Foam::volVectorField> acceleration_;

    /// Volume of particles per volume of the cell, before clipping.
    Foam::scalarField solidFraction_;
};

} // namespace clepsydra
