#pragma once

#include <mpi.h>

#include <ctime>
#include <map>
#include <string>

namespace clepsydra
{

/// Wall time and processor time of a run by named phase. Time of a nested phase (forces inside DEM) is counted for the
/// innermost phase only. Where other programs share the processor, only processor time measures what a phase costs; on
/// several ranks it contains the time of waiting for messages. The phase is also passed to MPI_Pcontrol, so that
/// profilers of MPI can attribute messages to it.
class PhaseTimers
{
public:
    /// Times a phase from its construction to the end of its scope.
    class Scope
    {
    public:
        Scope(PhaseTimers& timers, const char* phase)
            : timers_(timers),
              outer_(timers.switchTo(phase))
        {}

        ~Scope()
        {
            timers_.switchTo(outer_);
        }

        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        PhaseTimers& timers_;
        const char* outer_;
    };

    [[nodiscard]] Scope time(const char* phase)
    {
        return Scope(*this, phase);
    }

    /// Wall time of each phase so far [s]; everything outside named phases is "other".
    const std::map<std::string, double>& wallSeconds() const
    {
        return wallSeconds_;
    }

    /// Processor time of this thread for each phase so far [s].
    const std::map<std::string, double>& processorSeconds() const
    {
        return processorSeconds_;
    }

private:
    static double now(clockid_t clock)
    {
        timespec time{};
        clock_gettime(clock, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    /// \return the phase that was running before
    const char* switchTo(const char* phase)
    {
        const double wall = now(CLOCK_MONOTONIC);
        const double processor = now(CLOCK_THREAD_CPUTIME_ID);
        wallSeconds_[current_] += wall - sinceWall_;
        processorSeconds_[current_] += processor - sinceProcessor_;
        sinceWall_ = wall;
        sinceProcessor_ = processor;
        const char* before = current_;
        current_ = phase;
        // MPI itself ignores this call; a profiler does not.
        constexpr int detailOfPhase = 2;
        MPI_Pcontrol(detailOfPhase, phase);
        return before;
    }

    const char* current_ = "other";
    double sinceWall_ = now(CLOCK_MONOTONIC);
    double sinceProcessor_ = now(CLOCK_THREAD_CPUTIME_ID);
    std::map<std::string, double> wallSeconds_;
    std::map<std::string, double> processorSeconds_;
};

} // namespace clepsydra
