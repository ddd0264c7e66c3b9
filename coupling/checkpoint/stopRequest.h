#pragma once

#include "Time.H"

namespace clepsydra
{

/// Whether the run should write a checkpoint and end: SIGTERM or SIGINT came (to any rank), or the wall time of the entry
/// `maxClockTime` [s] in system/controlDict is over.
class StopRequest
{
public:
    /// Takes both signals from now on, once each: a second one ends the program. FatalIOError where maxClockTime is not a number > 0.
    explicit StopRequest(const Foam::Time& time);
    ~StopRequest();
    StopRequest(const StopRequest&) = delete;
    StopRequest& operator=(const StopRequest&) = delete;

    /// The same answer on all ranks. Collective.
    bool asked() const;

private:
    const Foam::Time& time_;
    double maxClockTime_ = Foam::VGREAT;
};

} // namespace clepsydra
