#pragma once

#include "engine/demEngine.h"
#include "forces/forceModel.h"

#include "fvMesh.H"

#include <optional>

namespace clepsydra
{

/// The times that a run's steps must resolve, and those steps, over all ranks [s]. What cannot be known (no particles
/// yet, no contact material in the engine's script, no fluid) is empty.
struct DemTimeScales
{
    /// The speed of approach, slip and flow that three of them are stated for [m/s].
    static constexpr double speed = 1.0;

    double demStep;
    double couplingTimeStep;
    long particles;
    /// Rayleigh time, the shortest of any particle in any material.
    std::optional<double> rayleigh;
    /// Hertz collision of two alike particles at `speed`, the shortest of any particle in any material.
    std::optional<double> collision;
    /// Relaxation of an isolated particle that slips at `speed`, by Schiller-Naumann's drag, the shortest of any particle.
    std::optional<double> relaxation;
    /// The step at which a uniform flow of `speed` along an axis has the Courant number one in some cell.
    std::optional<double> courant;
};

/// Collective. \param fluid  null in a dry run. \pre the engine is initialised.
DemTimeScales demTimeScales(
    DemEngine& engine, double couplingTimeStep, const FluidProperties* fluid, const Foam::fvMesh& mesh);

} // namespace clepsydra
