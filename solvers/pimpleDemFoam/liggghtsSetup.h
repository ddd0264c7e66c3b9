#pragma once

#include "engine/liggghts/liggghtsEngine.h"
#include "couplingStep/couplingSettings.h"

namespace clepsydra
{

/// What the dictionary DEM of couplingProperties says to LIGGGHTS: the script, its variables, the group changes.
///
/// FatalIOError naming file, entry and what is allowed where something is missing or wrong.
/// \param resumeFrom  the particles' part of a checkpoint, empty for a fresh start.
/// \param writesNothing  the engine leaves no files, its log neither
LiggghtsSetup liggghtsSetup(
    const CouplingSettings& settings, const std::filesystem::path& resumeFrom, bool writesNothing = false);

} // namespace clepsydra
