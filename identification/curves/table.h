#pragma once

#include "curves/curve.h"

#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Numbers in named columns. A missing value is NaN.
struct Table
{
    std::vector<std::string> names; // without units; empty where the file names none
    std::vector<std::string> units; // of each name, from [..] or (..) behind it; empty where there is none
    std::vector<std::vector<double>> columns;
    std::vector<int> lines; // of the file, by row

    /// Index of a column by its name, with its unit or without, or by its number counted from 1.
    /// \throws std::runtime_error that lists the columns
    std::size_t index(const std::string& column) const;
};

/// Reads CSV (commas, or semicolons with points or commas in the numbers) and white-space tables; lines that begin with #
/// are comments, the last one before the numbers may name the columns, as in OpenFOAM's files and most CSV. `(` and `)` of
/// vectors are ignored.
/// \throws std::runtime_error with file and line
Table readTable(const std::filesystem::path& file);

/// Reads one curve of a table that a run has written. A `*` in the path stands for the start times of a resumed run:
/// where parts overlap, the later one wins.
/// \throws std::runtime_error if there is no such file or column
Curve readCurve(const std::filesystem::path& pattern, const std::string& timeColumn, const std::string& valueColumn);

/// The files that a path with one folder named `*` stands for, in order of the number that the star stands for.
std::vector<std::filesystem::path> filesMatching(const std::filesystem::path& pattern);

/// Rows without a number are left out, the rest sorted by time.
Curve tidied(Curve curve);

} // namespace clepsydra::identification
