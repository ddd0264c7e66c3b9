#pragma once

#include <filesystem>
#include <ostream>

namespace clepsydra::identification
{

/// Says what can be reported from data of this study before there are any, and what it costs.
/// \param execute  make the runs of the effect library; otherwise only those that are stored are used, and where some are
///     missing the plan ends with their number and time
/// \param time  make one run for the cost, where none has been timed
void plan(const std::filesystem::path& studyFile, bool execute, bool time, std::ostream& out);

/// From a study file to report.json and report.html in `folder`. The order of the steps is what keeps it honest: the
/// answer is on disk before the held-out measurements are opened.
void runStudy(const std::filesystem::path& studyFile, const std::filesystem::path& folder, std::ostream& progress);

/// The same from the stored runs alone. \throws std::runtime_error where one is missing; the report is as before then
void reportAgain(const std::filesystem::path& studyFile, const std::filesystem::path& folder);

} // namespace clepsydra::identification
