/// Runs as processes: how they end, and that no process is left.
#include "runner/jobs.h"
#include "temporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/prctl.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace clepsydra::identification::tests
{

namespace
{

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

/// A run that starts a child that ignores SIGTERM and another one that has left its group and session and has lost its
/// parent. The run itself ignores SIGTERM too and waits forever. All write their process numbers.
const std::string stubborn = "trap '' TERM\n"
                             "sleep 1000 & echo $! >> pids\n"
                             "(setsid sh -c 'sleep 1000 & echo $! >> pids; echo $$ >> pids; wait' &)\n"
                             "echo $$ >> pids\n"
                             "while :; do sleep 1000; done";
constexpr std::size_t stubbornProcesses = 4;

/// A study whose jobs run in this way.
Study studyWith(int processes, double timeLimit, const std::string& kind = "pool", const fs::path& work = {})
{
    Study study;
    study.executor = {kind, processes, {}};
    study.simulator.timeLimit = timeLimit;
    study.work = work;
    return study;
}

constexpr std::chrono::milliseconds shortGrace{100};

std::vector<pid_t> processesOf(const fs::path& folder)
{
    std::ifstream file(folder / "pids");
    std::vector<pid_t> found;
    for (pid_t process = 0; file >> process;)
    {
        found.push_back(process);
    }
    return found;
}

std::size_t alive(const std::vector<pid_t>& processes)
{
    return static_cast<std::size_t>(std::count_if(processes.begin(), processes.end(), [](pid_t process) {
        std::ifstream file("/proc/" + std::to_string(process) + "/stat");
        std::string status;
        return std::getline(file, status) && status.find(") Z") == std::string::npos;
    }));
}

/// Waits for a condition for a limited time.
template<class Condition>
bool soon(const Condition& condition)
{
    for (int look = 0; look < 1000 && !condition(); ++look)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return condition();
}

/// When a run that exceeded its time limit is reported as ended, all its children have ended too. Signals to the shell
/// or its group alone would leave the sleeping children.
TEST(Processes, NoneOutlivesTheTimeLimit)
{
    const TemporaryFolder folder;
    std::vector<int> ended;
    std::size_t left = stubbornProcesses;
    const auto onEnd = [&](const JobEnd& end) {
        ended.push_back(end.status);
        left = alive(processesOf(folder.path()));
    };
    runJobs(studyWith(1, 1.0), {{folder.path(), stubborn}}, onEnd, shortGrace);
    EXPECT_THAT(ended, ElementsAre(124));
    EXPECT_EQ(processesOf(folder.path()).size(), stubbornProcesses);
    EXPECT_EQ(left, 0U);
}

/// Background processes of a run end with it, and its status is kept.
TEST(Processes, NoneOutlivesItsRun)
{
    const TemporaryFolder folder;
    std::vector<int> ended;
    runJobs(
        studyWith(2, 0),
        {{folder.path(), "setsid sh -c 'trap \"\" TERM; echo $$ >> pids; while :; do sleep 1000; done' &\n"
                         "while [ ! -s pids ]; do sleep 0.02; done; exit 3"},
            {folder.path(), "kill -9 $$"}},
        [&](const JobEnd& end) { ended.push_back(end.status); }, shortGrace);
    EXPECT_THAT(ended, testing::UnorderedElementsAre(3, 128 + 9));
    EXPECT_EQ(processesOf(folder.path()).size(), 1U);
    EXPECT_EQ(alive(processesOf(folder.path())), 0U);
}

/// No process of a run is left, whether the program ends by a signal that it can handle, by SIGKILL, or by an error
/// while it processes the result of another run. A signal ends the program before any run is reported: a stopped run has
/// not failed, and an interrupted study must not continue to an answer without simulations.
TEST(Processes, NoneOutlivesTheProgram)
{
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGKILL, 0})
    {
        const TemporaryFolder folder;
        const pid_t program = fork();
        if (program == 0)
        {
            // Tests that nohup or a script started in the background ignore them.
            std::signal(SIGHUP, SIG_DFL);
            std::signal(SIGINT, SIG_DFL);
            try
            {
                runJobs(
                    studyWith(2, 0),
                    {{folder.path(), stubborn}, {folder.path(), "while [ ! -e fail ]; do sleep 0.02; done"}},
                    [](const JobEnd&) { throw std::runtime_error("the disk is full"); }, shortGrace);
            }
            catch (const std::exception&)
            {
                _exit(1);
            }
            _exit(0);
        }
        EXPECT_TRUE(soon([&] { return processesOf(folder.path()).size() == stubbornProcesses; }));
        if (signal == 0)
        {
            folder.write("fail", "");
        }
        else
        {
            kill(program, signal);
        }
        int status = 0;
        waitpid(program, &status, 0);
        EXPECT_EQ(WIFSIGNALED(status) ? WTERMSIG(status) : 0, signal);
        EXPECT_TRUE(soon([&] { return alive(processesOf(folder.path())) == 0; })) << "after signal " << signal;
    }
}

/// A signal that is ignored, as in a background job of a script, stays ignored.
TEST(Processes, AnIgnoredSignalStopsNothing)
{
    const TemporaryFolder folder;
    const auto before = std::signal(SIGINT, SIG_IGN);
    std::vector<int> ended;
    runJobs(studyWith(1, 0), {{folder.path(), "kill -INT " + std::to_string(getpid()) + "; sleep 0.5"}},
        [&](const JobEnd& end) { ended.push_back(end.status); });
    std::signal(SIGINT, before);
    EXPECT_THAT(ended, ElementsAre(0));
}

/// Scripts in place of Slurm's commands, at the beginning of the path.
class PlayedSlurm
{
public:
    /// \param sbatch, scancel  shell commands that these scripts execute
    PlayedSlurm(const TemporaryFolder& folder, const std::string& sbatch, const std::string& scancel = "")
        : path_(std::getenv("PATH") ? std::getenv("PATH") : "")
    {
        for (const auto& [name, text] : {std::pair("sbatch", sbatch), std::pair("scancel", scancel)})
        {
            fs::permissions(
                folder.write(std::string("bin/") + name, "#!/bin/bash\n" + text + '\n'), fs::perms::owner_all);
        }
        setenv("PATH", ((folder.path() / "bin").string() + ':' + path_).c_str(), 1);
    }
    ~PlayedSlurm()
    {
        setenv("PATH", path_.c_str(), 1);
    }
    PlayedSlurm(const PlayedSlurm&) = delete;
    PlayedSlurm& operator=(const PlayedSlurm&) = delete;

private:
    std::string path_;
};

/// Options are passed to sbatch as they are; a shell that interpreted them would create the file.
TEST(Slurm, OptionsAreNoShell)
{
    const TemporaryFolder folder;
    const PlayedSlurm slurm(folder, R"(printf '%s\n' "$@" > )" + (folder.path() / "words").string());
    const std::string hostile = "--comment=;touch " + (folder.path() / "executed").string() + ";$(touch executed)";
    Study study = studyWith(0, 0, "slurm", folder.path());
    study.executor.options = {hostile};
    runJobs(study, {{folder.path(), "true"}}, [](const JobEnd&) {});
    EXPECT_THAT(contentOf(folder.path() / "words"), HasSubstr('\n' + hostile + '\n'));
    EXPECT_FALSE(fs::exists(folder.path() / "executed"));
    EXPECT_FALSE(fs::exists("executed"));
}

/// Slurm gets the number of tasks at once after a percent sign, and the time limit in minutes, rounded up: a limit of
/// 5401 s is 91 of them. Without these numbers neither is there, because Slurm's own defaults then hold.
TEST(Slurm, IsGivenTheLimits)
{
    const TemporaryFolder folder;
    const PlayedSlurm slurm(folder, R"(printf '%s\n' "$@" > )" + (folder.path() / "words").string() + "\ncp ${@: -1} "
                                        + (folder.path() / "script").string());
    const std::vector<Job> jobs = {{folder.path(), "true"}, {folder.path(), "true"}, {folder.path(), "true"}};
    const Study limited = studyWith(2, 5401, "slurm", folder.path());
    runJobs(limited, jobs, [](const JobEnd&) {});
    EXPECT_EQ(jobsAtOnce(limited.executor), 2);
    EXPECT_THAT(contentOf(folder.path() / "words"), HasSubstr("\n--array=0-2%2\n"));
    EXPECT_THAT(contentOf(folder.path() / "words"), HasSubstr("--wait\n")) << "the answer needs the runs";
    EXPECT_THAT(contentOf(folder.path() / "script"), HasSubstr("\n#SBATCH --time=91\n"));
    runJobs(studyWith(0, 0, "slurm", folder.path()), jobs, [](const JobEnd&) {});
    EXPECT_THAT(contentOf(folder.path() / "words"), HasSubstr("\n--array=0-2\n"));
    EXPECT_THAT(contentOf(folder.path() / "script"), testing::Not(HasSubstr("--time")));
}

/// A finished task is reported once, while another one still runs, which ends when the first has been reported. An
/// error during the report cancels the array.
TEST(Slurm, ReportsFinishedTasksImmediately)
{
    const TemporaryFolder folder;
    const PlayedSlurm slurm(folder,
        "echo Submitted batch job 4711; for task in 0 1; do SLURM_ARRAY_TASK_ID=$task bash ${@: -1}; done",
        "echo \"$@\" > " + (folder.path() / "cancelled").string());
    const auto first = folder.write("first/x", "").parent_path();
    const auto second = folder.write("second/x", "").parent_path();
    std::vector<std::size_t> reported;
    const Study study = studyWith(0, 0, "slurm", folder.path());
    runJobs(study, {{first, "exit 3"}, {second, "for i in $(seq 200); do [ -e reported ] && exit 4; sleep 0.1; done"}},
        [&](const JobEnd& end) {
            reported.push_back(end.job);
            EXPECT_EQ(end.status, end.job == 0 ? 3 : 4);
            folder.write("second/reported", "");
        });
    EXPECT_THAT(reported, ElementsAre(0, 1));
    fs::remove(first / "status.run");
    fs::remove(second / "status.run");
    const auto fails = [](const JobEnd&) { throw std::runtime_error("the disk is full"); };
    EXPECT_THROW(runJobs(study, {{first, "exit 3"}, {second, "sleep 1000"}}, fails), std::runtime_error);
    EXPECT_TRUE(soon([&] { return contentOf(folder.path() / "cancelled") == "4711\n"; }));
}

/// A job array is cancelled when the program that waits for it is stopped, even by SIGKILL.
TEST(Slurm, IsCancelledWhenStopped)
{
    for (const int signal : {SIGTERM, SIGKILL})
    {
        const TemporaryFolder folder;
        const PlayedSlurm slurm(folder, "echo Submitted batch job 4711\ntouch submitted\nsleep 1000",
            "echo \"$@\" > " + (folder.path() / "cancelled").string());
        const pid_t program = fork();
        if (program == 0)
        {
            runJobs(
                studyWith(0, 0, "slurm", folder.path()), {{folder.path(), "true"}}, [](const JobEnd&) { _exit(2); });
            _exit(1);
        }
        EXPECT_TRUE(soon([&] { return fs::exists(folder.path() / "submitted"); }));
        kill(program, signal);
        int status = 0;
        waitpid(program, &status, 0);
        EXPECT_EQ(WIFSIGNALED(status) ? WTERMSIG(status) : 0, signal);
        EXPECT_TRUE(soon([&] { return contentOf(folder.path() / "cancelled") == "4711\n"; }));
    }
}

} // namespace

} // namespace clepsydra::identification::tests
