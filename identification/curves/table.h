#pragma once

#include "curves/curve.h"

#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Numbers in columns. A missing value is NaN.
struct Table
{
    std::vector<std::string> names; // without units; no elements if the file has no titles
    std::vector<std::string> units; // from [..] or (..) behind each name; empty texts if there is none
    std::vector<std::vector<double>> columns;
    std::vector<int> lines; // line number in the file, by row

    /// Index of a column by its name (with or without its unit) or by its number counted from 1.
    /// \throws std::runtime_error that lists the columns
    std::size_t index(const std::string& column) const;
};

/// Reads a table whose columns are separated by commas, semicolons or white space, with decimal points, or with decimal
/// commas beside semicolons or tabs. The last text line before the numbers, which may begin with #, names the columns;
/// other lines that begin with # are comments. Brackets of vectors are ignored, as in OpenFOAM's files.
/// \throws std::runtime_error with file and line
Table readTable(const std::filesystem::path& file);

/// Reads a curve that a run has written. A `*` in the path stands for the start times of a resumed run; where the parts
/// overlap, the later one is used.
/// \param furtherColumns  become the curve's `others`, in the same sequence
/// \throws std::runtime_error if there is no such file or column
Curve readCurve(const std::filesystem::path& pattern, const std::string& timeColumn, const std::string& valueColumn,
    const std::vector<std::string>& furtherColumns = {});

/// The files that match a path with folders named `*`, sorted by the number that the star stands for.
std::vector<std::filesystem::path> filesMatching(const std::filesystem::path& pattern);

/// The curve without rows that lack a number, sorted by time.
Curve tidied(Curve curve);

} // namespace clepsydra::identification
