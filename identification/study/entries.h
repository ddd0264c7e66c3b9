#pragma once

#include "study/expression.h"

#include <filesystem>
#include <map>
#include <string>

namespace clepsydra::identification
{

/// Entries `name value;` of a case's parameter file, by name. A value may be a number, a word, or $name.
using Entries = std::map<std::string, std::string>;

/// \throws std::runtime_error if the file cannot be read
Entries readEntries(const std::filesystem::path& file);

/// Replaces values in a parameter file; comments and all other text stay.
/// \throws std::runtime_error if the file cannot be read or lacks one of the entries
void replaceEntries(const std::filesystem::path& file, const Entries& changes);

/// The entries that are numbers, for use in formulas. A reference $name is replaced by the value of that entry.
/// \param defaults  of entries that are not given
Expression::Variables numbersOf(Entries entries, const Entries& defaults = {});

/// A number as text with nine significant digits.
std::string textOf(double number);

} // namespace clepsydra::identification
