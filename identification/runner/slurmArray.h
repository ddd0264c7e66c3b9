#pragma once

#include "runner/executor.h"

namespace clepsydra::identification
{

/// All jobs as one array of Slurm; returns when the array has ended. Needs a work folder that the nodes share. What stops
/// this program (SIGINT, SIGTERM, SIGHUP) cancels the array.
class SlurmArray final : public Executor
{
public:
    /// \param processes  tasks at a time; 0: as many as Slurm gives
    /// \param options  further words for sbatch
    SlurmArray(int processes, std::vector<std::string> options, std::filesystem::path work, double timeLimit);

    /// \throws std::runtime_error if sbatch itself fails
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
