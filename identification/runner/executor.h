#pragma once

#include "study/study.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// A command to be run in a folder, its output in `log` there.
struct Job
{
    std::filesystem::path folder;
    std::string command;
};

/// How a job ended.
struct JobEnd
{
    std::size_t job = 0;
    int status = 0; // exit status; 124: above the time limit; 125: Slurm's task left none; 128 + signal
    double seconds = 0.0;
};

/// Runs jobs, several at a time.
class Executor
{
public:
    Executor() = default;
    virtual ~Executor() = default;
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;

    /// Returns when all have ended. \param onEnd  is called after each, in this thread
    virtual void run(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd) = 0;

    virtual int atOnce() const = 0;
};

/// `pool`: processes of this machine; `slurm`: a job array.
/// \param timeLimit  of a job [s]; 0: none
std::unique_ptr<Executor> makeExecutor(
    const ExecutorSpecification& specification, const std::filesystem::path& work, double timeLimit);

/// The name of the file that a job's output goes to.
inline constexpr const char* jobLog = "traceResidual.out";

} // namespace clepsydra::identification
