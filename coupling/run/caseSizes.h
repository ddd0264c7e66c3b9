#pragma once

#include "engine/beads.h"

#include "boundBox.H"
#include "dictionary.H"
#include "fvMesh.H"

namespace clepsydra
{

/// Before the engine starts: FatalIOError for a variable of the DEM script whose name says that it is a bead's diameter
/// and whose value is larger than the whole mesh. Lengths in mm are found by it.
/// \param variables  DEM/variables of couplingProperties
void requireBeadsWithinMesh(const Foam::dictionary& variables, const Foam::boundBox& mesh);

/// Sizes against each other, printed: beads, cells, smoothing length, mesh, cells of a rank. Collective.
/// FatalIOError where a bead is wider than the mesh is thin, or the smoothing length far longer than
/// the mesh (longer is a way to spread a lone bead evenly). A warning
/// where beads are wider than what they are spread over, and for ranks with hardly any cells.
/// \param smoothingLength  [m], 0 without smoothing
void checkCaseSizes(const Foam::fvMesh& mesh, const BeadsView& beads, double smoothingLength,
    const Foam::dictionary& couplingProperties);

} // namespace clepsydra
