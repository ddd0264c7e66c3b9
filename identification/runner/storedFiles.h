#pragma once

#include "files/wholeFile.h"

#include <filesystem>
#include <ostream>
#include <string>

namespace clepsydra::identification
{

/// SHA-256 of a file's content, or of the names and contents of all files in a folder. A link enters with its target's
/// name.
/// \param leaveOut  name of files and folders that are left out
/// \throws FileError if a file cannot be read
std::string sha256OfPath(const std::filesystem::path& path, const std::string& leaveOut = "");

using clepsydra::textOf; // of a file, beside those of numbers

/// Gives a completely written folder its final name. An older folder of that name is replaced.
/// \throws FileError if it cannot be renamed
void renameWhole(const std::filesystem::path& folder, const std::filesystem::path& name);

/// During its lifetime no other process makes runs in the same store; two processes that made the same run would write
/// into the same copy of the case. The lock is flock(2) on <store>/lock, which the system releases when the process
/// ends.
class StoreLock
{
public:
    /// Waits until the lock is free. \param progress  stream that receives a message if the lock is taken
    /// \throws std::runtime_error if the file cannot be locked
    StoreLock(const std::filesystem::path& store, std::ostream& progress);
    ~StoreLock();

    StoreLock(const StoreLock&) = delete;
    StoreLock& operator=(const StoreLock&) = delete;

private:
    int file_;
};

} // namespace clepsydra::identification
