#pragma once

#include "engine/particles.h"

#include "boundBox.H"
#include "dictionary.H"
#include "fvMesh.H"

namespace clepsydra
{

/// Checks variables of the DEM script before the engine starts. FatalIOError where a variable's name says that it is a
/// particle's diameter and its value exceeds the whole mesh, as lengths in mm do.
/// \param variables  DEM/variables of couplingProperties
/// \param mesh  bounds of the mesh
void requireParticlesWithinMesh(const Foam::dictionary& variables, const Foam::boundBox& mesh);

/// Prints and compares sizes: particles, cells, smoothing bandwidth, mesh, and the number of cells of a rank.
/// Collective. FatalIOError where a particle is wider than the smallest extent of the mesh, or where the smoothing
/// bandwidth is much larger than the mesh (somewhat larger ones are used to spread the disturbance of an isolated
/// particle evenly). Warnings where particles are wider than the cells and the bandwidth, and for ranks with hardly any
/// cells.
/// \param smoothingBandwidth  [m], 0 without smoothing
void checkCaseSizes(const Foam::fvMesh& mesh, const ParticlesView& particles, double smoothingBandwidth,
    const Foam::dictionary& couplingProperties);

} // namespace clepsydra
