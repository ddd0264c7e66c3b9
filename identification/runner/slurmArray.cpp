#include "runner/slurmArray.h"

#include "runner/processTree.h"
#include "runner/stopSignals.h"
#include "runner/storedFiles.h"

#include <cmath>
#include <fstream>
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

/// Waits for a command of Slurm. No shell reads its words. \return its status
int waitFor(const std::vector<std::string>& words, const std::filesystem::path& log, bool untilStopped)
{
    ProcessTree command(words, log.parent_path(), log, grace);
    while (!command.status() && !(untilStopped && StopSignals::noted() != 0))
    {
        std::this_thread::sleep_for(betweenLooks);
    }
    return command.status().value_or(statusOfNoReport);
}

/// The array that sbatch has told of, if it came that far.
void cancel(const std::filesystem::path& logOfSbatch)
{
    const std::string said = textOf(logOfSbatch);
    std::smatch parts;
    if (std::regex_search(said, parts, std::regex(R"(Submitted batch job (\d+))")))
    {
        waitFor({"scancel", parts[1]}, logOfSbatch.string() + ".scancel", false);
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
    // sbatch --wait ends with the largest status of all tasks: each task's own tells more.
    const int status = waitFor(words, log, true);
    if (StopSignals::noted() != 0)
    {
        cancel(log);
        signals.passOn();
    }
    bool anyReport = false;
    for (std::size_t i = 0; i < jobs.size(); ++i)
    {
        JobEnd end{i, statusOfNoReport, 0.0};
        std::ifstream report(jobs[i].folder / statusFile);
        anyReport = static_cast<bool>(report >> end.status >> end.seconds) || anyReport;
        onEnd(end);
    }
    if (status != 0 && !anyReport)
    {
        throw std::runtime_error("sbatch failed: see " + log.string());
    }
}

} // namespace clepsydra::identification
