#pragma once

#include "engine/particles.h"

#include "boundBox.H"
#include "dictionary.H"
#include "fvMesh.H"

namespace clepsydra
{

/// Before the engine starts: FatalIOError for a variable of the DEM script whose name says that it is a particle's diameter
/// and whose value is larger than the whole mesh. Lengths in mm are found by it.
/// \param variables  DEM/variables of couplingProperties
void requireParticlesWithinMesh(const Foam::dictionary& variables, const Foam::boundBox& mesh);

/// Sizes against each other, printed: particles, cells, smoothing bandwidth, mesh, cells of a rank. Collective.
/// FatalIOError where a particle is wider than the mesh is thin, or the smoothing bandwidth far longer than
/// the mesh (longer is a way to spread an isolated particle evenly). A warning
/// where particles are wider than what they are spread over, and for ranks with hardly any cells.
/// \param smoothingBandwidth  [m], 0 without smoothing
void checkCaseSizes(const Foam::fvMesh& mesh, const ParticlesView& particles, double smoothingBandwidth,
    const Foam::dictionary& couplingProperties);

} // namespace clepsydra
