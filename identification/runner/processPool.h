#pragma once

#include "runner/executor.h"

namespace clepsydra::identification
{

/// Up to so many child processes at a time. SIGINT and SIGTERM end the children and then this program; where the
/// signal's action does not end it, `run` throws std::runtime_error, for a run that was stopped has not failed.
class ProcessPool final : public Executor
{
public:
    /// \param processes  0: one per core
    ProcessPool(int processes, double timeLimit);

    void run(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd) override;

    int atOnce() const override
    {
        return processes_;
    }

private:
    void runUntilStopped(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd) const;

    int processes_;
    double timeLimit_;
};

} // namespace clepsydra::identification
