#pragma once

#include <filesystem>
#include <vector>

namespace clepsydra
{

class LiggghtsProgram;

/// Gives scripts the command `fix ID all balance N threshold`, which LIGGGHTS 3.8 lacks: the boxes of the ranks become
/// narrower where the particles are. At the start, and once in N DEM steps when neighbours are searched, the particles of
/// the busiest rank are compared with the mean; where their ratio is above the threshold, each direction is cut so that an
/// equal number of particles lies between neighbouring cuts, as far as the busiest rank gets fewer by it. The value of the
/// fix, `f_ID`, is the ratio. Call it when LIGGGHTS has started, before the first command of the script.
void allowUnequalSubdomains(LiggghtsProgram& program);

/// Writes the boxes of the ranks beside a checkpoint of this name. Only one rank calls it.
/// \return the file; none where all boxes have the same size
/// \throws FileError
std::vector<std::filesystem::path> writeSubdomains(
    const LiggghtsProgram& program, const std::filesystem::path& checkpoint);

/// Takes over the boxes that writeSubdomains() has written, for the commands that follow; where the ranks are arranged
/// otherwise than when they were written, all boxes have the same size.
/// \throws DemEngineError for a file that is none of writeSubdomains()
/// \throws FileError where the file is there and cannot be read
void readSubdomains(LiggghtsProgram& program, const std::filesystem::path& checkpoint);

} // namespace clepsydra
