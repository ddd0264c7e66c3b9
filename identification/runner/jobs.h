#pragma once

#include "study/study.h"

#include <chrono>
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

/// Name of the file that receives a job's output.
inline constexpr const char* jobLog = "traceResidual.out";

/// How a job ended.
struct JobEnd
{
    std::size_t job = 0;
    int status = 0; // exit status; 124: time limit exceeded; 125: a Slurm task reported none; 128 + signal number
    double seconds = 0.0;
};

/// Number of jobs at a time.
int jobsAtOnce(const ExecutorSpecification& executor);

/// Runs jobs as the study's executor says, and returns when all have ended: as processes of this machine, each of which
/// owns all processes that it starts, or as one Slurm job array, whose work folder must be on a file system that the
/// nodes share. If this program ends early, by whatever signal, all jobs end within `grace`, and none is reported.
/// \param study  its executor, its simulator's time limit and its work folder
/// \param onEnd  is called after each job, in the caller's thread; if it throws, the other jobs are asked to end
/// \param grace  time between SIGTERM and SIGKILL when a job of this machine is ended
/// \throws std::runtime_error if no process can be started, or if sbatch fails and no task has reported
void runJobs(const Study& study, const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd,
    std::chrono::milliseconds grace = std::chrono::seconds(5));

} // namespace clepsydra::identification
