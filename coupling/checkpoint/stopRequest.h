#pragma once

#include "rankTotals.h"

#include "Time.H"

namespace clepsydra
{

/// Whether the run should write a checkpoint and end: a signal was received by any rank, or the wall time in the entry
/// `maxClockTime` [s] of system/controlDict has passed on any rank.
///
/// The signals are SIGTERM and SIGINT, after whose first one a second ends the program at once, and those by which batch
/// systems announce the end of a job: SIGUSR1, SIGUSR2 and SIGXCPU, which the system repeats every second. A signal that
/// the program was started to ignore stays ignored, and one that OpenFOAM handles (writeNowSignal,
/// stopAtWriteNowSignal) is left to it. The wall time is counted from the start of the process by a clock that nobody
/// sets.
class StopRequest
{
public:
    /// Handles the signals from now on. FatalIOError where maxClockTime is not a number > 0.
    explicit StopRequest(const Foam::Time& time);
    ~StopRequest();
    StopRequest(const StopRequest&) = delete;
    StopRequest& operator=(const StopRequest&) = delete;

    /// Adds to the totals whether this rank has received a signal, and its wall time. Local.
    void addTo(RankTotals& totals);

    /// Whether the run should stop, as of the totals that were reduced last; the same on all ranks. Local. An entry
    /// `maxClockTime` that has been edited since the last call counts from now on; FatalIOError where it is not a number
    /// > 0.
    bool asked() const;

private:
    const Foam::Time& time_;
    bool signalCameToAnyRank_ = false;
    /// Largest wall time of a rank [s].
    double wallSeconds_ = 0;
};

} // namespace clepsydra
