#include "voidFractionFlow.h"

#include "openfoam/objectFile.h"
#include "turbulence.h"

#include "constrainHbyA.H"
#include "constrainPressure.H"
#include "ddtScheme.H"
#include "emptyFvPatch.H"
#include "fvCFD.H"
#include "noSlipFvPatchVectorField.H"
#include "zeroGradientFvPatchFields.H"

namespace clepsydra
{

namespace
{

/// FatalError that names the file where a field that was read has other dimensions than the equations.
/// \param meaning  what the field is, for the message
template<class Field>
void requireDimensions(const Field& field, const dimensionSet& allowed, const std::string& meaning)
{
    if (field.dimensions() != allowed)
    {
        FatalErrorInFunction << "The file " << field.time().timeName() << '/' << field.name() << " has the dimensions "
                             << field.dimensions() << "; allowed: dimensions " << allowed << " of " << meaning.c_str()
                             << exit(FatalError);
    }
}

/// Not OpenFOAM's createPhi.H, which treats a file that cannot be opened as missing.
surfaceScalarField readFlux(const volVectorField& U)
{
    const fvMesh& mesh = U.mesh();
    IOobject file("phi", mesh.time().timeName(), mesh, IOobject::MUST_READ, IOobject::AUTO_WRITE);
    if (hasFile<surfaceScalarField>(file))
    {
        return surfaceScalarField(file, mesh);
    }
    file.readOpt() = IOobject::READ_IF_PRESENT;
    return surfaceScalarField(file, fvc::flux(U));
}

/// The velocity on the faces, which a run on a moving mesh has written.
surfaceVectorField readFaceVelocity(const volVectorField& U)
{
    const fvMesh& mesh = U.mesh();
    IOobject file("Uf", mesh.time().timeName(), mesh, IOobject::MUST_READ, IOobject::AUTO_WRITE);
    if (hasFile<surfaceVectorField>(file))
    {
        return surfaceVectorField(file, mesh);
    }
    file.readOpt() = IOobject::READ_IF_PRESENT;
    return surfaceVectorField(file, fvc::interpolate(U));
}

IOobject readAndWritten(const word& name, const fvMesh& mesh)
{
    return IOobject(name, mesh.time().timeName(), mesh, IOobject::MUST_READ, IOobject::AUTO_WRITE);
}

/// Whether nothing can pass the boundary of any rank at any time, so that outflow() is zero on all ranks. This follows from
/// the types of the conditions, which are the same on all ranks.
bool isClosed(const volVectorField& U, const volScalarField& p)
{
    bool closed = true;
    forAll (U.boundaryField(), patch)
    {
        const fvPatch& onPatch = U.boundaryField()[patch].patch();
        closed = closed
                 && (onPatch.coupled() || isA<emptyFvPatch>(onPatch)
                     || (U.boundaryField()[patch].type() == noSlipFvPatchVectorField::typeName
                         && p.boundaryField()[patch].type() == zeroGradientFvPatchScalarField::typeName));
    }
    return closed;
}

/// Outflow of fluid through the boundary of this rank [m3/s], where p has a prescribed gradient everywhere. A patch
/// that extrapolates p contributes a flux without pressure, from which that of its gradient is subtracted.
scalar outflow(const surfaceScalarField& voidFractionf, const surfaceScalarField& phiHbyA,
    const surfaceScalarField& rAUf, const volScalarField& p)
{
    scalar all = 0;
    forAll (p.boundaryField(), patch)
    {
        const fvPatchScalarField& onPatch = p.boundaryField()[patch];
        if (!onPatch.coupled())
        {
            all += sum(voidFractionf.boundaryField()[patch]
                       * (phiHbyA.boundaryField()[patch]
                           - rAUf.boundaryField()[patch] * onPatch.patch().magSf() * onPatch.snGrad()));
        }
    }
    return all;
}

} // namespace

VoidFractionFlow::VoidFractionFlow(fvMesh& mesh, bool meshMoves, const FluidProperties& fluid, ModelType modelType,
    ViscousStress& viscousStress, PhaseTimers& timers)
    : mesh_(mesh),
      timers_(timers),
      pimple_(mesh),
      p_(readAndWritten("p", mesh), mesh),
      U_(readAndWritten("U", mesh), mesh),
      phi_(readFlux(U_)),
      alphaPhi_(
          IOobject("alphaPhi", mesh.time().timeName(), mesh, IOobject::READ_IF_PRESENT, IOobject::AUTO_WRITE), phi_),
      viscousStress_(viscousStress),
      sources_(mesh, fluid, modelType)
{
    requireDimensions(p_, sqr(dimVelocity), "the kinematic pressure, which is the pressure in Pa divided by rho");
    requireDimensions(U_, dimVelocity, "a velocity");
    requireDimensions(phi_, dimVolume / dimTime, "a flux of volume");
    setRefCell(p_, pimple_.dict(), pRefCell_, pRefValue_);
    mesh_.setFluxRequired(p_.name());
    if (meshMoves)
    {
        // Not by make_unique(), which would make a copy that is not written.
        Uf_.reset(new surfaceVectorField(readFaceVelocity(U_)));
        Uf_->oldTime();
        // Before the motion of the mesh first changes the values at its walls.
        U_.oldTime();
    }
}

void VoidFractionFlow::addTurbulence(const FluidProperties& fluid, const volScalarField& voidFraction, bool resumed)
{
    if (!fluid.turbulence.empty())
    {
        turbulence_ = newTurbulence({fluid, voidFraction, U_, phi_, alphaPhi_}, resumed);
        viscousStress_.add(*turbulence_);
    }
}

void VoidFractionFlow::updateAlphaPhi(const volScalarField& voidFraction)
{
    alphaPhi_ = fvc::interpolate(voidFraction) * phi_;
}

void VoidFractionFlow::meshMoved()
{
    phi_ = mesh_.Sf() & *Uf_;
    forAll (U_.boundaryField(), patch)
    {
        if (const fvPatchVectorField& onPatch = U_.boundaryField()[patch]; onPatch.fixesValue())
        {
            phi_.boundaryFieldRef()[patch] == (onPatch.patch().Sf() & onPatch);
        }
    }
    phi_ -= mesh_.phi();
}

void VoidFractionFlow::updateFaceVelocity()
{
    const surfaceVectorField normal(mesh_.Sf() / mesh_.magSf());
    *Uf_ = fvc::interpolate(U_);
    *Uf_ += normal * ((phi_ + mesh_.phi()) / mesh_.magSf() - (normal & *Uf_));
}

tmp<surfaceScalarField> VoidFractionFlow::fluxCorrection() const
{
    if (!Uf_)
    {
        return fvc::ddtCorr(U_, phi_);
    }
    const surfaceScalarField flux(mesh_.Sf() & Uf_->oldTime());
    const surfaceScalarField correction(flux - fvc::dotInterpolate(mesh_.Sf(), U_.oldTime()));
    // OpenFOAM's own ddtCorr() of a moving mesh compares the correction with the flux through faces at rest, so that it would
    // depend on the velocity of the observer.
    return fv::ddtScheme<vector>::New(mesh_, mesh_.ddtScheme("ddt(" + U_.name() + ')'))
               .ref()
               .fvcDdtPhiCoeff(U_, flux - mesh_.phi(), correction)
           * correction / mesh_.time().deltaT();
}

SolvedStep VoidFractionFlow::solve(ParticlesInFluid& particles)
{
    tmp<fvVectorMatrix> particleSource;
    while (pimple_.loop())
    {
        alphaPhi_ = particles.voidFractionf() * phi_;
        particleSource = particles.momentumSource(U_);
        const fvVectorMatrix UEqn(momentumEquation(particles, particleSource()));
        while (pimple_.correct())
        {
            correctPressure(particles, UEqn);
        }
        if (turbulence_ && pimple_.turbCorr())
        {
            const PhaseTimers::Scope timing = timers_.time("turbulence");
            turbulence_->correct(particles.voidFractionf() * phi_);
        }
    }
    if (Uf_)
    {
        updateFaceVelocity();
    }
    alphaPhi_ = particles.voidFractionf() * phi_;
    return particles.record(particleSource(), U_, p_, alphaPhi_);
}

// The layout shows the terms of the equations.
// clang-format off

fvVectorMatrix VoidFractionFlow::momentumEquation(
    const ParticlesInFluid& particles, const fvVectorMatrix& particleSource)
{
    const PhaseTimers::Scope timing = timers_.time("momentum");
    const volScalarField& voidFraction = particles.voidFraction();

    fvVectorMatrix UEqn
    (
        fvm::ddt(voidFraction, U_)
      + fvm::div(alphaPhi_, U_, "div(phi,U)")
      // alphaPhi has the flux of the last coupling step. Its continuity error must not act as a source of momentum.
      - fvm::Sp(fvc::ddt(voidFraction) + fvc::div(alphaPhi_), U_)
      - viscousStress_.implicitDivergence(U_)
     ==
        particleSource
    );
    sources_.addTo(UEqn, U_, voidFraction);
    if (acceleration_)
    {
        UEqn -= voidFraction*(*acceleration_);
    }
    UEqn.relax();
    sources_.constrain(UEqn);

    if (pimple_.momentumPredictor())
    {
        Foam::solve(UEqn == -particles.pressureFactor()*particles.pressureGradient(p_));
        sources_.correct(U_);
    }
    return UEqn;
}

void VoidFractionFlow::correctPressure(ParticlesInFluid& particles, const fvVectorMatrix& UEqn)
{
    const PhaseTimers::Scope timing = timers_.time("pressure");
    const volScalarField& pressureFactor = particles.pressureFactor();

    const volScalarField rAU("rAU", 1.0/UEqn.A());
    // U = HbyA - (pressureFactor/A) grad(p)
    const surfaceScalarField rAf("rAf", fvc::interpolate(rAU));
    const surfaceScalarField rAUf("rAUf", fvc::interpolate(pressureFactor)*rAf);

    volVectorField HbyA(constrainHbyA(rAU*UEqn.H(), U_, p_));
    surfaceScalarField phiHbyA("phiHbyA", fvc::flux(HbyA) + particles.voidFractionf()*rAf*fluxCorrection());

    constrainPressure(p_, U_, phiHbyA, rAUf);
    if (Uf_)
    {
        phiHbyA -= mesh_.phi();
    }
    particles.addMeanPressureGradient(phiHbyA, rAUf);
    if (p_.needReference() && isClosed(U_, p_))
    {
        particles.spreadImbalance();
    }
    else if (p_.needReference())
    {
        particles.spreadImbalance(outflow(particles.voidFractionf(), phiHbyA, rAUf, p_));
    }

    const surfaceScalarField pressureCoefficient("pressureCoefficient", particles.pressureCoefficient(rAUf));
    while (pimple_.correctNonOrthogonal())
    {
        fvScalarMatrix pEqn
        (
            fvm::laplacian(pressureCoefficient, p_)
         ==
            particles.explicitContinuity(phiHbyA)
        );

        pEqn.setReference(pRefCell_, pRefValue_);
        pEqn.solve(mesh_.solver(p_.select(pimple_.finalInnerIter())));

        if (pimple_.finalNonOrthogonalIter())
        {
            const surfaceScalarField gradient("gradient", pEqn.flux()/pressureCoefficient);
            phi_ = phiHbyA - rAUf*gradient;
            particles.setFlux(phi_, gradient);
        }
    }

    p_.relax();

    U_ = HbyA - rAU*pressureFactor*particles.pressureGradient(p_);
    U_.correctBoundaryConditions();
    sources_.correct(U_);
}

} // namespace clepsydra
