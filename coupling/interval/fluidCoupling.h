#pragma once

#include "distribution/distribution.h"
#include "engine/demEngine.h"
#include "exchange/beadExchange.h"
#include "forces/forceModel.h"
#include "interval/couplingSettings.h"
#include "ledger/ledger.h"
#include "output/phaseTimers.h"

#include "fvMatrices.H"
#include "volFields.H"

namespace clepsydra
{

/// The fields that beads and fluid share, and how each side fills them for the other.
///
/// Model A of Anderson & Jackson's equations, divided by the fluid's density:
///
///     d(eps)/dt + div(eps U) = 0
///     d(eps U)/dt + div(eps U U) = -eps grad p + div(tau) + momentumSource
///
/// p is kinematic and without its hydrostatic part. In model B grad p stands without eps, see ModelType.
///
/// The eps of d(eps)/dt passes a low-pass of first order in time (useDDTvoidfractionProps { smoothingTime }), elsewhere
/// eps is that of the beads as they are. Collisions change the beads' velocities by jumps. The pressure answers to
/// d2(eps)/dt2, so without the low-pass its noise grows without bound as the step falls; with it, it converges. The
/// rate's integral over time differs from eps by no more than eps changes in a smoothing time: nothing accumulates.
class FluidCoupling
{
public:
    /// \param needs  what of the fluid the forces need at the beads
    FluidCoupling(const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
        const ForceNeeds& needs, DemEngine& engine, Distribution& distribution, Ledger& ledger, PhaseTimers& timers);

    /// The first beads on the mesh. Collective.
    /// \param resumed  the fields are those of a checkpoint: kept as they are, to the last bit
    void start(bool resumed);

    /// Void fraction and sources from the beads as they are now and from what they were given. Collective.
    /// \param interval  time over which they were given [s]; 0 at the start: void fraction only.
    void beadsToFluid(double interval);

    /// Carries over what the implicit part of the source gave beyond the beads' impulse, to be made good next time.
    void carryMomentum(const Foam::volVectorField& U, double interval);

    /// DU/Dt over the interval that has just been solved, where a force needs it. It is kept as a field, so that a
    /// resumed run has it too.
    void updateAcceleration(const Foam::volVectorField& U, double interval);

    /// The fluid at the beads, for the next interval. Collective.
    void fluidToBeads(const Foam::volVectorField& U, const Foam::volScalarField& p);

    const Foam::volScalarField& voidFraction() const
    {
        return voidFraction_;
    }

    /// What the fluid's equation multiplies grad p with: eps in model A, 1 in model B.
    const Foam::volScalarField& pressureFactor() const
    {
        return modelType_ == ModelType::A ? voidFraction_ : one_;
    }

    /// d(eps)/dt, or zero where `useDDTvoidfraction off`.
    const Foam::volScalarField& ddtVoidFraction() const
    {
        return ddtVoidFraction_;
    }

    /// The beads' source in the momentum equation [m/s2 times volume]: the impulse of the last interval, and with
    /// `implicitCouple` what the drag on the fluid's own change of velocity adds, which is made good next time.
    Foam::tmp<Foam::fvVectorMatrix> momentumSource(Foam::volVectorField& U) const;

    /// What the beads' impulses ask of the fluid and it has not received yet [N s]; sum over the ranks. Collective.
    Foam::vector momentumOutstanding() const;

    const BeadExchange& exchange() const
    {
        return exchange_;
    }

private:
    void findCells(const BeadsView& beads);
    /// What the beads put into the cells, smoothed: rows as in GivenRow.
    Eigen::MatrixXd densitiesOfBeads();
    void updateVoidFraction(const BeadsView& beads, const Eigen::MatrixXd& densities);
    void updateDdtVoidFraction(double interval);
    void updateMomentumSource(const Eigen::MatrixXd& densities, double interval);
    void smooth(Eigen::MatrixXd& densities);
    /// See FluidAtBead::selfMobility.
    /// \param resistance  of all beads, this one included [kg/(m3 s)]
    double selfMobility(const CouplingState& state, double radius, const Vector3d& beadVelocity, double resistance,
        double cellSize) const;
    [[noreturn]] void reportBeadOutsideMesh(const BeadsView& beads, Eigen::Index bead) const;
    Foam::string describeCell(Foam::label cell) const;

    const Foam::fvMesh& mesh_;
    const CouplingSettings& settings_;
    const FluidProperties fluid_;
    const ModelType modelType_;
    const ForceNeeds needs_;
    const bool removesSelfDisturbance_;
    DemEngine& engine_;
    Ledger& ledger_;
    PhaseTimers& timers_;

    Distribution& distribution_;
    BeadExchange exchange_;

    const Foam::volScalarField one_;
    Foam::volScalarField voidFraction_;
    /// The void fraction through a low-pass in time, whose rate enters the continuity equation.
    Foam::volScalarField voidFractionInContinuity_;
    Foam::volScalarField ddtVoidFraction_;
    Foam::volScalarField implicitCoefficient_;
    /// Impulse of the beads on the fluid in the last interval [m/s2].
    Foam::volVectorField beadSource_;
    /// What of it the fluid has not received yet [m/s, as impulse per mass and volume].
    Foam::volVectorField outstanding_;
    /// DU/Dt [m/s2]; none where no force needs it.
    Foam::autoPtr<Foam::volVectorField> acceleration_;

    /// Volume of beads per volume, before it is clipped.
    Foam::scalarField solidFraction_;
};

} // namespace clepsydra
