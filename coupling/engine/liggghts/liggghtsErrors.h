#pragma once

#include <stdexcept>
#include <string>

namespace clepsydra
{

/// Exception that is thrown where LIGGGHTS would end the process.
///
/// LIGGGHTS ends the process only in members of its class Error, which print to LIGGGHTS' log and call exit() or
/// MPI_Abort(). Linking liggghtsErrors.cpp into the program replaces these members (the dynamic linker prefers the
/// program's definition to the library's; see replaceFunctions()), so that the message reaches the caller with the
/// place where the error occurred.
class LiggghtsStopped : public std::runtime_error
{
public:
    LiggghtsStopped(const std::string& message, bool onOneRankOnly)
        : std::runtime_error(message),
          onOneRankOnly_(onOneRankOnly)
    {}

    /// True where the other ranks do not have this error and may wait for this rank.
    bool onOneRankOnly() const
    {
        return onOneRankOnly_;
    }

private:
    bool onOneRankOnly_;
};

/// Call before LIGGGHTS is started.
/// \throws DemEngineError where LIGGGHTS' library cannot be made to use the replacements
void replaceLiggghtsErrors();

} // namespace clepsydra
