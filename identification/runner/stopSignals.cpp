#include "runner/stopSignals.h"

#include <stdexcept>
#include <string>

namespace clepsydra::identification
{

namespace
{

volatile std::sig_atomic_t stopSignal = 0;

extern "C" void noteStop(int signal)
{
    stopSignal = signal;
}

} // namespace

StopSignals::StopSignals()
{
    stopSignal = 0;
    for (auto& [signal, before] : before_)
    {
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN)
        {
            struct sigaction action
            {};
            action.sa_handler = noteStop;
            sigaction(signal, &action, nullptr);
        }
    }
}

StopSignals::~StopSignals()
{
    restore();
}

void StopSignals::restore()
{
    for (const auto& [signal, before] : before_)
    {
        sigaction(signal, &before, nullptr);
    }
}

int StopSignals::noted()
{
    return stopSignal;
}

void StopSignals::passOn()
{
    if (const int signal = stopSignal; signal != 0)
    {
        restore();
        std::raise(signal);
        throw std::runtime_error("stopped by signal " + std::to_string(signal) + "; runs that have ended are stored");
    }
}

} // namespace clepsydra::identification
