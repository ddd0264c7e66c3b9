#pragma once

#include "runner/executor.h"

namespace clepsydra::identification
{

/// Runs all jobs as one Slurm job array and returns when the array has ended. The work folder must be on a file system
/// that the nodes share. A signal that stops this program (SIGINT, SIGTERM, SIGHUP) cancels the array.
class SlurmArray final : public Executor
{
public:
    /// \param processes  number of tasks at a time; 0: no limit
    /// \param options  further options of sbatch
    /// \param timeLimit  wall-clock limit of one job [s]; 0: no limit
    SlurmArray(int processes, std::vector<std::string> options, std::filesystem::path work, double timeLimit);

    /// \throws std::runtime_error if sbatch fails and no task has reported
    void run(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd) override;

    int atOnce() const override
    {
        return processes_ > 0 ? processes_ : 1;
    }

private:
    int processes_;
    std::vector<std::string> options_;
    std::filesystem::path work_;
    double timeLimit_;
};

} // namespace clepsydra::identification
