#pragma once

#include "curves/table.h"

#include <string>

namespace clepsydra::identification
{

/// Keys `column` and `unit` of a column in a study file.
struct GuessedColumn
{
    std::string column;
    std::string unit; // empty: unknown

    /// Size of the unit in SI units; 1 if the unit is unknown.
    double siUnits() const;
};

/// Columns of a measured file.
struct GuessedColumns
{
    GuessedColumn time;
    GuessedColumn value;
    std::string quantity; // of the value: mass, length, speed or share; empty: unknown
};

/// Guesses the columns of time and value from units and words in the titles. Without these, the time is the first
/// column that never falls, and the value is the next one that is not constant.
/// \throws std::runtime_error if there are no two such columns
GuessedColumns guessColumns(const Table& table);

} // namespace clepsydra::identification
