#include "runner/processTree.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr timespec pollPause{0, 20'000'000};
constexpr int statusOfTimeLimit = 124; // like timeout(1)
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
        if (end != std::string::npos && end + 4 < line.size())
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
    std::optional<Clock::time_point> ending; // when the processes were told to end
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

} // namespace

ProcessTree::ProcessTree(const std::vector<std::string>& command, const fs::path& folder, const std::string& log,
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

ProcessTree::~ProcessTree()
{
    if (!status())
    {
        kill(watcher_, SIGTERM);
    }
}

std::optional<int> ProcessTree::status()
{
    int waited = 0;
    const pid_t ended = status_ ? 0 : waitpid(watcher_, &waited, WNOHANG);
    if (ended != 0)
    {
        status_ = ended == watcher_ ? statusOf(waited) : statusOfNoProgram;
    }
    return status_;
}

double ProcessTree::seconds() const
{
    return secondsSince(since_);
}

} // namespace clepsydra::identification
