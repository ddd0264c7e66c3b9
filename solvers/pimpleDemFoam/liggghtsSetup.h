#pragma once

#include "checkpoint/checkpoints.h"
#include "engine/liggghts/setup.h"
#include "couplingStep/couplingSettings.h"

namespace clepsydra
{

/// Settings for LIGGGHTS from the dictionary DEM of couplingProperties: the script, its variables and the group
/// changes.
///
/// FatalIOError that names file, entry and what is allowed where an entry is missing or wrong.
/// \param writesNothing  true where the engine must not write files, including its log
LiggghtsSetup liggghtsSetup(const CouplingSettings& settings, bool writesNothing = false);

/// Where the run is resumed, the engine goes on from the checkpoint.
void resume(LiggghtsSetup& setup, const Checkpoints& checkpoints);

} // namespace clepsydra
