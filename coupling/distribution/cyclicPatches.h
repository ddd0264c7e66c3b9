#pragma once

#include "engine/periodicBox.h"

#include "polyMesh.H"

#include <array>
#include <string>

namespace clepsydra
{

/// The directions in which cyclic patches make the mesh periodic. Particles have images there, so the patches of a pair
/// must be planes perpendicular to an axis at the two ends of the mesh, and each a translation of the other.
///
/// FatalError that names the patch and what is allowed for any other patch that couples cells, except those between
/// ranks. Collective.
PeriodicBox periodicBoxOf(const Foam::polyMesh& mesh);

/// The names of the patches that make the mesh periodic along each axis, as "'left' and 'right'"; empty where it is not
/// periodic. Otherwise as periodicBoxOf().
std::array<std::string, 3> cyclicPatchesAlongAxes(const Foam::polyMesh& mesh);

} // namespace clepsydra
