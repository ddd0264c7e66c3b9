#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra
{

/// A folder whose name is a time.
struct TimeFolder
{
    double time; ///< [s]
    std::string name;
};

/// The time folders in a folder, in order of time; none where the folder does not exist. Unlike OpenFOAM's findTimes(),
/// which is collective for the file handlers collated and masterUncollated, this may be called on any rank alone.
/// \throws FileError where the folder cannot be read
std::vector<TimeFolder> timeFolders(const std::filesystem::path& folder);

} // namespace clepsydra
