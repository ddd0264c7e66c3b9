#include "checkpoint/stopRequest.h"

#include "PstreamReduceOps.H"
#include "runTimeSelection.h"

#include <csignal>

namespace clepsydra
{

namespace
{

// A signal handler can reach nothing else.
volatile std::sig_atomic_t terminateCame = 0;

void noteTerminate(int)
{
    terminateCame = 1;
}

} // namespace

StopRequest::StopRequest(const Time& time)
    : time_(time)
{
    if (time.controlDict().found("maxClockTime"))
    {
        maxClockTime_ = positiveEntry(time.controlDict(), "maxClockTime");
    }
    std::signal(SIGTERM, noteTerminate);
}

StopRequest::~StopRequest()
{
    std::signal(SIGTERM, SIG_DFL);
}

bool StopRequest::asked() const
{
    const bool here = terminateCame != 0 || time_.elapsedClockTime() > maxClockTime_;
    return returnReduce(here, orOp<bool>());
}

} // namespace clepsydra
