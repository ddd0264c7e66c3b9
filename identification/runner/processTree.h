#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// A program with all processes that it starts, including children that have left its process group or lost their
/// parent.
///
/// A separate process watches the program and inherits every orphan (PR_SET_CHILD_SUBREAPER). When the program ends,
/// when it is asked to end, or when the calling process has died (even by SIGKILL), all remaining processes receive
/// SIGTERM and, after a grace period, SIGKILL.
class ProcessTree
{
public:
    /// \param command  program and arguments; they are not interpreted by a shell
    /// \param log  file that receives the program's output
    /// \param grace  time between SIGTERM and SIGKILL
    /// \throws std::runtime_error if no process can be started
    ProcessTree(const std::vector<std::string>& command, const std::filesystem::path& folder,
        const std::filesystem::path& log, std::chrono::milliseconds grace);

    /// Ends all processes that still run, and waits for them.
    ~ProcessTree();

    ProcessTree(const ProcessTree&) = delete;
    ProcessTree& operator=(const ProcessTree&) = delete;

    /// The program's exit status (128 + signal number if a signal ended it); empty while any of its processes runs.
    std::optional<int> status();

    /// Tells all processes to end, and returns immediately.
    void end();

private:
    pid_t watcher_;
    std::optional<int> status_;
};

} // namespace clepsydra::identification
