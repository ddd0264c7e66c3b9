#include "interval/fluidCoupling.h"

#include "closures/gaussianDisturbance.h"
#include "interval/viscousStress.h"
#include "vectors.h"

#include "fvc.H"
#include "fvcCurl.H"
#include "fvcDdt.H"
#include "fvcGrad.H"
#include "fvmSup.H"
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

/// A field of the coupling: read where the run was stopped, otherwise uniform. READ_IF_PRESENT alone takes a file
/// that cannot be opened for one that is not there.
template<class Type>
GeometricField<Type, fvPatchField, volMesh> couplingField(
    const word& name, const fvMesh& mesh, const dimensionSet& dimensions, const Type& value)
{
    using Field = GeometricField<Type, fvPatchField, volMesh>;
    IOobject file(name, mesh.time().timeName(), mesh, IOobject::MUST_READ, IOobject::AUTO_WRITE);
    if (returnReduce(isFile(file.objectPath()), orOp<bool>()))
    {
        return Field(file, mesh);
    }
    file.readOpt() = IOobject::READ_IF_PRESENT;
    return Field(file, mesh, dimensioned<Type>(name, dimensions, value), zeroGradientFvPatchField<Type>::typeName);
}

MPI_Comm duplicateWorld()
{
    MPI_Comm own;
    MPI_Comm_dup(MPI_COMM_WORLD, &own);
    return own;
}

/// Diffusion on a lattice of cells from one cell, at that cell: exp(-x) I_0(x)/h with x = b2/(2 h2), which is the peak
/// 1/(sqrt(pi) b) of the Gaussian where cells are small [1/m].
double latticePeak(double bandwidthSqr, double cellSize)
{
    const double x = bandwidthSqr / (2 * sqr(cellSize));
    return x > 100 ? 1 / std::sqrt(constant::mathematical::pi * bandwidthSqr)
                   : std::exp(-x) * std::cyl_bessel_i(0, x) / cellSize;
}

/// A force in one cell acts on that cell like a Gaussian of this b2/h2: 1/(2 pi^1.5 b) of the Gaussian equals the
/// simple cubic lattice's Green's function at its origin, 0.2527/h (Watson's integral).
constexpr double latticeBandwidthSqr = 0.126;

bool readSelfDisturbance(const CouplingSettings& settings)
{
    const dictionary& dict = settings.dict();
    const word entry = "selfDisturbance";
    if (!dict.found(entry) || selectedModel(dict, entry, {"off", "Oseen"}) == "off")
    {
        return false;
    }
    if (!settings.implicitCoupling())
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is Oseen; allowed: with momCoupleModels "
                                     << "(implicitCouple), whose coefficient says how dense the neighbours are"
                                     << exit(FatalIOError);
    }
    if (dict.get<word>("smoothingModel") == "off")
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entry << "' is Oseen, and smoothingModel is off; allowed: with "
                                     << "smoothing over more than a bead's diameter" << exit(FatalIOError);
    }
    return true;
}

} // namespace

FluidCoupling::FluidCoupling(const fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
    const ForceNeeds& needs, DemEngine& engine, Distribution& distribution, Ledger& ledger, PhaseTimers& timers)
    : mesh_(mesh),
      settings_(settings),
      fluid_(fluid),
      modelType_(readModelType(settings.dict())),
      needs_(needs),
      removesSelfDisturbance_(readSelfDisturbance(settings)),
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
    const PhaseTimers::Scope timing = timers_.time("smooth");
    distribution_.smoothNearBeads();
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

tmp<fvVectorMatrix> FluidCoupling::momentumSource(volVectorField& U) const
{
    const dimensionedScalar interval("interval", dimTime, settings_.couplingInterval());
    return beadSource_ + outstanding_ / interval + implicitCoefficient_ * U.oldTime()
           - fvm::Sp(implicitCoefficient_, U);
}

void FluidCoupling::carryMomentum(const volVectorField& U, double interval)
{
    outstanding_.primitiveFieldRef() =
        interval * implicitCoefficient_.primitiveField() * (U.primitiveField() - U.oldTime().primitiveField());
    outstanding_.correctBoundaryConditions();
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
    const Eigen::Index resistance = vorticity + (needs_.vorticity ? 3 : 0);
    const Eigen::Index cellSize = resistance + 1;
    const Eigen::Index rowCount = resistance + (removesSelfDisturbance_ ? 2 : 0);
    const dimensionedScalar viscosity("nu", dimViscosity, fluid_.dynamicViscosity / fluid_.density);
    const tmp<volVectorField> gradient = fvc::grad(p);
    const tmp<volVectorField> viscous = divergenceOfViscousStress(viscosity, U);

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
    inCells.middleRows<3>(viscousStressDivergence) = fluid_.density * columns(viscous().primitiveField());
    if (needs_.acceleration)
    {
        inCells.middleRows<3>(acceleration) = columns(acceleration_->primitiveField());
    }
    if (needs_.vorticity)
    {
        inCells.middleRows<3>(vorticity) = columns(curl().primitiveField());
    }
    if (removesSelfDisturbance_)
    {
        inCells.row(resistance) = fluid_.density * columns(implicitCoefficient_.primitiveField());
        inCells.row(cellSize) = columns(mesh_.V().field()).array().pow(1.0 / 3.0);
    }

    const Eigen::MatrixXd atBeads = exchange_.sumAtHome(distribution_.sample(inCells));
    const BeadsView beads = engine_.beads();
    vector pressureForceOnBeads = vector::zero;
    scalar pressureForceTurnover = 0;
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        FluidAtBead& fluid = beads.state[bead].fluid;
        fluid.voidFraction = atBeads(voidFraction, bead);
        fluid.logVoidFraction = std::log(fluid.voidFraction);
        fluid.velocity = atBeads.block<3, 1>(velocity, bead);
        fluid.velocityInCells = fluid.velocity;
        if (removesSelfDisturbance_)
        {
            fluid.selfMobility = selfMobility(beads.state[bead], beads.radius[bead], beads.velocity.col(bead),
                atBeads(resistance, bead), atBeads(cellSize, bead));
        }
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
        const vector pressureForce = -sphereVolume(beads.radius[bead]) * toFoam(fluid.pressureGradient);
        pressureForceOnBeads += pressureForce;
        pressureForceTurnover += mag(pressureForce);
    }
    // In model B no bead feels it, and the fluid's equation holds no reaction to it.
    if (modelType_ == ModelType::A)
    {
        ledger_.bookPressureForce(returnReduce(pressureForceOnBeads, sumOp<vector>()), pressureForceInFluid,
            returnReduce(pressureForceTurnover, sumOp<scalar>()));
    }
}

double FluidCoupling::selfMobility(
    const CouplingState& state, double radius, const Vector3d& beadVelocity, double resistance, double cellSize) const
{
    // The force is spread by the bead's sphere and the smoothing, the velocity is sampled through the sphere. Variances
    // add up: b2/2 of the Gaussian, d2/20 of a sphere along each axis.
    const double smoothingLength = distribution_.smoothingModel().bandwidth();
    if (smoothingLength <= 2 * radius)
    {
        FatalIOErrorInFunction(settings_.dict())
            << "Entry 'selfDisturbance' is Oseen, and smoothingLength is " << smoothingLength
            << " m; allowed: above the "
            << "diameter of every bead, and there is one of " << 2 * radius << " m" << exit(FatalIOError);
    }
    const double bandwidthSqr = sqr(smoothingLength) + sqr(2 * radius) / 5;
    // Closures of beds speak of means over the bed, the bead's own disturbance included. So it is taken away only as far
    // as the solid at the bead is its own: all of it from a lone bead, next to nothing in a bed.
    const double ownSolid = sphereVolume(radius) * pow3(latticePeak(bandwidthSqr, cellSize));
    const double lone = std::min(1.0, ownSolid / std::max(1 - state.fluid.voidFraction, VSMALL));
    const double slip =
        (state.fluid.velocityInCells + state.fluid.selfMobility * state.handedOver - beadVelocity).norm();
    const double bandwidth = std::sqrt(bandwidthSqr + latticeBandwidthSqr * sqr(cellSize));
    return lone
           * closures::velocityPerForce(
               {bandwidth, fluid_.density, fluid_.dynamicViscosity, slip, (1 - lone) * resistance});
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
