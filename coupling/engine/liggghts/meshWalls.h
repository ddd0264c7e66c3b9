#pragma once

#include "engine/demEngine.h"

#include <vector>

namespace clepsydra
{

class LiggghtsProgram;

/// The triangles of this rank that belong to meshes which `fix move/mesh` moves. Local.
std::vector<WallTriangle> trianglesOfMovingMeshes(const LiggghtsProgram& program);

} // namespace clepsydra
