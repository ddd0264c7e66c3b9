#pragma once

#include <vector>

namespace clepsydra
{

class LiggghtsProgram;

/// Deletes particles of this rank in the same way as LIGGGHTS' own fixes. Collective. \return what is left on all ranks
long removeParticles(LiggghtsProgram& program, const std::vector<int>& ids);

/// Lets LIGGGHTS run without particles. It searches particles and fixes for the first material, and stops where it finds
/// none, as when all particles have left.
void allowNoParticles(LiggghtsProgram& program);

} // namespace clepsydra
