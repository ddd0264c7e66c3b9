#pragma once

#include "couplingStep/viscousStress.h"

#include <memory>
#include <string>

namespace clepsydra
{

/// The fields to which a turbulence model refers as long as it exists.
struct TurbulentFluid
{
    const FluidProperties& properties;
    const Foam::volScalarField& voidFraction;
    const Foam::volVectorField& U;
    /// Flux of U [m3/s].
    const Foam::surfaceScalarField& phi;
    /// Initial value of the argument of FluidTurbulence::correct().
    const Foam::surfaceScalarField& alphaPhi;
};

/// Creates the model that constant/turbulenceProperties selects.
/// \param resumed  true where the fields are those of a checkpoint. The eddy viscosity is then left as it was read, since
/// some models (kOmegaSST) compute it during a step from values that are overwritten at the end of the step.
using NewFluidTurbulence = FluidTurbulence*(const TurbulentFluid& fluid, bool resumed);
constexpr const char* nameOfNewFluidTurbulence = "clepsydraNewFluidTurbulence";

/// Reads constant/turbulenceProperties, which may be absent. FatalIOError for anything but laminar flow and the models
/// that `-listModels` lists.
/// \return the model as it is reported, such as "RAS kEpsilon"; empty for laminar flow
std::string readTurbulence(const Foam::Time& time);

/// Loads the library with the models and creates the one that constant/turbulenceProperties selects.
/// \param resumed  see NewFluidTurbulence
std::unique_ptr<FluidTurbulence> newTurbulence(const TurbulentFluid& fluid, bool resumed);

} // namespace clepsydra
