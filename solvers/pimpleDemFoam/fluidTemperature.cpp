#include "fluidTemperature.h"

#include "couplingStep/couplingField.h"
#include "vectors.h"

#include "fvCFD.H"

namespace clepsydra
{

using namespace Foam;

namespace
{

ParticleTemperatures& requestTemperatures(DemEngine& engine, const HeatOfParticles& heat)
{
    auto* const temperatures = dynamic_cast<ParticleTemperatures*>(&engine);
    if (!temperatures)
    {
        FatalErrorInFunction << "The particles of " << engine.version().c_str()
                             << " have no temperature; allowed: couplingProperties without the dictionary 'energy'"
                             << exit(FatalError);
    }
    temperatures->requestTemperatures(heat);
    return *temperatures;
}

} // namespace

FluidTemperature::FluidTemperature(
    const fvMesh& mesh, const Energy& energy, const FluidProperties& fluid, DemEngine& engine)
    : mesh_(mesh),
      thermal_(energy.fluid),
      gravity_(fluid.gravity),
      capacityPerVolume_(fluid.density * energy.fluid.specificHeat),
      engine_(engine),
      temperatures_(requestTemperatures(engine, energy.particles)),
      exchange_(mesh, energy, fluid),
      T_(IOobject("T", mesh.time().timeName(), mesh, IOobject::MUST_READ, IOobject::AUTO_WRITE), mesh)
{
    if (T_.dimensions() != dimTemperature)
    {
        FatalErrorInFunction << "The file " << T_.time().timeName() << "/T has the dimensions " << T_.dimensions()
                             << "; allowed: dimensions " << dimTemperature << " of a temperature" << exit(FatalError);
    }
    if (thermal_.expansion > 0)
    {
        buoyancy_ = std::make_unique<volVectorField>(temporaryField<volVectorField>("buoyancy", mesh, dimAcceleration));
        updateBuoyancy();
    }
}

void FluidTemperature::updateBuoyancy()
{
    if (buoyancy_)
    {
        buoyancy_->primitiveFieldRef() =
            thermal_.expansion * (thermal_.referenceTemperature - T_.primitiveField()) * toFoam(gravity_);
    }
}

void FluidTemperature::solve(
    ParticlesInFluid& particles, const surfaceScalarField& alphaPhi, const FluidTurbulence* turbulence)
{
    const double timeStep = mesh_.time().deltaTValue();
    const volScalarField& voidFraction = particles.voidFractionInContinuity();
    const scalarField& volumes = mesh_.V().field();
    const auto inFluid = [&](const scalarField& volumeOfCells, const volScalarField& eps, const volScalarField& T) {
        return capacityPerVolume_ * sum(volumeOfCells * eps.primitiveField() * T.primitiveField());
    };
    const scalarField& volumesBefore = mesh_.moving() ? mesh_.V0().field() : volumes;
    const double before = inFluid(volumesBefore, voidFraction.oldTime(), T_.oldTime());

    const dimensionedScalar diffusivityOfFluid("diffusivity", dimViscosity, thermal_.conductivity / capacityPerVolume_);
    surfaceScalarField diffusivity("kappa", diffusivityOfFluid * particles.voidFractionf());
    if (turbulence)
    {
        diffusivity +=
            particles.voidFractionf() * fvc::interpolate(turbulence->eddyViscosity()) / thermal_.turbulentPrandtlNumber;
    }
    const volScalarField continuityError("continuityError", fvc::ddt(voidFraction) + fvc::div(alphaPhi));
    exchange_.update(particles, engine_.particles(), temperatures_.temperatures(), timeStep);
    // clang-format off
    fvScalarMatrix TEqn
    (
        fvm::ddt(voidFraction, T_)
      + fvm::div(alphaPhi, T_, "div(phi,T)")
      // A uniform temperature remains uniform, whatever the solvers' tolerance leaves of the continuity error.
      - fvm::Sp(continuityError, T_)
      - fvm::laplacian(diffusivity, T_)
     ==
        exchange_.source(T_)
    );
    // clang-format on
    TEqn.solve(mesh_.solver(T_.name()));

    HeatOfStep heat = exchange_.exchange(particles, temperatures_.temperatures(), T_);
    heat.inFluidBefore = before;
    heat.inFluid = inFluid(volumes, voidFraction, T_);
    heat.throughBoundary = throughBoundary(alphaPhi, diffusivity);
    heat.ofContinuityError =
        timeStep * capacityPerVolume_ * sum(volumes * continuityError.primitiveField() * T_.primitiveField());
    particles.setHeat(heat);
    updateBuoyancy();
}

void FluidTemperature::meshMoved()
{
    exchange_.meshMoved();
}

double FluidTemperature::throughBoundary(
    const surfaceScalarField& alphaPhi, const surfaceScalarField& diffusivity) const
{
    scalar outflow = 0;
    forAll (T_.boundaryField(), patch)
    {
        const fvPatchScalarField& onPatch = T_.boundaryField()[patch];
        if (!onPatch.coupled())
        {
            outflow += sum(alphaPhi.boundaryField()[patch] * onPatch
                           - diffusivity.boundaryField()[patch] * onPatch.patch().magSf() * onPatch.snGrad());
        }
    }
    return mesh_.time().deltaTValue() * capacityPerVolume_ * outflow;
}

} // namespace clepsydra
