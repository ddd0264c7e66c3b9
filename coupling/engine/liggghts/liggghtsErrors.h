#pragma once

#include <stdexcept>
#include <string>

namespace clepsydra
{

/// Thrown instead of LIGGGHTS ending the process.
///
/// LIGGGHTS ends in members of its class Error alone: they print to its own log and call exit() or MPI_Abort(). Linking
/// liggghtsErrors.cpp into the program replaces all of those members (the dynamic linker prefers the program's
/// definition to the library's; see replaceFunctions()), so that the message reaches the caller with the place where it
/// happened.
class LiggghtsStopped : public std::runtime_error
{
public:
    LiggghtsStopped(const std::string& message, bool onOneRankOnly)
        : std::runtime_error(message),
          onOneRankOnly_(onOneRankOnly)
    {}

    /// True if the other ranks do not know and may wait for this one.
    bool onOneRankOnly() const
    {
        return onOneRankOnly_;
    }

private:
    bool onOneRankOnly_;
};

/// To be called before LIGGGHTS is.
/// \throws DemEngineError where LIGGGHTS' library cannot be made to use the replacements
void replaceLiggghtsErrors();

} // namespace clepsydra
