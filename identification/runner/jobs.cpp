#include "runner/jobs.h"

#include "lists.h"
#include "runner/storedFiles.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace clepsydra::identification
{

namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using OnEnd = std::function<void(const JobEnd&)>;

constexpr timespec pollPause{0, 20'000'000};
constexpr std::chrono::seconds queuePollInterval{1};
constexpr std::chrono::seconds timeToCancel{60};

constexpr const char* statusFile = "status.run"; // of a Slurm task
constexpr int statusOfTimeLimit = 124;           // like timeout(1)
constexpr int statusOfNoReport = 125;            // the task did not reach its end
constexpr int statusOfNoProgram = 127;
constexpr int statusOfSignal = 128;

int statusOf(int waited)
{
    return WIFEXITED(waited) ? WEXITSTATUS(waited) : statusOfSignal + WTERMSIG(waited);
}

double secondsSince(Clock::time_point begin)
{
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

void signalDescendants(pid_t ancestor, int signal)
{
    std::map<pid_t, pid_t> parents; // of each process on this machine
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator("/proc", ignored))
    {
        // The line is "pid (name) state parent ...", where the name may contain blanks and brackets.
        std::ifstream file(entry.path() / "stat");
        std::string line;
        std::getline(file, line);
        const auto end = line.rfind(')');
        if (end != std::string::npos && end + 4 < line.size() && line.find_first_of("0123456789") == 0)
        {
            parents[std::stoi(line)] = std::stoi(line.substr(end + 4));
        }
    }
    std::set<pid_t> tree = {ancestor};
    for (std::size_t before = 0; before < tree.size();)
    {
        before = tree.size();
        for (const auto& [process, parent] : parents)
        {
            if (tree.count(parent) > 0)
            {
                tree.insert(process);
            }
        }
    }
    tree.erase(ancestor);
    for (const pid_t process : tree)
    {
        kill(process, signal);
    }
}

[[noreturn]] void becomeProgram(const std::vector<std::string>& command, const fs::path& folder, const std::string& log)
{
    std::vector<char*> arguments;
    for (const auto& argument : command)
    {
        arguments.push_back(const_cast<char*>(argument.c_str())); // NOLINT: execvp's signature is older than const
    }
    arguments.push_back(nullptr);
    if (chdir(folder.c_str()) == 0)
    {
        const int output = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        const int nothing = open("/dev/null", O_RDONLY);
        dup2(nothing, STDIN_FILENO);
        dup2(output, STDOUT_FILENO);
        dup2(output, STDERR_FILENO);
        execvp(arguments.front(), arguments.data());
    }
    _exit(statusOfNoProgram);
}

/// Main loop of the watching process.
[[noreturn]] void watch(pid_t parent, const std::vector<std::string>& command, const fs::path& folder,
    const std::string& log, double timeLimit, std::chrono::milliseconds grace) noexcept
{
    setpgid(0, 0);
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    // Signals that are ignored would not be delivered to sigtimedwait.
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGCHLD, SIG_DFL);
    sigset_t waitedFor;
    sigset_t before;
    sigemptyset(&waitedFor);
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGCHLD})
    {
        sigaddset(&waitedFor, signal);
    }
    sigprocmask(SIG_BLOCK, &waitedFor, &before);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent)
    {
        _exit(statusOfNoProgram);
    }
    const auto begin = Clock::now();
    const pid_t program = fork();
    if (program == 0)
    {
        sigprocmask(SIG_SETMASK, &before, nullptr);
        becomeProgram(command, folder, log);
    }
    int status = statusOfNoProgram;
    std::optional<Clock::time_point> ending; // when the processes were asked to end
    while (true)
    {
        int waited = 0;
        pid_t ended = 0;
        bool shallEnd = false;
        while ((ended = waitpid(-1, &waited, WNOHANG)) > 0)
        {
            if (ended == program && status != statusOfTimeLimit)
            {
                status = statusOf(waited);
                shallEnd = true;
            }
        }
        if (ended < 0 && errno == ECHILD)
        {
            _exit(status);
        }
        if (!shallEnd)
        {
            const int signal = sigtimedwait(&waitedFor, nullptr, &pollPause);
            shallEnd = signal > 0 && signal != SIGCHLD;
        }
        if (!shallEnd && !ending && timeLimit > 0.0 && secondsSince(begin) > timeLimit)
        {
            status = statusOfTimeLimit;
            shallEnd = true;
        }
        if (shallEnd && !ending)
        {
            ending = Clock::now();
            signalDescendants(getpid(), SIGTERM);
        }
        else if (ending && Clock::now() - *ending > grace)
        {
            signalDescendants(getpid(), SIGKILL);
        }
    }
}

/// A program with all processes that it starts, including children that have left its process group or lost their
/// parent.
///
/// A separate process watches the program and inherits every orphan (PR_SET_CHILD_SUBREAPER). When the program ends or
/// exceeds its time limit, when this object is destroyed, or when the calling process has ended (even by SIGKILL), all
/// remaining processes receive SIGTERM and, after a grace period, SIGKILL.
class ProcessTree
{
public:
    /// \param command  program and arguments; they are not interpreted by a shell
    /// \param log  file that receives the program's output, relative to the folder
    /// \param timeLimit  wall-clock limit [s]; 0: no limit
    /// \param grace  time between SIGTERM and SIGKILL
    /// \throws std::runtime_error if no process can be started
    ProcessTree(const std::vector<std::string>& command, const fs::path& folder, const std::string& log,
        double timeLimit, std::chrono::milliseconds grace)
    {
        const pid_t self = getpid();
        watcher_ = fork();
        if (watcher_ < 0)
        {
            throw std::runtime_error("no process could be started for " + folder.string());
        }
        if (watcher_ == 0)
        {
            watch(self, command, folder, log, timeLimit, grace);
        }
    }

    /// Tells all processes to end, and does not wait for them.
    ~ProcessTree()
    {
        if (!status())
        {
            kill(watcher_, SIGTERM);
        }
    }

    ProcessTree(const ProcessTree&) = delete;
    ProcessTree& operator=(const ProcessTree&) = delete;

    /// The program's exit status (124 if it exceeded its time limit, 128 + signal number if a signal ended it); empty
    /// while any of its processes runs.
    std::optional<int> status()
    {
        int waited = 0;
        const pid_t ended = status_ ? 0 : waitpid(watcher_, &waited, WNOHANG);
        if (ended != 0)
        {
            status_ = ended == watcher_ ? statusOf(waited) : statusOfNoProgram;
        }
        return status_;
    }

    /// Wall-clock time since the start.
    double seconds() const
    {
        return secondsSince(since_);
    }

private:
    Clock::time_point since_ = Clock::now();
    pid_t watcher_;
    std::optional<int> status_;
};

void runProcesses(const Study& study, const std::vector<Job>& jobs, const OnEnd& onEnd, std::chrono::milliseconds grace)
{
    const auto atOnce = static_cast<std::size_t>(jobsAtOnce(study.executor));
    std::map<std::size_t, ProcessTree> running;
    for (std::size_t next = 0; next < jobs.size() || !running.empty(); nanosleep(&pollPause, nullptr))
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
void writeScript(const fs::path& script, const std::vector<Job>& jobs, double timeLimit)
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

/// Submits a job array and waits for it. If this shell is asked to end, it cancels the array, whose number sbatch has
/// printed into the log.
constexpr const char* submission = R"(trap '
    scancel $(sed -n "s/.*Submitted batch job \([0-9]*\).*/\1/p" slurmArray.log)' TERM
sbatch --wait "$@" &
wait $!)";

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
