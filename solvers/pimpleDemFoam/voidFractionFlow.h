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
    VoidFractionFlow(Foam::fvMesh& mesh, const FluidProperties& fluid, ModelType modelType,
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

    /// Flux of U [m3/s].
    const Foam::surfaceScalarField& phi() const
    {
        return phi_;
    }

    /// Sets the registered field alphaPhi, the flux of fluid through the faces as a volume per time [m3/s], to that of the
    /// present phi. Call before the first step; solve() does so after each.
    void updateAlphaPhi(const Foam::volScalarField& voidFraction);

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
    Foam::label pRefCell_ = 0;
    Foam::scalar pRefValue_ = 0;
    ViscousStress& viscousStress_;
    const FluidSources sources_;
    std::unique_ptr<FluidTurbulence> turbulence_; // null in laminar flow
    const Foam::volVectorField* acceleration_ = nullptr;
};

} // namespace clepsydra
