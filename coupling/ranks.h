#pragma once

#include "Pstream.H"
#include "PstreamReduceOps.H"

#include <stdexcept>
#include <string>

/// \file
/// What ranks say to each other where one has a problem. All is collective.

namespace clepsydra
{

/// No rank goes on before the others have come here: OpenFOAM has no barrier but a reduction.
inline void waitForAllRanks()
{
    Foam::label nothing = 0;
    Foam::reduce(nothing, Foam::sumOp<Foam::label>());
}

/// Of what the ranks found, the first that is not empty.
inline std::string firstOfRanks(const std::string& here)
{
    return Foam::returnReduce(Foam::string(here),
        [](const Foam::string& own, const Foam::string& others) { return own.empty() ? others : own; });
}

/// Does something on each rank. \return the message of the std::runtime_error that it ended with on one of them (the
/// first): the same on all, so that none waits for one that has failed. Empty where all went well.
template<class Action>
std::string problemOfRanks(const Action& action)
{
    std::string problem;
    try
    {
        action();
    }
    catch (const std::runtime_error& error) // FileError, or of std::filesystem
    {
        problem = error.what();
    }
    return firstOfRanks(problem);
}

} // namespace clepsydra
