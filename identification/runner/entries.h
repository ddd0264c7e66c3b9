#pragma once

#include "study/expression.h"

#include <filesystem>
#include <map>
#include <string>

namespace clepsydra::identification
{

/// Lines `name value;` of a case's file of parameters, by name. A value may be a number, a word, or $name.
using Entries = std::map<std::string, std::string>;

/// \throws std::runtime_error if the file cannot be read
Entries readEntries(const std::filesystem::path& file);

/// Replaces values in a file of parameters, comments and all else kept.
/// \throws std::runtime_error if one of the entries is not in the file: a run must not ignore what it was asked for
void replaceEntries(const std::filesystem::path& file, const Entries& changes);

/// Those of the entries that are numbers, $name followed; for formulas.
Expression::Variables numbersOf(const Entries& entries);

/// Text of a number that reads back as the same to nine digits.
std::string textOf(double number);

} // namespace clepsydra::identification
