#pragma once

#include <filesystem>
#include <ostream>

namespace clepsydra::identification
{

/// Reports which effects data of this study can show, before there are data, and what the runs cost.
/// \param execute  make the runs of the effect library; otherwise only stored runs are used, and if some are missing,
///     only their number and time are reported
/// \param time  make one run to measure its time, if none has been timed
/// \throws StudyError or std::runtime_error for a wrong study file, unreadable measurements or failed runs
void plan(const std::filesystem::path& studyFile, bool execute, bool time, std::ostream& out);

/// Processes a study file and writes report.json and report.html into `folder`. The answer is written to answer.json
/// before the held-out measurements are read, so that these cannot influence it.
/// \param onlyStored  make no runs; if one is missing, that is an error, and the old reports stay
/// \throws StudyError or std::runtime_error for a wrong study file, unreadable measurements or failed runs
void runStudy(const std::filesystem::path& studyFile, const std::filesystem::path& folder, std::ostream& progress,
    bool onlyStored = false);

} // namespace clepsydra::identification
