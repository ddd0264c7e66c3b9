#include "checkpoint/stopRequest.h"

#include "PstreamReduceOps.H"
#include "runTimeSelection.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

namespace clepsydra
{

namespace
{

// A signal handler can access nothing but such a variable.
volatile std::sig_atomic_t signalCame = 0;

void noteSignal(int signal)
{
    signalCame = 1;
    constexpr std::string_view answer =
        "\nStopping: a checkpoint is written at the end of this coupling step. A second signal ends the run at once.\n";
    static_cast<void>(!write(STDERR_FILENO, answer.data(), answer.size()));
    std::signal(signal, SIG_DFL);
}

} // namespace

StopRequest::StopRequest(const Time& time)
    : time_(time)
{
    if (time.controlDict().found("maxClockTime"))
    {
        maxClockTime_ = positiveEntry(time.controlDict(), "maxClockTime");
    }
    std::signal(SIGTERM, noteSignal);
    std::signal(SIGINT, noteSignal);
}

StopRequest::~StopRequest()
{
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGINT, SIG_DFL);
}

bool StopRequest::asked() const
{
    const bool here = signalCame != 0 || time_.elapsedClockTime() > maxClockTime_;
    return returnReduce(here, orOp<bool>());
}

} // namespace clepsydra
