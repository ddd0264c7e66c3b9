#pragma once

#include "couplingStep/particlesInFluid.h"
#include "couplingStep/viscousStress.h"
#include "fluidSources.h"

#include "pimpleControl.H"
#include "surfaceFields.H"
#include "volFields.H"

namespace clepsydra
{

/// The fluid between the particles: its fields, and one PIMPLE step of the equations in ParticlesInFluid.
class VoidFractionFlow
{
public:
    /// Reads p and U, where the run was stopped also phi, and the sources. FatalError that names the file where a field
    /// has wrong dimensions.
    /// \param meshMoves  whether meshMoved() will be called
    VoidFractionFlow(Foam::fvMesh& mesh, bool meshMoves, const FluidProperties& fluid, ModelType modelType,
        ViscousStress& viscousStress, PhaseTimers& timers);

    /// Creates the turbulence model, where the fluid has one, and adds it to the stress. Call before CouplingStep::start(),
    /// whose forces contain the stress. \param resumed  see NewFluidTurbulence
    void addTurbulence(const FluidProperties& fluid, const Foam::volScalarField& voidFraction, bool resumed);

    /// Interstitial velocity [m/s].
    Foam::volVectorField& U()
    {
        return U_;
    }

    /// Kinematic pressure without its hydrostatic part [m2/s2].
    const Foam::volScalarField& p() const
    {
        return p_;
    }

    /// Flux of U, relative to the mesh where it moves [m3/s].
    const Foam::surfaceScalarField& phi() const
    {
        return phi_;
    }

    /// Sets the registered field alphaPhi, the flux of fluid through the faces as a volume per time [m3/s], to that of the
    /// present phi. Call before the first step; solve() does so after each.
    void updateAlphaPhi(const Foam::volScalarField& voidFraction);

    /// Takes the velocity on the faces as flux through the faces of the mesh as it is now. Call when the mesh has moved,
    /// before solve(). phi is relative to the mesh from then on. OpenFOAM's `correctPhi` is not needed: the momentum equation
    /// subtracts the continuity error of this flux, and the pressure equation of the same step replaces it.
    void meshMoved();

    /// The flux of fluid of the last updateAlphaPhi() or solve() [m3/s].
    const Foam::surfaceScalarField& alphaPhi() const
    {
        return alphaPhi_;
    }

    /// Adds an acceleration of the fluid to the momentum equation, or none where it is null. It must exist as long as
    /// solve() is called.
    void setAcceleration(const Foam::volVectorField* acceleration)
    {
        acceleration_ = acceleration;
    }

    /// Solves the fluid's equations over one coupling step.
    SolvedStep solve(ParticlesInFluid& particles);

private:
    /// The part of the velocity on the faces at the end of the last step that is lost in its interpolation between cells, as a
    /// flux per time [m3/s2].
    Foam::tmp<Foam::surfaceScalarField> fluxCorrection() const;
    /// Stores the velocity on the faces, which is not known from phi when the faces have turned.
    void updateFaceVelocity();
    Foam::fvVectorMatrix momentumEquation(
        const ParticlesInFluid& particles, const Foam::fvVectorMatrix& particleSource);
    void correctPressure(ParticlesInFluid& particles, const Foam::fvVectorMatrix& UEqn);

    Foam::fvMesh& mesh_;
    PhaseTimers& timers_;
    Foam::pimpleControl pimple_;
    Foam::volScalarField p_;
    Foam::volVectorField U_;
    Foam::surfaceScalarField phi_;
    Foam::surfaceScalarField alphaPhi_;
    /// Velocity on the faces, with the flux phi [m/s]; null where the mesh is at rest.
    std::unique_ptr<Foam::surfaceVectorField> Uf_;
    Foam::label pRefCell_ = 0;
    Foam::scalar pRefValue_ = 0;
    ViscousStress& viscousStress_;
    const FluidSources sources_;
    std::unique_ptr<FluidTurbulence> turbulence_; // null in laminar flow
    const Foam::volVectorField* acceleration_ = nullptr;
};

} // namespace clepsydra
