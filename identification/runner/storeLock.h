#pragma once

#include <filesystem>
#include <ostream>

namespace clepsydra::identification
{

/// While it lives, this process alone makes runs in a store; another one that wants to waits until it has gone. Two that
/// make the same run would write into the same copy of the case.
///
/// The lock is flock(2) on <store>/lock; the system drops it when the process ends, however that is.
class StoreLock
{
public:
    /// \param progress  is reported the wait \throws std::runtime_error where the file cannot be locked
    StoreLock(const std::filesystem::path& store, std::ostream& progress);
    ~StoreLock();

    StoreLock(const StoreLock&) = delete;
    StoreLock& operator=(const StoreLock&) = delete;

private:
    int file_;
};

} // namespace clepsydra::identification
