#pragma once

#include <filesystem>
#include <ostream>

namespace clepsydra::identification
{

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
