#pragma once

#include <string>

namespace clepsydra
{

/// What became of an entry, option or function object whose name has changed: its new name and, where the old name means
/// something else in CFDEMcoupling, how to convert the value.
struct Renamed
{
    std::string newName;
    std::string conversion; ///< a sentence, or empty
};

/// \return nullptr for a word that is not the old name of anything.
const Renamed* renamed(const std::string& word);

} // namespace clepsydra
