#pragma once

#include "files/wholeFile.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace clepsydra::identification
{

/// SHA-256 of a file's content, or of names and contents of all files in a folder. Links count by where they point.
/// \param leaveOut  names of files and folders that do not count
/// \throws FileError
std::string sha256OfPath(const std::filesystem::path& path, const std::string& leaveOut = "");

/// \throws FileError where it cannot be read to its end
std::string textOf(const std::filesystem::path& file);

/// Gives a folder, whose files have been written wholly, its name. An older one of that name is replaced.
/// \throws FileError
void renameWhole(const std::filesystem::path& folder, const std::filesystem::path& name);

/// Less room on a disk than this, and whatever is written there may have been cut short [bytes].
constexpr std::uintmax_t leastRoom = 256 * 1024;

/// \throws FileError where less than leastRoom is left on the disk of a folder \param doing  what is in doubt then
void requireRoom(const std::filesystem::path& folder, const std::string& doing);

} // namespace clepsydra::identification
