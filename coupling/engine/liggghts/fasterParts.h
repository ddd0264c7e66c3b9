#pragma once

// Parts of LIGGGHTS in whose place the coupling has faster ones with the same results. Call the functions when LIGGGHTS has
// started, before the first command of the script.
namespace clepsydra
{

class LiggghtsProgram;

/// The evaluation of `pair_style gran model hertz tangential history`, also with `rolling_friction cdt`: hertzPairStyle.cpp.
void registerHertzPairStyle();

/// The search for neighbours of spheres with contact history (`newton off`, `neighbor ... bin`), which gives the same
/// neighbours in the same order: neighbourLists.cpp.
void replaceNeighbourSearch(LiggghtsProgram& program);

/// The evaluation of the contacts of `fix wall/gran mesh`: meshWallContacts.cpp.
void replaceMeshWallContacts(LiggghtsProgram& program);

} // namespace clepsydra
