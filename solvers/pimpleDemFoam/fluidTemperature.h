#pragma once

#include "couplingStep/heatExchange.h"
#include "couplingStep/particlesInFluid.h"
#include "couplingStep/viscousStress.h"
#include "engine/demEngine.h"

#include "surfaceFields.H"
#include "volFields.H"

#include <memory>

namespace clepsydra
{

/// The temperature of the fluid between the particles,
///
///     d(eps rho Cp T)/dt + div(eps rho Cp U T) - div(eps kappa_eff grad T) = heat that the particles give
///
/// with kappa_eff = kappa + rho Cp nu_t/Prt of the eddy viscosity nu_t, and the heat that they exchange. eps is the void
/// fraction whose change the continuity equation holds, so that heat is conserved and a uniform temperature remains
/// uniform. It differs from that of the particles' present positions by what VoidFractionRate anticipates.
class FluidTemperature
{
public:
    /// Reads T. FatalError that names the file where the field has wrong dimensions, and where the engine has no
    /// temperatures. \pre the engine is not initialised
    FluidTemperature(const Foam::fvMesh& mesh, const Energy& energy, const FluidProperties& fluid, DemEngine& engine);

    /// Buoyancy in the momentum equation of the next step by Boussinesq's approximation, -beta (T - TRef) g [m/s2]: a
    /// force per mass of fluid. Null where the density does not depend on the temperature.
    const Foam::volVectorField* buoyancy() const
    {
        return buoyancy_.get();
    }

    /// Solves for T over the coupling step whose flow has been solved, and gives the particles their heat. Collective.
    /// \param alphaPhi  flux of fluid in the continuity equation [m3/s]
    /// \param turbulence  null in laminar flow
    void solve(
        ParticlesInFluid& particles, const Foam::surfaceScalarField& alphaPhi, const FluidTurbulence* turbulence);

    /// Lets each cell keep the heat that it holds of particles while its volume changes. Call when the mesh has moved.
    void meshMoved();

private:
    /// Heat that leaves the fluid through the boundary of this rank in the step [J].
    /// \param diffusivity  of T through the faces, times the void fraction [m2/s]
    double throughBoundary(const Foam::surfaceScalarField& alphaPhi, const Foam::surfaceScalarField& diffusivity) const;
    void updateBuoyancy();

    const Foam::fvMesh& mesh_;
    const ThermalProperties thermal_;
    const Vector3d gravity_;
    /// rho Cp [J/(m3 K)].
    const double capacityPerVolume_;
    DemEngine& engine_;
    ParticleTemperatures& temperatures_;
    HeatExchange exchange_;
    Foam::volScalarField T_;
    std::unique_ptr<Foam::volVectorField> buoyancy_;
};

} // namespace clepsydra
