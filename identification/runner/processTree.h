#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// A program with all that it starts: a child that has left its process group, or whose parent has gone, belongs to it.
///
/// A process of its own watches over it, which inherits every orphan (PR_SET_CHILD_SUBREAPER). When the program ends, is
/// to end, or when the process that asked for it is gone (be it by SIGKILL), whatever is left gets SIGTERM, after a time of
/// grace SIGKILL, and is waited for.
class ProcessTree
{
public:
    /// \param words  program and arguments; no shell reads them \param log  takes what the program writes
    /// \throws std::runtime_error where no process can be started
    ProcessTree(const std::vector<std::string>& words, const std::filesystem::path& folder,
        const std::filesystem::path& log, std::chrono::milliseconds grace);

    /// Ends what still runs, and waits for it.
    ~ProcessTree();

    ProcessTree(const ProcessTree&) = delete;
    ProcessTree& operator=(const ProcessTree&) = delete;

    /// The program's status, 128 + signal for one that a signal ended; nothing while any of its processes is left.
    std::optional<int> status();

    /// Asks all its processes to end; returns at once.
    void end();

private:
    pid_t watcher_;
    std::optional<int> status_;
};

} // namespace clepsydra::identification
