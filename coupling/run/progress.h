#pragma once

#include <chrono>
#include <ostream>
#include <string>

namespace clepsydra
{

/// State of a run for the line that Progress prints.
struct ProgressState
{
    double time;      // simulated [s]
    double startTime; // simulated [s]
    double endTime;   // simulated [s]
    double wallTime;  // since the start of the process [s]
    long particles;   // in the hopper; negative where not known
    double wallLeft;  // until the end [s]; negative where not known
};

/// "t = 0.1/2 s, 2931 particles in the hopper, 120 s per simulated s, 00:03:48 to go"
std::string describe(const ProgressState& state);

/// Shows the progress of a run: on a terminal a bar on one line that is rewritten in place, in a log a line at each
/// write time. Only OpenFOAM's master rank prints.
///
/// This class exists because Debian 12 has no library for progress bars in C++.
class Progress
{
public:
    /// Prints to standard output; with a bar where that is a terminal.
    Progress();
    /// \param isTerminal  whether `out` interprets carriage returns and escape sequences
    Progress(std::ostream& out, bool isTerminal);
    /// Clears the line of the bar.
    ~Progress();

    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Call after each coupling step; on a terminal it prints at most five times per second. Local.
    /// \param time, endTime  simulated time [s]; the first call's `time` is taken as the start
    /// \param particlesInHopper  negative where not known
    /// \param wallLeft  wall time until the end [s]; negative where not known
    /// \param atWriteTime  whether to print a permanent line
    void update(double time, double endTime, long particlesInHopper, double wallLeft, bool atWriteTime = false);

    bool isTerminal() const
    {
        return isTerminal_;
    }

    /// Removes the bar, so that other text can be printed in its place; the next update() shows it again.
    void clear();

private:
    using Clock = std::chrono::steady_clock;

    std::ostream& out_;
    bool isTerminal_;
    bool barShown_ = false;
    bool started_ = false;
    double startTime_ = 0;
    Clock::time_point wallStart_;
    Clock::time_point lastBar_;
};

} // namespace clepsydra
