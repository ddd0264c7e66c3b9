#pragma once

#include "engine/demEngine.h"
#include "forces/forceModel.h"

#include "fvMesh.H"

#include <optional>

namespace clepsydra
{

/// The time scales that a run's steps must resolve, and those steps, over all ranks [s]. A time scale that cannot be
/// determined (no particles yet, no contact material in the engine's script, no fluid) is empty.
struct DemTimeScales
{
    /// Speed of approach, slip and flow to which three of the time scales refer [m/s].
    static constexpr double speed = 1.0;

    double demStep;
    double couplingTimeStep;
    long particles;
    /// Rayleigh time, the shortest over all particles and materials.
    std::optional<double> rayleigh;
    /// Duration of a Hertz collision of two equal particles at `speed`, the shortest over all particles and materials.
    std::optional<double> collision;
    /// Relaxation time of an isolated particle with the slip `speed` and Schiller & Naumann's drag, the shortest over
    /// all particles. Of parcels it is that of one real particle.
    std::optional<double> relaxation;
    /// Time step at which a uniform flow of `speed` along an axis has the Courant number one in some cell.
    std::optional<double> courant;
};

/// Collective. \param fluid  null for DEM only. \pre the engine is initialised
/// \param coarseGraining  see CouplingSettings::coarseGraining()
DemTimeScales demTimeScales(DemEngine& engine, double couplingTimeStep, const FluidProperties* fluid,
    const Foam::fvMesh& mesh, double coarseGraining = 1);

} // namespace clepsydra
