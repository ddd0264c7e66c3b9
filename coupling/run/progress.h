#pragma once

#include <chrono>
#include <ostream>
#include <string>

namespace clepsydra
{

/// How far a run has come, for the line that Progress prints.
struct ProgressState
{
    double time;      // simulated [s]
    double startTime; // simulated [s]
    double endTime;   // simulated [s]
    double wallTime;  // since the start [s]
    long particles;   // in the hopper; negative: not known
    double wallLeft;  // [s]; negative: not known
};

/// "t = 0.1/2 s, 2931 particles in the hopper, 120 s per simulated s, 00:03:48 to go"
std::string describe(const ProgressState& state);

/// Shows how far the run is: on a terminal a bar on one line that is rewritten in place, in a log a plain line at each
/// write time. Only the master rank of OpenFOAM prints.
///
/// Written here because Debian 12 has no progress-bar library for C++.
class Progress
{
public:
    /// Prints to standard output, a bar if that is a terminal.
    Progress();
    /// \param isTerminal  whether `out` understands carriage returns and escape sequences.
    Progress(std::ostream& out, bool isTerminal);
    /// Leaves a clean line.
    ~Progress();

    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Call after each interval; on a terminal it prints at most five times a second. Local.
    /// \param time, endTime  simulated [s]; the first call's `time` counts as the start
    /// \param particlesInHopper  negative: not known
    /// \param wallLeft  to the end [s]; negative: not known
    /// \param atWriteTime  true: prints a line that stays
    void update(double time, double endTime, long particlesInHopper, double wallLeft, bool atWriteTime = false);

    bool isTerminal() const
    {
        return isTerminal_;
    }

    /// Removes the bar, so that other text can be printed in its place; the next update() brings it back.
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
