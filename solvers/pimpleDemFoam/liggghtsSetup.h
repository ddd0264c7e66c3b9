#pragma once

#include "engine/liggghts/liggghtsEngine.h"
#include "couplingStep/couplingSettings.h"

namespace clepsydra
{

/// Settings for LIGGGHTS from the dictionary DEM of couplingProperties: the script, its variables and the group
/// changes.
///
/// FatalIOError that names file, entry and what is allowed where an entry is missing or wrong.
/// \param resumeFrom  the particles' part of a checkpoint, empty for a fresh start
/// \param writesNothing  true where the engine must not write files, including its log
LiggghtsSetup liggghtsSetup(
    const CouplingSettings& settings, const std::filesystem::path& resumeFrom, bool writesNothing = false);

} // namespace clepsydra
