#pragma once

#include <csignal>
#include <map>

namespace clepsydra::identification
{

/// While it lives, SIGINT, SIGTERM and SIGHUP are noted instead of ending the program; one that is ignored stays so, as of
/// a program in the background of a script.
class StopSignals
{
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// The signal that came, or 0.
    static int noted();

    /// As if the signal came only now; where that does not end the program, runs that were stopped are no failures.
    /// \throws std::runtime_error if a signal was noted
    void passOn();

private:
    void restore();

    std::map<int, struct sigaction> before_{{SIGINT, {}}, {SIGTERM, {}}, {SIGHUP, {}}};
};

} // namespace clepsydra::identification
