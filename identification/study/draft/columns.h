#pragma once

#include "curves/table.h"

#include <string>

namespace clepsydra::identification
{

/// A column as `column` and `unit` of a study file name it.
struct GuessedColumn
{
    std::string column;
    std::string unit; // empty: the file does not name one that is known

    /// How many SI units its unit is; 1 where that is not known.
    double siUnits() const;
};

/// What the titles of a measured file say of its columns.
struct GuessedColumns
{
    GuessedColumn time;
    GuessedColumn value;
    std::string quantity; // of the value: mass, length, speed, share; empty: nobody knows
};

/// By units and words in the titles; where they say nothing, time is the first column that never falls, and value the next
/// one that is not always the same.
/// \throws std::runtime_error where no two columns can be time and value
GuessedColumns guessColumns(const Table& table);

} // namespace clepsydra::identification
