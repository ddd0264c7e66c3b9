#include "interval/fluidCoupling.h"

#include "vectors.h"

#include "fvc.H"
#include "fvcCurl.H"
#include "fvcDdt.H"
#include "fvcGrad.H"
#include "fvcLaplacian.H"
#include "zeroGradientFvPatchFields.H"

#include <mpi.h>

#include <cmath>
#include <cstdlib>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Rows of what beads put into cells.
enum GivenRow : Eigen::Index
{
    solidVolume = 0,
    impulse = 1,
    implicitCoefficientTime = 4,
    givenRowCount = 5
};

/// A field of the coupling: read where the run was stopped, otherwise uniform.
template<class Type>
GeometricField<Type, fvPatchField, volMesh> couplingField(
    const word& name, const fvMesh& mesh, const dimensionSet& dimensions, const Type& value)
{
    return GeometricField<Type, fvPatchField, volMesh>(
        IOobject(name, mesh.time().timeName(), mesh, IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE), mesh,
        dimensioned<Type>(name, dimensions, value), zeroGradientFvPatchField<Type>::typeName);
}

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
      modelType_(readModelType(settings.dict())),
      needs_(needs),
      engine_(engine),
      ledger_(ledger),
      timers_(timers),
      distribution_(distribution),
      exchange_(duplicateWorld(), distribution_.cells().box(), distribution_.voidFractionModel().commonReach()),
      one_(IOobject("one", mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, false), mesh,
          dimensionedScalar("one", dimless, 1)),
      voidFraction_(couplingField<scalar>("voidFraction", mesh, dimless, 1)),
      voidFractionInContinuity_(couplingField<scalar>("voidFractionInContinuity", mesh, dimless, 1)),
      ddtVoidFraction_(couplingField<scalar>("ddtVoidFraction", mesh, dimless / dimTime, 0)),
      implicitCoefficient_(couplingField<scalar>("implicitCoefficient", mesh, dimless / dimTime, 0)),
      beadSource_(couplingField<vector>("beadSource", mesh, dimAcceleration, vector::zero)),
      outstanding_(couplingField<vector>("outstandingMomentum", mesh, dimVelocity, vector::zero)),
      solidFraction_(1 - voidFraction_.primitiveField())
{
    if (needs_.acceleration)
    {
        acceleration_.reset(
            new volVectorField(couplingField<vector>("fluidAcceleration", mesh, dimAcceleration, vector::zero)));
    }
    voidFraction_.oldTime();
    ledger.openMomentum(momentumOutstanding());
}

vector FluidCoupling::momentumOutstanding() const
{
    return -gSum(vectorField(fluid_.density * mesh_.V().field() * outstanding_.primitiveField()));
}

void FluidCoupling::start(bool resumed)
{
    if (!resumed)
    {
        beadsToFluid(0);
        voidFractionInContinuity_ == voidFraction_;
        return;
    }
    findCells(engine_.beads());
    solidFraction_ = 1 - voidFraction_.primitiveField();
}

void FluidCoupling::beadsToFluid(double interval)
{
    const PhaseTimers::Scope timing = timers_.time("distribute");
    const BeadsView beads = engine_.beads();
    findCells(beads);
    const Eigen::MatrixXd densities = densitiesOfBeads();
    updateVoidFraction(beads, densities);
    if (interval > 0)
    {
        updateDdtVoidFraction(interval);
        updateMomentumSource(densities, interval);
    }
}

void FluidCoupling::findCells(const BeadsView& beads)
{
    const auto exchanged = [&](auto&& communicate) {
        const PhaseTimers::Scope timing = timers_.time("exchange");
        return communicate();
    };
    exchanged([&] { exchange_.send(beads); });
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
}

void FluidCoupling::smooth(Eigen::MatrixXd& densities)
{
    const PhaseTimers::Scope timing = timers_.time("smooth");
    distribution_.smooth(densities);
}

Eigen::MatrixXd FluidCoupling::densitiesOfBeads()
{
    const std::vector<VisitingBead>& visitors = exchange_.visitors();
    Eigen::MatrixXd given(givenRowCount, static_cast<Eigen::Index>(visitors.size()));
    for (Eigen::Index i = 0; i < given.cols(); ++i)
    {
        const VisitingBead& bead = visitors[static_cast<std::size_t>(i)];
        given(solidVolume, i) = sphereVolume(bead.radius);
        given.block<3, 1>(impulse, i) = bead.impulse;
        given(implicitCoefficientTime, i) = bead.implicitCoefficientTime;
    }
    Eigen::MatrixXd densities = distribution_.densities(given);
    smooth(densities);
    return densities;
}

void FluidCoupling::updateVoidFraction(const BeadsView& beads, const Eigen::MatrixXd& densities)
{
    columns(solidFraction_) = densities.row(solidVolume);
    double beadVolume = 0;
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        beadVolume += sphereVolume(beads.radius[bead]);
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

void FluidCoupling::updateMomentumSource(const Eigen::MatrixXd& densities, double interval)
{
    const double perMassAndTime = 1 / (fluid_.density * interval);
    columns(beadSource_.primitiveFieldRef()) = -perMassAndTime * densities.middleRows<3>(impulse);
    beadSource_.correctBoundaryConditions();
    if (settings_.implicitCoupling())
    {
        columns(implicitCoefficient_.primitiveFieldRef()) = perMassAndTime * densities.row(implicitCoefficientTime);
        implicitCoefficient_.correctBoundaryConditions();
    }
}

void FluidCoupling::updateDdtVoidFraction(double interval)
{
    if (!settings_.ddtVoidFraction())
    {
        return;
    }
    const double smoothingTime = settings_.ddtSmoothingTime();
    const double approach = smoothingTime > 0 ? -std::expm1(-interval / smoothingTime) : 1;
    const scalarField change(approach * (voidFraction_.primitiveField() - voidFractionInContinuity_.primitiveField()));
    voidFractionInContinuity_.primitiveFieldRef() += change;
    ddtVoidFraction_.primitiveFieldRef() = change / interval;
}

tmp<volVectorField> FluidCoupling::momentumSource(const volVectorField& U) const
{
    const dimensionedScalar interval("interval", dimTime, settings_.couplingInterval());
    return beadSource_ + outstanding_ / interval + implicitCoefficient_ * U.oldTime();
}

void FluidCoupling::carryMomentum(const volVectorField& U, double interval)
{
    const scalarField mass(fluid_.density * mesh_.V().field());
    const vectorField demanded(interval * beadSource_.primitiveField() + outstanding_.primitiveField());
    const vectorField excess(
        interval * implicitCoefficient_.primitiveField() * (U.primitiveField() - U.oldTime().primitiveField()));
    outstanding_.primitiveFieldRef() = excess;
    outstanding_.correctBoundaryConditions();

    // The beads received minus what their sources ask of the fluid.
    const vector beadsReceived = -gSum(vectorField(mass * interval * beadSource_.primitiveField()));
    const vector fluidLost = -gSum(vectorField(mass * (demanded - excess)));
    ledger_.bookMomentum(beadsReceived, fluidLost, momentumOutstanding());
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
    // Rows of what is sampled at the beads.
    enum Row : Eigen::Index
    {
        voidFraction = 0,
        velocity = 1,
        pressureGradient = 4,
        viscousStressDivergence = 7,
        alwaysThere = 10
    };
    const Eigen::Index acceleration = alwaysThere;
    const Eigen::Index vorticity = alwaysThere + (needs_.acceleration ? 3 : 0);
    const Eigen::Index rowCount = vorticity + (needs_.vorticity ? 3 : 0);
    const dimensionedScalar viscosity("mu", dimViscosity, fluid_.dynamicViscosity);
    const tmp<volVectorField> gradient = fvc::grad(p);
    const tmp<volVectorField> viscous = fvc::laplacian(viscosity, U, "laplacian(nu,U)");

    const tmp<volVectorField> curl = needs_.vorticity ? fvc::curl(U) : tmp<volVectorField>();

    Eigen::MatrixXd pascalPerMetre = fluid_.density * columns(gradient().primitiveField());
    const vector pressureForceInFluid =
        -gSum(vectorField(fluid_.density * gradient().primitiveField() * solidFraction_ * mesh_.V().field()));
    if (modelType_ == ModelType::A)
    {
        smooth(pascalPerMetre);
    }
    else
    {
        pascalPerMetre.setZero();
    }

    Eigen::MatrixXd inCells(rowCount, mesh_.nCells());
    inCells.row(voidFraction) = columns(voidFraction_.primitiveField());
    inCells.middleRows<3>(velocity) = columns(U.primitiveField());
    inCells.middleRows<3>(pressureGradient) = pascalPerMetre;
    inCells.middleRows<3>(viscousStressDivergence) = columns(viscous().primitiveField());
    if (needs_.acceleration)
    {
        inCells.middleRows<3>(acceleration) = columns(acceleration_->primitiveField());
    }
    if (needs_.vorticity)
    {
        inCells.middleRows<3>(vorticity) = columns(curl().primitiveField());
    }

    const Eigen::MatrixXd atBeads = exchange_.sumAtHome(distribution_.sample(inCells));
    const BeadsView beads = engine_.beads();
    vector pressureForceOnBeads = vector::zero;
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        FluidAtBead& fluid = beads.state[bead].fluid;
        fluid.voidFraction = atBeads(voidFraction, bead);
        fluid.logVoidFraction = std::log(fluid.voidFraction);
        fluid.velocity = atBeads.block<3, 1>(velocity, bead);
        fluid.pressureGradient = atBeads.block<3, 1>(pressureGradient, bead);
        fluid.viscousStressDivergence = atBeads.block<3, 1>(viscousStressDivergence, bead);
        if (needs_.acceleration)
        {
            fluid.acceleration = atBeads.block<3, 1>(acceleration, bead);
        }
        if (needs_.vorticity)
        {
            fluid.vorticity = atBeads.block<3, 1>(vorticity, bead);
        }
        pressureForceOnBeads -= sphereVolume(beads.radius[bead]) * toFoam(fluid.pressureGradient);
    }
    // In model B no bead feels it, and the fluid's equation holds no reaction to it.
    if (modelType_ == ModelType::A)
    {
        ledger_.bookPressureForce(returnReduce(pressureForceOnBeads, sumOp<vector>()), pressureForceInFluid);
    }
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
