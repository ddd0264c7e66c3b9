#pragma once

#include "study/draft/columns.h"
#include "study/draft/conditions.h"
#include "study/draft/draftedSimulator.h"
#include "study/draft/shape.h"

#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Conditions, columns and curve shapes of measured files.
struct MeasuredFiles
{
    std::vector<DraftedCondition> conditions;
    GuessedColumns columns; // of all files
    Shape shape;            // of the training conditions
    std::vector<std::string> remarks;
};

/// Reads measured files. \param places  files, which must be tables, and folders, from which all tables are taken
/// \throws std::runtime_error naming the file if it is no table, if its columns differ from those of the first training
/// file, or if it contains another quantity than the case writes
MeasuredFiles readMeasuredFiles(const std::vector<std::filesystem::path>& places, const DraftedSimulator& simulator);

} // namespace clepsydra::identification
