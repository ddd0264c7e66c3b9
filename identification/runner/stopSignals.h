#pragma once

#include <csignal>
#include <map>

namespace clepsydra::identification
{

/// During its lifetime, SIGINT, SIGTERM and SIGHUP are recorded instead of ending the program. Signals that are ignored
/// stay ignored, as in a background job of a script.
class StopSignals
{
public:
    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

    /// The signal that was received, or 0.
    static int noted();

    /// Raises the recorded signal again with its original action.
    /// \throws std::runtime_error if that does not end the program
    void passOn();

private:
    void restore();

    std::map<int, struct sigaction> before_{{SIGINT, {}}, {SIGTERM, {}}, {SIGHUP, {}}};
};

} // namespace clepsydra::identification
