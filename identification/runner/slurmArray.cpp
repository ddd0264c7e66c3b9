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
constexpr int statusOfNoReport = 125; // the task never came to its end
constexpr std::chrono::milliseconds betweenLooks{200};
constexpr int looksBetweenReports = 5;
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

/// Each task reads its folder and its command from a list, and leaves its status and seconds beside its log.
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

/// Waits for a command of Slurm. No shell reads its words. \param meanwhile  is done now and then until it has ended or this
/// program is to stop; without it, nothing stops the waiting \return its status
int waitFor(const std::vector<std::string>& words, const std::filesystem::path& log,
    const std::function<void()>& meanwhile = nullptr)
{
    ProcessTree command(words, log.parent_path(), log, grace);
    for (int look = 0; !command.status() && !(meanwhile && StopSignals::noted() != 0); ++look)
    {
        if (meanwhile && look % looksBetweenReports == 0)
        {
            meanwhile();
        }
        std::this_thread::sleep_for(betweenLooks);
    }
    return command.status().value_or(statusOfNoReport);
}

/// How a job says that it has ended, where it has said so to the end of the line.
std::optional<JobEnd> reportOf(const std::vector<Job>& jobs, std::size_t job)
{
    std::ifstream file(jobs[job].folder / statusFile);
    JobEnd end{job, statusOfNoReport, 0.0};
    return file >> end.status >> end.seconds && file.get() == '\n' ? std::optional(end) : std::nullopt;
}

/// The array that sbatch has reported, if it came that far.
void cancel(const std::filesystem::path& logOfSbatch)
{
    const std::string said = textOf(logOfSbatch);
    std::smatch parts;
    if (std::regex_search(said, parts, std::regex(R"(Submitted batch job (\d+))")))
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
    std::vector<std::string> words = {"sbatch", "--wait",
        "--array=0-" + std::to_string(jobs.size() - 1) + (processes_ > 0 ? "%" + std::to_string(processes_) : "")};
    words.insert(words.end(), options_.begin(), options_.end());
    words.push_back(script.string());
    StopSignals signals;
    // What has ended is reported at once: what stops this program loses only what still runs.
    auto open = numbersWhere(jobs.size(), [](std::size_t) { return true; });
    const auto tell = [&] {
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
        // sbatch --wait ends with the largest status of all tasks: each task's own tells more.
        status = waitFor(words, log, tell);
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
    tell();
    const bool anyReport = open.size() < jobs.size();
    for (const auto job : open)
    {
        onEnd({job, statusOfNoReport, 0.0});
    }
    if (status != 0 && !anyReport)
    {
        throw std::runtime_error("sbatch failed: see " + log.string());
    }
}

} // namespace clepsydra::identification
