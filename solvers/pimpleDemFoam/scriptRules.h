#pragma once

#include "couplingStep/couplingSettings.h"
#include "engine/liggghts/scriptFacts.h"

#include "fvMesh.H"

namespace clepsydra
{

/// What the DEM script may hold. With a fluid, everything that is not known to work with one is a FatalIOError, which
/// names the line of the script and the word by which the entry `allowedInScript` of DEM allows it. Without fluid only
/// a change of the DEM step is refused. Walls may move where the fluid's walls move alike, see wallsWithoutPatch().
/// Collective.
void requireKnownScript(
    const CouplingSettings& settings, const ScriptFacts& facts, const Foam::fvMesh& mesh, bool meshMoves);

/// Requires that the particles' space is periodic exactly where cyclic patches make the mesh periodic, with the same
/// box. FatalIOError that names the lines of the script, the patches, both boxes and what is allowed. Collective.
void requireSamePeriodicBox(const CouplingSettings& settings, const ScriptFacts& facts, const Foam::fvMesh& mesh);

/// Warns of contact coefficients that have no effect because no model of the script reads them.
/// \param properties  as unreadProperties() returns them
void warnOfUnreadProperties(const std::vector<ScriptCommand>& properties);

} // namespace clepsydra
