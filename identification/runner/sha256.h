#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace clepsydra::identification
{

/// SHA-256 (FIPS 180-4) of some bytes, as 64 hexadecimal digits. Written here because none of the libraries that the
/// project uses has one.
std::string sha256(std::string_view bytes);

/// Of a file's content, or of names and contents of all files in a folder. Links count by where they point.
/// \param leaveOut  names of files and folders that do not count
std::string sha256OfPath(const std::filesystem::path& path, const std::string& leaveOut = "");

} // namespace clepsydra::identification
