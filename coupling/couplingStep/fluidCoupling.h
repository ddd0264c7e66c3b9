#pragma once

#include "distribution/distribution.h"
#include "engine/demEngine.h"
#include "exchange/particleExchange.h"
#include "forces/anticipatedMotion.h"
#include "forces/forceModel.h"
#include "couplingStep/semiImplicitSource.h"
#include "couplingStep/couplingSettings.h"
#include "couplingStep/selfInducedVelocityCorrection.h"
#include "couplingStep/viscousStress.h"
#include "couplingStep/voidFractionRate.h"
#include "conservation/conservationCheck.h"
#include "phaseTimers.h"

namespace clepsydra
{

/// The fields that particles and fluid share, and how each side fills them for the other.
///
/// Model A of Anderson & Jackson's equations, divided by the fluid's density:
///
///     d(eps)/dt + div(eps U) = 0
///     d(eps U)/dt + div(eps U U) = -eps grad p + div(tau) + momentumSource
///
/// p is kinematic and without its hydrostatic part. In model B grad p stands without eps, see ModelType.
class FluidCoupling
{
public:
    /// \param needs  what of the fluid the forces need at the particles
    FluidCoupling(const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
        const ForceNeeds& needs, DemEngine& engine, Distribution& distribution, ConservationCheck& conservation,
        PhaseTimers& timers);

    /// The first particles on the mesh. Collective.
    /// \param resumed  the fields are those of a checkpoint: kept as they are, to the last bit
    void start(bool resumed);

    /// For the first interval: takes from U the drag that the particles will receive in it. Collective.
    /// \pre  the particles hold what one DEM step gives.
    void subtractFirstDrag(Foam::volVectorField& U, double couplingTimeStep);

    /// Void fraction and sources from the particles as they are now and from what they were given. Collective.
    /// \param couplingTimeStep  time over which they were given, and over which the fluid is solved now [s]
    /// \param next  length of the interval after that [s], whose drag the fluid gives semi-implicitly
    void particlesToFluid(double couplingTimeStep, double next);

    /// When the fluid's equations have been solved. \param anticipatedFlux  see VoidFractionRate::close()
    void closeContinuity(const Foam::surfaceScalarField& anticipatedFlux)
    {
        voidFractionRate_.close(anticipatedFlux);
    }

    /// After fluidToParticles(): what of the drag each particle was given semi-implicitly, see SemiImplicitSource. Collective.
    /// \pre  the particles have not moved since particlesToFluid()
    void assignSemiImplicitDrag(const Foam::volVectorField& U, const Foam::volScalarField& p);

    /// See VoidFractionRate::spreadImbalance(). Collective.
    double spreadImbalance(double outflow)
    {
        return voidFractionRate_.spreadImbalance(outflow);
    }

    /// DU/Dt over the interval that has just been solved, where a force needs it. It is kept as a field, so that a
    /// resumed run has it too.
    void updateAcceleration(const Foam::volVectorField& U, double couplingTimeStep);

    /// The fluid at the particles, for the next interval. Collective.
    void fluidToParticles(const Foam::volVectorField& U, const Foam::volScalarField& p);

    const Foam::volScalarField& voidFraction() const
    {
        return voidFraction_;
    }

    /// What the fluid's equation multiplies grad p with: in model A eps, and what of the particles' pressure force the drag
    /// will take from them in the next couplingTimeStep; 1 in model B.
    const Foam::volScalarField& pressureFactor() const
    {
        return pressureFactor_;
    }

    /// What of the pressure's term in the fluid's equation belongs to the particles: see pressureFactor() [m/s2].
    Foam::tmp<Foam::volVectorField> sourceOfPressure(const Foam::volScalarField& p) const;

    const VoidFractionRate& ddtVoidFraction() const
    {
        return voidFractionRate_;
    }

    /// See SemiImplicitSource::source().
    Foam::tmp<Foam::fvVectorMatrix> momentumSource(Foam::volVectorField& U) const
    {
        return semiImplicitSource_.source(U);
    }

    /// What the fluid has given and the particles have not received yet [N s]; sum over the ranks. Collective.
    Foam::vector semiImplicitMomentum() const;

    /// Numbers of ParticlesView::memory that the coupling needs, after those of the forces.
    static constexpr int memory = 7;

    const ParticleExchange& exchange() const
    {
        return exchange_;
    }

private:
    void findCells();
    /// Of every particle of this rank, from what it was given in the last interval.
    void anticipate(double lastTimeStep, double nextTimeStep);
    Reactions reactions() const;
    /// What the particles put into the cells, smoothed: rows as in DensityRow.
    /// \param rowCount  the first of these rows
    Eigen::MatrixXd densitiesOfParticles(Eigen::Index rowCount);
    /// Before fluidToParticles(), and in a resumed run: what each particle's own disturbance is worked out from.
    void storeSelfInducedVelocity();
    void restoreSelfInducedVelocity();
    /// What of the coupling's state of each particle is part of checkpoints: rows as in CheckpointRow, writable.
    static Eigen::Map<Eigen::Matrix<double, memory, Eigen::Dynamic>, 0, Eigen::OuterStride<>> checkpointedState(
        const ParticlesView& particles);
    void updateVoidFraction(const Eigen::MatrixXd& densities);
    /// \param following  of the particles' volume, what the drag makes follow the pressure, per volume of each cell
    void updatePressureFactor(const Eigen::Ref<const Eigen::RowVectorXd>& velocityResponse);
    void smooth(Eigen::MatrixXd& densities);
    void recordPressureForce(const Foam::vector& inFluid);
    [[noreturn]] void reportParticleOutsideMesh(const ParticlesView& particles, Eigen::Index particle) const;
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
    const ViscousStress viscousStress_;
    /// Of the particles of this rank, over the next interval [s].
    std::vector<AnticipatedMotion> anticipated_;
    double anticipatedTime_ = 0;
    /// Drag coefficient of all particles per volume [kg/(m3 s)]; none where no particle's own disturbance is removed.
    Foam::autoPtr<Foam::volScalarField> resistance_;
    /// DU/Dt [m/s2]; none where no force needs it.
    Foam::autoPtr<Foam::volVectorField> acceleration_;

    /// Volume of particles per volume, before it is clipped.
    Foam::scalarField solidFraction_;
};

} // namespace clepsydra
