#pragma once

#include "couplingStep/couplingStep.h"
#include "couplingStep/viscousStress.h"

#include "pimpleControl.H"
#include "surfaceFields.H"
#include "volFields.H"

namespace clepsydra
{

/// The fluid between the particles: its fields, and one PIMPLE step of the equations in FluidCoupling.
class VoidFractionFlow
{
public:
    /// Reads p and U and, where the run was stopped, phi.
    VoidFractionFlow(Foam::fvMesh& mesh, const FluidProperties& fluid);

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

    /// Solves the fluid's equations over one coupling step.
    SolvedFluid solve(CouplingStep& couplingStep);

private:
    Foam::fvVectorMatrix momentumEquation(const CouplingStep& couplingStep,
        const Foam::surfaceScalarField& voidFractionf, const Foam::fvVectorMatrix& particleSource);
    /// \return the implicit part of d(eps)/dt as a flux [m3/s]
    Foam::tmp<Foam::surfaceScalarField> correctPressure(
        CouplingStep& couplingStep, const Foam::surfaceScalarField& voidFractionf, const Foam::fvVectorMatrix& UEqn);

    Foam::fvMesh& mesh_;
    Foam::pimpleControl pimple_;
    Foam::volScalarField p_;
    Foam::volVectorField U_;
    Foam::surfaceScalarField phi_;
    Foam::label pRefCell_ = 0;
    Foam::scalar pRefValue_ = 0;
    const ViscousStress viscousStress_;
};

} // namespace clepsydra
