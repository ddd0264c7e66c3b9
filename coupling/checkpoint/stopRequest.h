#pragma once

#include "Time.H"

namespace clepsydra
{

/// Whether the run should write a checkpoint and end: SIGTERM or SIGINT was received by any rank, or the wall time in
/// the entry `maxClockTime` [s] of system/controlDict has passed.
class StopRequest
{
public:
    /// Handles both signals from now on, once each: a second signal ends the program. FatalIOError where maxClockTime
    /// is not a number > 0.
    explicit StopRequest(const Foam::Time& time);
    ~StopRequest();
    StopRequest(const StopRequest&) = delete;
    StopRequest& operator=(const StopRequest&) = delete;

    /// Whether the run should stop; the same on all ranks. Collective.
    bool asked() const;

private:
    const Foam::Time& time_;
    double maxClockTime_ = Foam::VGREAT;
};

} // namespace clepsydra
