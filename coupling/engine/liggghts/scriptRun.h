#pragma once

#include "engine/liggghts/script.h"
#include "engine/liggghts/setup.h"

#include <vector>

namespace clepsydra
{

class LiggghtsProgram;
class OutputFiles;

/// Sets the variables of a run and executes its script; where the run is resumed, with the checkpoint in the place of
/// the commands whose result it holds, see LiggghtsSetup::resumeFrom.
/// \return the commands that were executed, each with the values of its variables
/// \throws DemEngineError as LiggghtsEngine's constructor
std::vector<ScriptCommand> runScript(LiggghtsProgram& program, OutputFiles& outputFiles, const LiggghtsSetup& setup);

} // namespace clepsydra
