#include "runner/processPool.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <map>
#include <stdexcept>
#include <thread>

namespace clepsydra::identification
{

namespace
{

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds betweenLooks{20};
constexpr int statusOfTimeLimit = 124; // as of timeout(1)
constexpr int statusOfNoShell = 127;

volatile std::sig_atomic_t stopSignal = 0;

extern "C" void noteStop(int signal)
{
    stopSignal = signal;
}

/// While it lives, SIGINT and SIGTERM are noted instead of ending the program; one that is ignored stays so, as of a
/// program in the background of a script.
class StopGuard
{
public:
    StopGuard()
    {
        for (auto& [signal, before] : before_)
        {
            sigaction(signal, nullptr, &before);
            if (before.sa_handler != SIG_IGN)
            {
                struct sigaction action
                {};
                action.sa_handler = noteStop;
                sigaction(signal, &action, nullptr);
            }
        }
    }
    ~StopGuard()
    {
        for (const auto& [signal, before] : before_)
        {
            sigaction(signal, &before, nullptr);
        }
    }
    StopGuard(const StopGuard&) = delete;
    StopGuard& operator=(const StopGuard&) = delete;

private:
    std::map<int, struct sigaction> before_{{SIGINT, {}}, {SIGTERM, {}}};
};

/// A group of its own, so that a whole run with its mpirun can be ended.
pid_t start(const Job& job)
{
    const pid_t process = fork();
    if (process < 0)
    {
        throw std::runtime_error("no process could be started for " + job.folder.string());
    }
    if (process > 0)
    {
        setpgid(process, process);
        return process;
    }
    setpgid(0, 0);
    if (chdir(job.folder.c_str()) == 0)
    {
        const int log = open(jobLog, O_WRONLY | O_CREAT | O_TRUNC, 0644);
        const int nothing = open("/dev/null", O_RDONLY);
        dup2(nothing, STDIN_FILENO);
        dup2(log, STDOUT_FILENO);
        dup2(log, STDERR_FILENO);
        execl("/bin/sh", "sh", "-c", job.command.c_str(), nullptr);
    }
    _exit(statusOfNoShell);
}

struct Running
{
    std::size_t job;
    Clock::time_point since;
    bool overTime = false;
};

double secondsSince(Clock::time_point since)
{
    return std::chrono::duration<double>(Clock::now() - since).count();
}

} // namespace

ProcessPool::ProcessPool(int processes, double timeLimit)
    : processes_(processes > 0 ? processes : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))),
      timeLimit_(timeLimit)
{}

void ProcessPool::run(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd)
{
    stopSignal = 0;
    runUntilStopped(jobs, onEnd);
    if (const int signal = stopSignal; signal != 0)
    {
        // As if the signal came only now; where that does not end the program, runs that were stopped are no failures.
        std::raise(signal);
        throw std::runtime_error("stopped by signal " + std::to_string(signal) + "; runs that have ended are stored");
    }
}

void ProcessPool::runUntilStopped(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd) const
{
    const StopGuard guard;
    std::map<pid_t, Running> running;
    std::size_t next = 0;
    while ((next < jobs.size() && stopSignal == 0) || !running.empty())
    {
        while (next < jobs.size() && running.size() < static_cast<std::size_t>(processes_) && stopSignal == 0)
        {
            running.emplace(start(jobs[next]), Running{next, Clock::now()});
            ++next;
        }
        for (auto each = running.begin(); each != running.end();)
        {
            auto& [process, state] = *each;
            int status = 0;
            const pid_t ended = waitpid(process, &status, WNOHANG);
            if (ended == 0 || (ended < 0 && errno == EINTR))
            {
                if (stopSignal != 0 || (timeLimit_ > 0.0 && secondsSince(state.since) > timeLimit_))
                {
                    state.overTime = state.overTime || stopSignal == 0;
                    kill(-process, SIGTERM);
                }
                ++each;
                continue;
            }
            const int code = state.overTime      ? statusOfTimeLimit
                             : WIFEXITED(status) ? WEXITSTATUS(status)
                                                 : 128 + WTERMSIG(status);
            const JobEnd end{state.job, code, secondsSince(state.since)};
            each = running.erase(each);
            if (stopSignal == 0)
            {
                onEnd(end);
            }
        }
        std::this_thread::sleep_for(betweenLooks);
    }
}

} // namespace clepsydra::identification
