#include "runner/slurmArray.h"

#include <sys/wait.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace clepsydra::identification
{

namespace
{

constexpr const char* statusFile = "status.run";
constexpr int statusOfNoReport = 125; // the task never came to its end

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
    std::ofstream text(script);
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
}

} // namespace

SlurmArray::SlurmArray(int processes, std::string options, std::filesystem::path work, double timeLimit)
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
    std::string command = "sbatch --wait --array=0-" + std::to_string(jobs.size() - 1);
    command += processes_ > 0 ? "%" + std::to_string(processes_) : "";
    command += ' ' + options_ + ' ' + quoted(script.string()) + " > " + quoted(script.string() + ".log") + " 2>&1";
    // sbatch --wait ends with the largest status of all tasks: each task's own tells more.
    const int status = std::system(command.c_str());
    if ((WIFSIGNALED(status) && WTERMSIG(status) == SIGINT)
        || (WIFEXITED(status) && WEXITSTATUS(status) == 128 + SIGINT))
    {
        throw std::runtime_error("stopped while waiting for Slurm; scancel ends what is left of the job array");
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
        throw std::runtime_error("sbatch failed: see " + script.string() + ".log");
    }
}

} // namespace clepsydra::identification
