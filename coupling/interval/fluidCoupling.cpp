#include "interval/fluidCoupling.h"

#include "interval/couplingField.h"
#include "interval/sampledFields.h"
#include "vectors.h"

#include "fvc.H"
#include "fvcCurl.H"
#include "fvcGrad.H"

#include <mpi.h>

#include <cmath>
#include <cstdlib>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Rows of what beads put into cells: their volume, their reaction (first what CarriedMomentum, then what
/// VoidFractionRate needs), and the resistance only where a bead's own disturbance is removed.
enum GivenRow : Eigen::Index
{
    solidVolume = 0,
    momentum = 1,
    motion = momentum + CarriedMomentum::rowCount,
    resistanceTime = motion + VoidFractionRate::rowCount
};

/// Rows of what is kept of each bead from interval to interval: P, see CarriedMomentum [N s], and what its own disturbance
/// is worked out from.
enum KeptRow : Eigen::Index
{
    inAdvance = 0,
    drag = 3,
    selfMobility = 6
};

static_assert(reactionSize == CarriedMomentum::rowCount + VoidFractionRate::rowCount);

MPI_Comm duplicateWorld()
{
    MPI_Comm own;
    MPI_Comm_dup(MPI_COMM_WORLD, &own);
    return own;
}

} // namespace

FluidCoupling::FluidCoupling(const fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
    const ForceNeeds& needs, DemEngine& engine, Distribution& distribution, Ledger& ledger, PhaseTimers& timers)
    : mesh_(mesh),
      settings_(settings),
      fluid_(fluid),
      needs_(needs),
      engine_(engine),
      ledger_(ledger),
      timers_(timers),
      distribution_(distribution),
      exchange_(duplicateWorld(), distribution_.cells().box(), distribution_.voidFractionModel().commonReach()),
      selfDisturbance_(settings, fluid, distribution.smoothingModel()),
      voidFraction_(couplingField<scalar>("voidFraction", mesh, dimless, 1)),
      pressureFactor_(fieldOfInterval<volScalarField>(
          "pressureFactor", mesh, dimless, 1, zeroGradientFvPatchScalarField::typeName)),
      voidFractionRate_(mesh, settings),
      carriedMomentum_(mesh, fluid.density),
      viscousStress_(mesh, fluid),
      solidFraction_(1 - voidFraction_.primitiveField())
{
    if (needs_.acceleration)
    {
        acceleration_.reset(
            new volVectorField(couplingField<vector>("fluidAcceleration", mesh, dimAcceleration, vector::zero)));
    }
    if (selfDisturbance_.isRemoved())
    {
        resistance_.reset(
            new volScalarField(couplingField<scalar>("resistanceOfBeads", mesh, dimDensity / dimTime, 0)));
    }
    voidFraction_.oldTime();
}

Eigen::Map<Eigen::Matrix<double, FluidCoupling::memory, Eigen::Dynamic>, 0, Eigen::OuterStride<>> FluidCoupling::kept(
    const BeadsView& beads)
{
    return {beads.memory ? beads.memory + beads.memorySize - memory : nullptr, memory, beads.size(),
        Eigen::OuterStride<>(beads.memorySize)};
}

vector FluidCoupling::momentumGivenInAdvance() const
{
    const Vector3d ofBeads = kept(engine_.beads()).middleRows<3>(inAdvance).rowwise().sum();
    return returnReduce(toFoam(ofBeads), sumOp<vector>())
           + gSum(vectorField(fluid_.density * mesh_.V().field() * carriedMomentum_.unassigned()));
}

void FluidCoupling::start(bool resumed)
{
    anticipate(settings_.couplingInterval(), settings_.couplingInterval());
    findCells();
    const Eigen::MatrixXd densities = densitiesOfBeads(solidVolume + 1);
    if (resumed)
    {
        // Before clipping, which the void fraction that was read is not.
        columns(solidFraction_) = densities.row(solidVolume);
        recallDisturbance();
        return;
    }
    updateVoidFraction(densities);
    // No equation has been solved yet in which the drag took a part of the pressure from the beads.
    updatePressureFactor(Eigen::RowVectorXd::Zero(mesh_.nCells()));
    voidFractionRate_.start(voidFraction_);
}

void FluidCoupling::keepDisturbance()
{
    const BeadsView beads = engine_.beads();
    for (Eigen::Index bead = 0; resistance_ && bead < beads.size(); ++bead)
    {
        kept(beads).col(bead).segment<3>(drag) = beads.state[bead].drag;
        kept(beads)(selfMobility, bead) = beads.state[bead].fluid.selfMobility;
    }
}

void FluidCoupling::recallDisturbance()
{
    const BeadsView beads = engine_.beads();
    for (Eigen::Index bead = 0; resistance_ && bead < beads.size(); ++bead)
    {
        beads.state[bead].drag = kept(beads).col(bead).segment<3>(drag);
        beads.state[bead].fluid.selfMobility = kept(beads)(selfMobility, bead);
    }
}

void FluidCoupling::takeFirstDragFrom(volVectorField& U, double interval)
{
    const BeadsView beads = engine_.beads();
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        beads.state[bead].given.impulse.setZero();
    }
    anticipate(engine_.timeStep(), interval);
    findCells();
    carriedMomentum_.update(densitiesOfBeads(motion).middleRows<CarriedMomentum::rowCount>(momentum), interval);
    carriedMomentum_.takeFrom(U, voidFraction_);
}

void FluidCoupling::beadsToFluid(double interval, double next)
{
    const PhaseTimers::Scope timing = timers_.time("distribute");
    anticipate(interval, next);
    findCells();
    Eigen::MatrixXd densities = densitiesOfBeads(resistance_ ? resistanceTime + 1 : resistanceTime);
    // Their motion over the coming interval, per time of the one that is solved.
    densities.middleRows<VoidFractionRate::rowCount>(motion) *= next / interval;
    updateVoidFraction(densities);
    updatePressureFactor(densities.row(motion));
    voidFractionRate_.update(voidFraction_, densities.middleRows<VoidFractionRate::rowCount>(motion), interval);
    carriedMomentum_.update(densities.middleRows<CarriedMomentum::rowCount>(momentum), interval);
    if (resistance_)
    {
        columns(resistance_->primitiveFieldRef()) = densities.row(resistanceTime) / interval;
    }
}

void FluidCoupling::anticipate(double lastInterval, double nextInterval)
{
    const BeadsView beads = engine_.beads();
    anticipatedTime_ = nextInterval;
    anticipated_.assign(static_cast<std::size_t>(beads.size()), AnticipatedMotion());
    if (!settings_.implicitCoupling())
    {
        return;
    }
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        const CouplingState& state = beads.state[bead];
        // One that has left is given nothing in advance, for it is taken out before it could receive it.
        if (state.fluid.presence > 0)
        {
            anticipated_[static_cast<std::size_t>(bead)] = anticipatedMotion(state.given,
                beads.velocity.col(bead) - state.velocityBefore, beads.mass[bead], lastInterval, nextInterval);
        }
    }
}

Reactions FluidCoupling::reactions() const
{
    const BeadsView beads = engine_.beads();
    const auto ofBead = kept(beads);
    Reactions all(reactionSize, beads.size());
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        const AnticipatedMotion& motion = anticipated_[static_cast<std::size_t>(bead)];
        const Vector3d velocity = beads.velocity.col(bead);
        // Explicit coupling anticipates nothing: a motion without its answer to the pressure would be worse than none.
        const double volume = settings_.implicitCoupling() ? volumeInFluid(beads, bead) : 0;
        const double pressureForce = settings_.modelType() == ModelType::A ? fluid_.density * volume : 0;
        all.col(bead) << beads.state[bead].given.impulse - ofBead.col(bead).segment<3>(inAdvance)
                             - motion.drag * velocity,
            motion.drag, volume * motion.following, volume * motion.mobility * pressureForce,
            volume * (1 - motion.following) * velocity;
    }
    return all;
}

void FluidCoupling::giveInAdvance(const volVectorField& U, const volScalarField& p)
{
    if (!settings_.implicitCoupling())
    {
        return;
    }
    const PhaseTimers::Scope timing = timers_.time("distribute");
    const BeadsView beads = engine_.beads();
    Eigen::Matrix3Xd fromFluid(3, beads.size());
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        const AnticipatedMotion& motion = anticipated_[static_cast<std::size_t>(bead)];
        const FluidAtBead& fluid = beads.state[bead].fluid;
        fromFluid.col(bead) =
            motion.drag * fluid.velocityInCells
            + anticipatedTime_ * motion.following * volumeInFluid(beads, bead) * fluid.pressureGradient;
        kept(beads).col(bead).segment<3>(inAdvance) = fromFluid.col(bead) - motion.drag * beads.velocity.col(bead);
    }
    carriedMomentum_.carry(U, sourceOfPressure(p), distribution_.densities(exchange_.toVisitors(fromFluid)));
}

tmp<volVectorField> FluidCoupling::sourceOfPressure(const volScalarField& p) const
{
    const dimensionedScalar inModelA("inModelA", dimless, settings_.modelType() == ModelType::A ? 1 : 0);
    return inModelA * (voidFraction_ - pressureFactor_) * fvc::grad(p);
}

void FluidCoupling::findCells()
{
    const BeadsView beads = engine_.beads();
    const auto exchanged = [&](auto&& communicate) {
        const PhaseTimers::Scope timing = timers_.time("exchange");
        return communicate();
    };
    exchanged([&] { exchange_.send(beads, reactions()); });
    const Eigen::MatrixXd sharesHere = [&] {
        const PhaseTimers::Scope timing = timers_.time("locate");
        return distribution_.findCells(exchange_.visitors());
    }();
    const Eigen::MatrixXd shareSums = exchanged([&] { return exchange_.sumAtHome(sharesHere); });
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        if (!(shareSums(0, bead) > 0))
        {
            reportBeadOutsideMesh(beads, bead);
        }
    }
    distribution_.normalise(exchanged([&] { return exchange_.toVisitors(shareSums); }));
    const PhaseTimers::Scope timing = timers_.time("smooth");
    distribution_.smoothNearBeads();
}

void FluidCoupling::smooth(Eigen::MatrixXd& densities)
{
    const PhaseTimers::Scope timing = timers_.time("smooth");
    distribution_.smooth(densities);
}

Eigen::MatrixXd FluidCoupling::densitiesOfBeads(Eigen::Index rowCount)
{
    const std::vector<VisitingBead>& visitors = exchange_.visitors();
    Eigen::MatrixXd given(resistanceTime + 1, static_cast<Eigen::Index>(visitors.size()));
    for (Eigen::Index i = 0; i < given.cols(); ++i)
    {
        const VisitingBead& bead = visitors[static_cast<std::size_t>(i)];
        given.col(i) << bead.volume, bead.reaction, bead.implicitCoefficientTime;
    }
    Eigen::MatrixXd densities = distribution_.densities(given.topRows(rowCount));
    if (rowCount > momentum)
    {
        carriedMomentum_.addPromised(densities.middleRows<CarriedMomentum::rowCount>(momentum));
    }
    smooth(densities);
    return densities;
}

void FluidCoupling::updateVoidFraction(const Eigen::MatrixXd& densities)
{
    const BeadsView beads = engine_.beads();
    columns(solidFraction_) = densities.row(solidVolume);
    double beadVolume = 0;
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        beadVolume += volumeInFluid(beads, bead);
    }
    const scalarField& cellVolumes = mesh_.V().field();
    const double cellVolume = gSum(scalarField(solidFraction_ * cellVolumes));

    scalarField& voidFraction = voidFraction_.primitiveFieldRef();
    voidFraction = 1 - solidFraction_;
    double clipped = 0;
    label worstCell = -1;
    const double minimum = settings_.minimumVoidFraction();
    forAll (voidFraction, cell)
    {
        if (voidFraction[cell] < minimum)
        {
            worstCell = worstCell < 0 || solidFraction_[cell] > solidFraction_[worstCell] ? cell : worstCell;
            clipped += (minimum - voidFraction[cell]) * cellVolumes[cell];
            voidFraction[cell] = minimum;
        }
    }
    voidFraction_.correctBoundaryConditions();
    ledger_.bookSolidVolume(returnReduce(beadVolume, sumOp<scalar>()), cellVolume,
        returnReduce(clipped, sumOp<scalar>()), worstCell < 0 ? string("none here") : describeCell(worstCell));
}

void FluidCoupling::updatePressureFactor(const Eigen::Ref<const Eigen::RowVectorXd>& following)
{
    pressureFactor_ = voidFraction_;
    if (settings_.modelType() == ModelType::A)
    {
        columns(pressureFactor_.primitiveFieldRef()) += following;
    }
    else
    {
        pressureFactor_.primitiveFieldRef() = 1;
    }
    pressureFactor_.correctBoundaryConditions();
}

void FluidCoupling::updateAcceleration(const volVectorField& U, double interval)
{
    if (needs_.acceleration)
    {
        const tmp<volTensorField> gradient = fvc::grad(U);
        acceleration_->primitiveFieldRef() = (U.primitiveField() - U.oldTime().primitiveField()) / interval
                                             + (U.primitiveField() & gradient().primitiveField());
        acceleration_->correctBoundaryConditions();
    }
}

void FluidCoupling::fluidToBeads(const volVectorField& U, const volScalarField& p)
{
    const PhaseTimers::Scope timing = timers_.time("distribute");
    keepDisturbance();
    const BeadsView beads = engine_.beads();
    const tmp<volVectorField> gradient = fvc::grad(p);

    Eigen::MatrixXd pascalPerMetre = fluid_.density * columns(gradient().primitiveField());
    const vector pressureForceInFluid =
        -gSum(vectorField(fluid_.density * gradient().primitiveField() * solidFraction_ * mesh_.V().field()));
    if (settings_.modelType() == ModelType::A)
    {
        smooth(pascalPerMetre);
    }
    else
    {
        pascalPerMetre.setZero();
    }

    SampledFields sampled;
    const auto sampleVector = [&](const auto& inCells, Vector3d FluidAtBead::*atBead) {
        sampled.add(inCells, [beads, atBead](Eigen::Index bead, const double* value) {
            beads.state[bead].fluid.*atBead = Eigen::Map<const Vector3d>(value);
        });
    };
    sampled.add(columns(voidFraction_.primitiveField()), [beads](Eigen::Index bead, const double* value) {
        FluidAtBead& fluid = beads.state[bead].fluid;
        fluid.voidFraction = *value;
        fluid.logVoidFraction = std::log(*value);
    });
    sampled.add(columns(U.primitiveField()), [beads](Eigen::Index bead, const double* value) {
        FluidAtBead& fluid = beads.state[bead].fluid;
        fluid.velocity = Eigen::Map<const Vector3d>(value);
        fluid.velocityInCells = fluid.velocity;
    });
    sampleVector(pascalPerMetre, &FluidAtBead::pressureGradient);
    if (needs_.viscousStress)
    {
        sampleVector(fluid_.density * columns(viscousStress_.divergence(U)().primitiveField()),
            &FluidAtBead::viscousStressDivergence);
    }
    if (needs_.acceleration)
    {
        sampleVector(columns(acceleration_->primitiveField()), &FluidAtBead::acceleration);
    }
    if (needs_.vorticity)
    {
        sampleVector(columns(fvc::curl(U)().primitiveField()), &FluidAtBead::vorticity);
    }
    if (resistance_)
    {
        Eigen::Matrix2Xd surroundings(2, mesh_.nCells());
        surroundings << columns(resistance_->primitiveField()),
            columns(mesh_.V().field()).array().pow(1.0 / 3.0).matrix();
        sampled.add(surroundings, [&, beads](Eigen::Index bead, const double* value) {
            beads.state[bead].fluid.selfMobility = selfDisturbance_.mobility(beads.state[bead],
                beads.position.col(bead), beads.radius[bead], beads.velocity.col(bead), value[0], value[1]);
        });
    }
    sampled.keep(exchange_.sumAtHome(distribution_.sample(sampled.inCells())));

    // In model B no bead feels it, and the fluid's equation holds no reaction to it.
    if (settings_.modelType() == ModelType::A)
    {
        bookPressureForce(pressureForceInFluid);
    }
}

void FluidCoupling::bookPressureForce(const vector& inFluid)
{
    const BeadsView beads = engine_.beads();
    vector onBeads = vector::zero;
    scalar turnover = 0;
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        const vector onBead = -volumeInFluid(beads, bead) * toFoam(beads.state[bead].fluid.pressureGradient);
        onBeads += onBead;
        turnover += mag(onBead);
    }
    ledger_.bookPressureForce(returnReduce(onBeads, sumOp<vector>()), inFluid, returnReduce(turnover, sumOp<scalar>()));
}

string FluidCoupling::describeCell(label cell) const
{
    const vector& centre = mesh_.C()[cell];
    const VisitingBead* nearest = nullptr;
    double nearestDistance = GREAT;
    for (const VisitingBead& bead : exchange_.visitors())
    {
        const double distance = mag(toFoam(bead.position) - centre);
        if (distance < nearestDistance)
        {
            nearest = &bead;
            nearestDistance = distance;
        }
    }
    return "cell " + Foam::name(cell) + " at " + Foam::name(centre) + " m, void fraction "
           + Foam::name(1 - solidFraction_[cell])
           + (nearest ? ", nearest bead " + Foam::name(label(nearest->id)) : string());
}

void FluidCoupling::reportBeadOutsideMesh(const BeadsView& beads, Eigen::Index bead) const
{
    const vector position = toFoam(beads.position.col(bead));
    const label nearest = mesh_.nCells() > 0 ? mesh_.findNearestCell(position) : -1;
    FatalErrorInFunction << "Bead " << beads.id[bead] << " at " << position
                         << " m lies in no cell of the mesh; the nearest, cell " << nearest << " of rank "
                         << Pstream::myProcNo() << ", is at " << (nearest < 0 ? vector::zero : mesh_.C()[nearest])
                         << " m, the mesh of this rank spans " << mesh_.bounds() << exit(FatalError);
    std::abort();
}

} // namespace clepsydra
