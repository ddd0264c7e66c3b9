#pragma once

#include <string>

namespace clepsydra
{

/// The new name of an entry, option or function object that has been renamed and, where the old name has another
/// meaning in CFDEMcoupling, how to convert the value.
struct Renamed
{
    std::string newName;
    std::string conversion; ///< one sentence, or empty
};

/// \return nullptr for a word that is not the old name of anything
const Renamed* renamed(const std::string& word);

} // namespace clepsydra
