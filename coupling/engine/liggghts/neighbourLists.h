#pragma once

namespace clepsydra
{

class LiggghtsProgram;

/// Replaces LIGGGHTS' search for the neighbours of spheres with contact history (`newton off`, `neighbor ... bin`) by a
/// faster one that finds the same neighbours in the same order. Call when LIGGGHTS has started, before the first command of
/// the script.
void replaceNeighbourSearch(LiggghtsProgram& program);

} // namespace clepsydra
