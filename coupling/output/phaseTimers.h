#pragma once

#include <chrono>
#include <map>
#include <string>

namespace clepsydra
{

/// Wall time of the phases of a run by name. A phase inside another (forces inside DEM) is not counted twice: time
/// goes to the innermost.
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

    /// Seconds of each phase so far; everything outside named phases is "other".
    std::map<std::string, double> seconds() const
    {
        return seconds_;
    }

private:
    using Clock = std::chrono::steady_clock;

    /// \return the phase that was running.
    const char* switchTo(const char* phase)
    {
        const Clock::time_point now = Clock::now();
        seconds_[current_] += std::chrono::duration<double>(now - since_).count();
        since_ = now;
        const char* before = current_;
        current_ = phase;
        return before;
    }

    const char* current_ = "other";
    Clock::time_point since_ = Clock::now();
    std::map<std::string, double> seconds_;
};

} // namespace clepsydra
