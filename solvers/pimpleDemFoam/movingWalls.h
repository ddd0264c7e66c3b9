#pragma once

#include "engine/liggghts/wallMotions.h"

#include "fvMesh.H"

#include <string>
#include <vector>

namespace clepsydra
{

/// A wall that moves in the DEM script without a patch that moves alike.
struct UnmatchedWall
{
    WallMotion wall;
    std::string reason;
};

/// Compares walls that move in the DEM script with the velocity of the fluid at its walls. The mesh does not move, so that
/// a wall may move only along itself: a drum without lifters, a belt, a plane. It is matched where the file U gives a wall
/// patch, and all of it, the same velocity within 0.1 %, and that velocity is along the patch and constant over the run. A
/// warning where the patch has a condition of which this is not known. Collective. Reads the file U where there is such a wall.
std::vector<UnmatchedWall> wallsWithoutPatch(const std::vector<WallMotion>& walls, const Foam::fvMesh& mesh);

/// Warns of wall patches that move while no wall of the DEM script moves alike. Collective. Reads the file U.
void warnOfPatchesWithoutWall(const Foam::fvMesh& mesh, const std::vector<WallMotion>& walls);

} // namespace clepsydra
