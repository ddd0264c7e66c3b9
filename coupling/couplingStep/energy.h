#pragma once

#include "couplingStep/couplingSettings.h"
#include "engine/particleTemperatures.h"

namespace clepsydra
{

/// What the equation of the fluid's temperature needs, from constant/transportProperties.
struct ThermalProperties
{
    /// Cp [J/(kg K)].
    double specificHeat;
    /// kappa [W/(m K)].
    double conductivity;
    /// Coefficient of thermal expansion beta [1/K]; 0 for a fluid whose density does not depend on its temperature.
    double expansion = 0;
    /// TRef [K], the temperature at which the density is that of transportProperties.
    double referenceTemperature = 0;
    /// Prt, the eddy viscosity over the eddy diffusivity of heat; only with a turbulence model.
    double turbulentPrandtlNumber = 0.85;
};

/// The temperatures of fluid and particles, which a case has where couplingProperties has the dictionary `energy`.
///
///     energy
///     {
///         heatTransferModel   Gunn;
///         particleCp          840;    // [J/(kg K)]
///         particleTemperature 293;    // [K], of particles that are created, inserted, or read without one
///     }
struct Energy
{
    /// The dictionary `energy`.
    Foam::dictionary dict;
    ThermalProperties fluid;
    HeatOfParticles particles;
    /// Diameter of a sphere of the DEM script over that of the particles that it stands for.
    double coarseGraining = 1;
};

/// Whether the case has temperatures. Without fluid the dictionary `energy` has no effect.
bool hasEnergy(const CouplingSettings& settings);

/// Reads the dictionary `energy`, and `Cp`, `kappa`, `Prt`, `beta` and `TRef` of transportProperties; empty where the
/// case has no temperatures. FatalIOError that names the file, the entry and what is allowed where an entry is missing
/// or wrong, or has no effect.
/// \param turbulent  whether the case has a turbulence model, without which `Prt` has no effect
std::optional<Energy> readEnergy(
    const CouplingSettings& settings, const Foam::dictionary& transportProperties, bool turbulent);

} // namespace clepsydra
