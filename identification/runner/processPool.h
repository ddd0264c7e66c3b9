#pragma once

#include "runner/executor.h"

namespace clepsydra::identification
{

/// Up to so many child processes at a time. SIGINT and SIGTERM end the children and then this program.
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
    int processes_;
    double timeLimit_;
};

} // namespace clepsydra::identification
