#pragma once

#include <stdexcept>
#include <string>

namespace clepsydra
{

/// Thrown instead of LIGGGHTS ending the process.
///
/// LIGGGHTS reports an error by Error::all or Error::one, which print to its own log and call exit(). Linking
/// liggghtsErrors.cpp into the program replaces those members (the dynamic linker prefers the program's
/// definition to the library's), so that the message reaches the caller with the place where it happened.
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

/// Called by the engine so that the linker keeps the replacements.
void keepLiggghtsErrorReplacements();

} // namespace clepsydra
