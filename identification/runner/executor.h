#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// A command to be run in a folder. Its output goes to the file `jobLog` there.
struct Job
{
    std::filesystem::path folder;
    std::string command;
};

/// How a job ended.
struct JobEnd
{
    std::size_t job = 0;
    int status = 0; // exit status; 124: time limit exceeded; 125: a Slurm task reported none; 128 + signal number
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

    /// Returns when all jobs have ended. \param onEnd  is called after each job, in the caller's thread
    virtual void run(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd) = 0;

    virtual int atOnce() const = 0;
};

/// Name of the file that receives a job's output.
inline constexpr const char* jobLog = "traceResidual.out";

} // namespace clepsydra::identification
