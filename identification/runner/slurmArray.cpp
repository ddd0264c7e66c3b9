#include "runner/slurmArray.h"

#include "lists.h"
#include "runner/processTree.h"
#include "runner/stopSignals.h"
#include "runner/storedFiles.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

namespace clepsydra::identification
{

namespace
{

constexpr const char* statusFile = "status.run";
constexpr int statusOfNoReport = 125; // the task did not reach its end
constexpr std::chrono::milliseconds queuePollInterval{200};
constexpr int pollsBetweenReports = 5;
constexpr std::chrono::seconds grace{5};

std::string quoted(const std::string& text)
{
    std::string result = "'";
    for (const char c : text)
    {
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return result + "'";
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

/// Waits for a command of Slurm and returns its status.
/// \param meanwhile  is called repeatedly until the command ends or a signal stops this program; without it, signals do
///     not interrupt the wait
int waitFor(const std::vector<std::string>& command, const std::filesystem::path& log,
    const std::function<void()>& meanwhile = nullptr)
{
    ProcessTree processes(command, log.parent_path(), log, grace);
    for (int poll = 0; !processes.status() && !(meanwhile && StopSignals::noted() != 0); ++poll)
    {
        if (meanwhile && poll % pollsBetweenReports == 0)
        {
            meanwhile();
        }
        std::this_thread::sleep_for(queuePollInterval);
    }
    return processes.status().value_or(statusOfNoReport);
}

/// The outcome that a job has written; empty until its line is complete.
std::optional<JobEnd> reportOf(const std::vector<Job>& jobs, std::size_t job)
{
    std::ifstream file(jobs[job].folder / statusFile);
    JobEnd end{job, statusOfNoReport, 0.0};
    return file >> end.status >> end.seconds && file.get() == '\n' ? std::optional(end) : std::nullopt;
}

/// Cancels the job array whose number sbatch has printed, if there is one.
void cancel(const std::filesystem::path& logOfSbatch)
{
    const std::string output = textOf(logOfSbatch);
    std::smatch parts;
    if (std::regex_search(output, parts, std::regex(R"(Submitted batch job (\d+))")))
    {
        waitFor({"scancel", parts[1]}, logOfSbatch.string() + ".scancel");
    }
}

} // namespace

SlurmArray::SlurmArray(int processes, std::vector<std::string> options, std::filesystem::path work, double timeLimit)
    : processes_(processes),
      options_(std::move(options)),
      work_(std::move(work)),
      timeLimit_(timeLimit)
{}

void SlurmArray::run(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd)
{
    if (jobs.empty())
    {
        return;
    }
    const auto script = work_ / "slurmArray";
    writeScript(script, jobs, timeLimit_);
    const std::filesystem::path log = script.string() + ".log";
    std::vector<std::string> command = {"sbatch", "--wait",
        "--array=0-" + std::to_string(jobs.size() - 1) + (processes_ > 0 ? "%" + std::to_string(processes_) : "")};
    command.insert(command.end(), options_.begin(), options_.end());
    command.push_back(script.string());
    StopSignals signals;
    // Finished jobs are reported immediately, so that stopping this program loses only the jobs that still run.
    auto open = numbersWhere(jobs.size(), [](std::size_t) { return true; });
    const auto reportFinished = [&] {
        const auto isReported = [&](std::size_t job) {
            const auto end = reportOf(jobs, job);
            if (end)
            {
                onEnd(*end);
            }
            return end.has_value();
        };
        open.erase(std::remove_if(open.begin(), open.end(), isReported), open.end());
    };
    int status = 0;
    try
    {
        // The status of sbatch --wait is the largest of all tasks; those of the single tasks are used instead.
        status = waitFor(command, log, reportFinished);
    }
    catch (...)
    {
        cancel(log);
        throw;
    }
    if (StopSignals::noted() != 0)
    {
        cancel(log);
        signals.passOn();
    }
    reportFinished();
    const bool anyReport = open.size() < jobs.size();
    for (const auto job : open)
    {
        onEnd({job, statusOfNoReport, 0.0});
    }
    if (status != 0 && !anyReport)
    {
        throw std::runtime_error("sbatch failed; its output is in " + log.string());
    }
}

} // namespace clepsydra::identification
