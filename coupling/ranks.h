#pragma once

#include "Pstream.H"
#include "PstreamReduceOps.H"

#include <stdexcept>
#include <string>

/// \file
/// How ranks report a problem to each other. All functions are collective.

namespace clepsydra
{

/// Returns when all ranks have called it. OpenFOAM has no barrier, so this is a reduction.
inline void waitForAllRanks()
{
    Foam::label nothing = 0;
    Foam::reduce(nothing, Foam::sumOp<Foam::label>());
}

/// The first non-empty text among those of the ranks; the same on all ranks.
inline std::string firstOfRanks(const std::string& here)
{
    return Foam::returnReduce(Foam::string(here),
        [](const Foam::string& own, const Foam::string& others) { return own.empty() ? others : own; });
}

/// Runs an action on each rank.
/// \return the message of the std::runtime_error that the action threw on the first rank where it did, the same on all
/// ranks, so that no rank waits for one that has failed; empty where the action succeeded everywhere
template<class Action>
std::string problemOfRanks(const Action& action)
{
    std::string problem;
    try
    {
        action();
    }
    catch (const std::runtime_error& error) // FileError or an error of std::filesystem
    {
        problem = error.what();
    }
    return firstOfRanks(problem);
}

} // namespace clepsydra
