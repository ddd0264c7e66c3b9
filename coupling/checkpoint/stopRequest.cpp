#include "checkpoint/stopRequest.h"

#include "runTimeSelection.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <iterator>
#include <vector>

namespace clepsydra
{

namespace
{

using Clock = std::chrono::steady_clock;

// A signal handler can access nothing but such a variable.
volatile std::sig_atomic_t signalCame = 0;

constexpr std::array fromUsers = {SIGTERM, SIGINT};
constexpr std::array fromBatchSystems = {SIGUSR1, SIGUSR2, SIGXCPU};

template<std::size_t count>
void answer(const char (&text)[count])
{
    signalCame = 1;
    static_cast<void>(!write(STDERR_FILENO, text, count - 1));
}

void noteUsersSignal(int signal)
{
    answer("\nStopping: a checkpoint is written at the end of this coupling step. A second signal ends the run at "
           "once.\n");
    std::signal(signal, SIG_DFL);
}

void noteBatchSystemsSignal(int)
{
    if (signalCame == 0)
    {
        answer("\nStopping: a checkpoint is written at the end of this coupling step.\n");
    }
}

using Handler = void (*)(int);

Handler handlerOf(int signal)
{
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    return action.sa_handler;
}

std::vector<int> ignoredSignals()
{
    std::vector<int> ignored;
    std::copy_if(fromUsers.begin(), fromUsers.end(), std::back_inserter(ignored),
        [](int signal) { return handlerOf(signal) == SIG_IGN; });
    return ignored;
}

// Both are taken when the program is loaded: OpenFOAM sets a handler of its own for SIGINT, and reads meshes before a
// StopRequest exists.
const std::vector<int> ignoredAtStart = ignoredSignals();
const Clock::time_point start = Clock::now();

double wallSecondsHere()
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool isClockTimeOver(const Foam::Time& time, double wallSeconds)
{
    constexpr const char* entry = "maxClockTime";
    return time.controlDict().found(entry) && wallSeconds > positiveEntry(time.controlDict(), entry);
}

} // namespace

StopRequest::StopRequest(const Foam::Time& time)
    : time_(time)
{
    isClockTimeOver(time_, wallSecondsHere());
    for (const int signal : fromUsers)
    {
        const bool ignored = std::count(ignoredAtStart.begin(), ignoredAtStart.end(), signal) > 0;
        std::signal(signal, ignored ? SIG_IGN : noteUsersSignal);
    }
    for (const int signal : fromBatchSystems)
    {
        if (handlerOf(signal) == SIG_DFL)
        {
            std::signal(signal, noteBatchSystemsSignal);
        }
    }
}

StopRequest::~StopRequest()
{
    for (const int signal : fromUsers)
    {
        if (handlerOf(signal) == noteUsersSignal)
        {
            std::signal(signal, SIG_DFL);
        }
    }
    for (const int signal : fromBatchSystems)
    {
        if (handlerOf(signal) == noteBatchSystemsSignal)
        {
            std::signal(signal, SIG_DFL);
        }
    }
}

void StopRequest::addTo(RankTotals& totals)
{
    totals.add({{}, {signalCame != 0 ? 1.0 : 0.0, wallSecondsHere()}}, [this](const RankNumbers& all) {
        signalCameToAnyRank_ = all.maxima[0] > 0;
        wallSeconds_ = all.maxima[1];
    });
}

bool StopRequest::asked() const
{
    return signalCameToAnyRank_ || isClockTimeOver(time_, wallSeconds_);
}

} // namespace clepsydra
