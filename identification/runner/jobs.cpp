#include "runner/jobs.h"

#include "lists.h"
#include "runner/processTree.h"
#include "runner/storedFiles.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace clepsydra::identification
{

namespace
{

using OnEnd = std::function<void(const JobEnd&)>;

constexpr std::chrono::milliseconds pollInterval{20};
constexpr std::chrono::seconds queuePollInterval{1};
constexpr std::chrono::seconds timeToCancel{60};

constexpr const char* statusFile = "status.run";
constexpr int statusOfNoReport = 125; // the task did not reach its end

/// Submits a job array and waits for it. If this shell is told to end, it cancels the array, whose number sbatch has
/// printed into the log.
constexpr const char* submission = R"(trap '
    scancel $(sed -n "s/.*Submitted batch job \([0-9]*\).*/\1/p" slurmArray.log)' TERM
sbatch --wait "$@" &
wait $!)";

void runProcesses(const Study& study, const std::vector<Job>& jobs, const OnEnd& onEnd, std::chrono::milliseconds grace)
{
    const auto atOnce = static_cast<std::size_t>(jobsAtOnce(study.executor));
    std::map<std::size_t, ProcessTree> running;
    for (std::size_t next = 0; next < jobs.size() || !running.empty(); std::this_thread::sleep_for(pollInterval))
    {
        for (; next < jobs.size() && running.size() < atOnce; ++next)
        {
            running.try_emplace(next, std::vector<std::string>{"/bin/sh", "-c", jobs[next].command}, jobs[next].folder,
                jobLog, study.simulator.timeLimit, grace);
        }
        for (auto each = running.begin(); each != running.end();)
        {
            auto& [job, processes] = *each;
            const auto status = processes.status();
            if (status)
            {
                onEnd({job, *status, processes.seconds()});
            }
            each = status ? running.erase(each) : std::next(each);
        }
    }
}

std::string quoted(const std::string& text)
{
    return '\'' + std::regex_replace(text, std::regex("'"), R"('\'')") + '\'';
}

/// Each task takes its folder and its command from a list, and writes its status and its seconds beside its log.
void writeScript(const std::filesystem::path& script, const std::vector<Job>& jobs, double timeLimit)
{
    std::ostringstream text;
    text << "#!/bin/bash\n#SBATCH --job-name=traceResidual\n#SBATCH --output=/dev/null\n";
    if (timeLimit > 0.0)
    {
        text << "#SBATCH --time=" << static_cast<long>(std::ceil(timeLimit / 60.0)) << '\n';
    }
    text << "case $SLURM_ARRAY_TASK_ID in\n";
    for (std::size_t i = 0; i < jobs.size(); ++i)
    {
        text << i << ") cd " << quoted(jobs[i].folder.string()) << " || exit 1; command=" << quoted(jobs[i].command)
             << " ;;\n";
    }
    text << "esac\nbegin=$SECONDS\nsh -c \"$command\" > " << jobLog << " 2>&1 < /dev/null\n"
         << "echo $? $((SECONDS - begin)) > " << statusFile << '\n';
    writeWhole(script, text.str());
}

void runSlurmArray(const Study& study, const std::vector<Job>& jobs, const OnEnd& onEnd)
{
    const auto& [kind, processes, options] = study.executor;
    const auto script = study.work / "slurmArray";
    const std::string log = "slurmArray.log";
    writeScript(script, jobs, study.simulator.timeLimit);
    std::vector<std::string> command = {"/bin/sh", "-c", submission, "sh",
        "--array=0-" + std::to_string(jobs.size() - 1) + (processes > 0 ? "%" + std::to_string(processes) : "")};
    append(command, options);
    command.push_back(script.string());
    const auto report = [&](std::size_t job) {
        std::ifstream file(jobs[job].folder / statusFile);
        JobEnd end{job, statusOfNoReport, 0.0};
        const bool isComplete = file >> end.status >> end.seconds && file.get() == '\n';
        if (isComplete)
        {
            onEnd(end);
        }
        return isComplete;
    };
    std::vector<bool> isReported(jobs.size());
    // Finished jobs are reported immediately, so that stopping this program loses only the jobs that still run.
    const auto reportFinished = [&] {
        for (std::size_t job = 0; job < jobs.size(); ++job)
        {
            isReported[job] = isReported[job] || report(job);
        }
    };
    ProcessTree array(command, study.work, log, 0.0, timeToCancel);
    while (!array.status())
    {
        reportFinished();
        std::this_thread::sleep_for(queuePollInterval);
    }
    reportFinished();
    const bool anyReport = contains(isReported, true);
    for (std::size_t job = 0; job < jobs.size(); ++job)
    {
        if (!isReported[job])
        {
            onEnd({job, statusOfNoReport, 0.0});
        }
    }
    // The status of sbatch --wait is the largest of all tasks; those of the single tasks are used instead.
    if (array.status() != 0 && !anyReport)
    {
        throw std::runtime_error("sbatch failed; its output is in " + (study.work / log).string());
    }
}

} // namespace

int jobsAtOnce(const ExecutorSpecification& executor)
{
    const auto cores = executor.kind == "slurm" ? 1U : std::thread::hardware_concurrency();
    return executor.processes > 0 ? executor.processes : std::max(1, static_cast<int>(cores));
}

void runJobs(const Study& study, const std::vector<Job>& jobs, const OnEnd& onEnd, std::chrono::milliseconds grace)
{
    if (study.executor.kind == "slurm")
    {
        runSlurmArray(study, jobs, onEnd);
    }
    else
    {
        runProcesses(study, jobs, onEnd, grace);
    }
}

} // namespace clepsydra::identification
