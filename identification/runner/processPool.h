#pragma once

#include "runner/executor.h"

#include <chrono>

namespace clepsydra::identification
{

/// Runs a limited number of jobs at a time; each owns all processes that it starts (ProcessTree). SIGINT, SIGTERM and
/// SIGHUP end the jobs and then this program. If the signal does not end the program, `run` throws std::runtime_error,
/// because a stopped job has not failed.
class ProcessPool final : public Executor
{
public:
    /// \param processes  number of jobs at a time; 0: one per core
    /// \param timeLimit  wall-clock limit of one job [s]; 0: no limit
    /// \param grace  time between SIGTERM and SIGKILL when a job is ended
    ProcessPool(int processes, double timeLimit, std::chrono::milliseconds grace = std::chrono::seconds(5));

    void run(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd) override;

    int atOnce() const override
    {
        return processes_;
    }

private:
    void runUntilStopped(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd) const;

    int processes_;
    double timeLimit_;
    std::chrono::milliseconds grace_;
};

} // namespace clepsydra::identification
