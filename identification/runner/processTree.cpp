#include "runner/processTree.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <map>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr timespec endPollInterval{0, 20'000'000};
constexpr int statusOfNoProgram = 127;
constexpr int statusOfSignal = 128;

int statusOf(int waited)
{
    return WIFEXITED(waited) ? WEXITSTATUS(waited) : statusOfSignal + WTERMSIG(waited);
}

/// Parent of each process on this machine.
std::map<pid_t, pid_t> parents()
{
    std::map<pid_t, pid_t> found;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator("/proc", ignored))
    {
        const std::string name = entry.path().filename().string();
        if (std::isdigit(static_cast<unsigned char>(name.front())) == 0)
        {
            continue;
        }
        // The line is "pid (name) state parent ...", where the name may contain blanks and brackets.
        std::ifstream file(entry.path() / "stat");
        std::string line;
        std::getline(file, line);
        const auto end = line.rfind(')');
        if (end != std::string::npos && end + 4 < line.size())
        {
            found[std::stoi(name)] = std::stoi(line.substr(end + 4));
        }
    }
    return found;
}

void signalDescendants(pid_t ancestor, int signal)
{
    const auto parentOf = parents();
    for (const auto& [process, parent] : parentOf)
    {
        // The number of steps is limited: a table that is read while processes come and go may contain a cycle.
        auto above = parentOf.find(process);
        for (std::size_t step = 0; step < parentOf.size() && above != parentOf.end(); ++step)
        {
            if (above->second == ancestor)
            {
                kill(process, signal);
                break;
            }
            above = parentOf.find(above->second);
        }
    }
}

[[noreturn]] void becomeProgram(const std::vector<std::string>& command, const fs::path& folder, const fs::path& log)
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
    const fs::path& log, std::chrono::milliseconds grace) noexcept
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
    const pid_t program = fork();
    if (program == 0)
    {
        sigprocmask(SIG_SETMASK, &before, nullptr);
        becomeProgram(command, folder, log);
    }
    int status = statusOfNoProgram;
    bool ending = false;
    Clock::time_point since;
    while (true)
    {
        int waited = 0;
        pid_t ended = 0;
        bool programEnded = false;
        while ((ended = waitpid(-1, &waited, WNOHANG)) > 0)
        {
            if (ended == program)
            {
                status = statusOf(waited);
                programEnded = true;
            }
        }
        if (ended < 0 && errno == ECHILD)
        {
            _exit(status);
        }
        const int signal = programEnded ? 0 : sigtimedwait(&waitedFor, nullptr, &endPollInterval);
        if (!ending && (programEnded || (signal > 0 && signal != SIGCHLD)))
        {
            ending = true;
            since = Clock::now();
            signalDescendants(getpid(), SIGTERM);
        }
        else if (ending && Clock::now() - since > grace)
        {
            signalDescendants(getpid(), SIGKILL);
        }
    }
}

} // namespace

ProcessTree::ProcessTree(const std::vector<std::string>& command, const fs::path& folder, const fs::path& log,
    std::chrono::milliseconds grace)
{
    const pid_t self = getpid();
    watcher_ = fork();
    if (watcher_ < 0)
    {
        throw std::runtime_error("no process could be started for " + folder.string());
    }
    if (watcher_ == 0)
    {
        watch(self, command, folder, log, grace);
    }
}

ProcessTree::~ProcessTree()
{
    end();
    while (!status())
    {
        nanosleep(&endPollInterval, nullptr);
    }
}

std::optional<int> ProcessTree::status()
{
    if (!status_)
    {
        int waited = 0;
        const pid_t ended = waitpid(watcher_, &waited, WNOHANG);
        if (ended == watcher_)
        {
            status_ = statusOf(waited);
        }
        else if (ended < 0 && errno != EINTR)
        {
            status_ = statusOfNoProgram;
        }
    }
    return status_;
}

void ProcessTree::end()
{
    if (!status())
    {
        kill(watcher_, SIGTERM);
    }
}

} // namespace clepsydra::identification
