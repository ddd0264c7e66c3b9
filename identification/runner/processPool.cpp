#include "runner/processPool.h"

#include "runner/processTree.h"
#include "runner/stopSignals.h"

#include <algorithm>
#include <list>
#include <thread>

namespace clepsydra::identification
{

namespace
{

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds pollInterval{20};
constexpr int statusOfTimeLimit = 124; // like timeout(1)

struct Running
{
    Running(std::size_t number, const Job& what, std::chrono::milliseconds grace)
        : job(number),
          processes({"/bin/sh", "-c", what.command}, what.folder, jobLog, grace)
    {}

    void end()
    {
        if (!ending)
        {
            ending = true;
            processes.end();
        }
    }

    double seconds() const
    {
        return std::chrono::duration<double>(Clock::now() - since).count();
    }

    std::size_t job;
    ProcessTree processes;
    Clock::time_point since = Clock::now();
    bool overTime = false;
    bool ending = false;
};

/// After an error, all remaining runs are asked to end before the first of them is waited for.
struct AllRunning : std::list<Running>
{
    AllRunning() = default;
    AllRunning(const AllRunning&) = delete;
    AllRunning& operator=(const AllRunning&) = delete;
    ~AllRunning()
    {
        for (auto& each : *this)
        {
            each.end();
        }
    }
};

} // namespace

ProcessPool::ProcessPool(int processes, double timeLimit, std::chrono::milliseconds grace)
    : processes_(processes > 0 ? processes : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))),
      timeLimit_(timeLimit),
      grace_(grace)
{}

void ProcessPool::run(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd)
{
    StopSignals signals;
    runUntilStopped(jobs, onEnd);
    signals.passOn();
}

void ProcessPool::runUntilStopped(const std::vector<Job>& jobs, const std::function<void(const JobEnd&)>& onEnd) const
{
    const auto stopped = [] { return StopSignals::noted() != 0; };
    AllRunning running;
    std::size_t next = 0;
    while ((next < jobs.size() && !stopped()) || !running.empty())
    {
        while (next < jobs.size() && running.size() < static_cast<std::size_t>(processes_) && !stopped())
        {
            running.emplace_back(next, jobs[next], grace_);
            ++next;
        }
        for (auto each = running.begin(); each != running.end();)
        {
            const auto status = each->processes.status();
            if (!status)
            {
                each->overTime = each->overTime || (timeLimit_ > 0.0 && each->seconds() > timeLimit_);
                if (each->overTime || stopped())
                {
                    each->end();
                }
                ++each;
                continue;
            }
            const JobEnd end{each->job, each->overTime ? statusOfTimeLimit : *status, each->seconds()};
            each = running.erase(each);
            if (!stopped())
            {
                onEnd(end);
            }
        }
        std::this_thread::sleep_for(pollInterval);
    }
}

} // namespace clepsydra::identification
