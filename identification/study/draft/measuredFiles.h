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

/// What names, titles and curves of measured files tell.
struct MeasuredFiles
{
    std::vector<DraftedCondition> conditions;
    GuessedColumns columns; // of all files
    Shape shape;            // of the training conditions
    std::vector<std::string> remarks;
};

/// \param places  files, which must be tables, and folders, of which those are taken that are
/// \throws std::runtime_error that names the file, where there is no table, where files have other columns than the first
/// training file, or where they hold another quantity than the case writes
MeasuredFiles readMeasuredFiles(const std::vector<std::filesystem::path>& places, const DraftedSimulator& simulator);

} // namespace clepsydra::identification
