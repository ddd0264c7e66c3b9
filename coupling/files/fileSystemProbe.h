#pragma once

#include <filesystem>

namespace clepsydra
{

/// Does with a small file of the folder what a checkpoint will do with large ones: links to a pipe, writes, syncs and
/// renames. The file is removed. A run that calls this at its start does not compute for hours before it learns that
/// the file system cannot hold a checkpoint.
/// \param name  of the file, a different one for each process
/// \throws FileError that names the folder, what failed, and what is allowed
void probeFileSystem(const std::filesystem::path& folder, const std::string& name);

} // namespace clepsydra
