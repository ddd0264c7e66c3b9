#pragma once

#include "runner/executor.h"

#include <chrono>

namespace clepsydra::identification
{

/// Up to so many runs at a time, each with all the processes that it starts (ProcessTree). SIGINT, SIGTERM and SIGHUP end
/// them and then this program; where the signal's action does not end it, `run` throws std::runtime_error, for a run that
/// was stopped has not failed.
class ProcessPool final : public Executor
{
public:
    /// \param processes  0: one per core
    /// \param grace  between SIGTERM and SIGKILL, for a run that is to end
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
