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
/// A separate process watches the program and inherits every orphan (PR_SET_CHILD_SUBREAPER). When the program ends or
/// exceeds its time limit, when this object is destroyed, or when the calling process has ended (even by SIGKILL), all
/// remaining processes receive SIGTERM and, after a grace period, SIGKILL.
class ProcessTree
{
public:
    /// \param command  program and arguments; they are not interpreted by a shell
    /// \param log  file that receives the program's output, relative to the folder
    /// \param timeLimit  wall-clock limit [s]; 0: no limit
    /// \param grace  time between SIGTERM and SIGKILL
    /// \throws std::runtime_error if no process can be started
    ProcessTree(const std::vector<std::string>& command, const std::filesystem::path& folder, const std::string& log,
        double timeLimit, std::chrono::milliseconds grace);

    /// Tells all processes to end, and does not wait for them.
    ~ProcessTree();

    ProcessTree(const ProcessTree&) = delete;
    ProcessTree& operator=(const ProcessTree&) = delete;

    /// The program's exit status (124 if it exceeded its time limit, 128 + signal number if a signal ended it); empty
    /// while any of its processes runs.
    std::optional<int> status();

    /// Wall-clock time since the start.
    double seconds() const;

private:
    std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
    pid_t watcher_;
    std::optional<int> status_;
};

} // namespace clepsydra::identification
