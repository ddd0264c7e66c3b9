#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

namespace clepsydra::identification
{

/// Drafts a study file for measured files. Comments explain the guesses; values that cannot be guessed are marked as
/// "FILL IN: what to do", which readStudy refuses. The guesses are also written to `out`.
///
/// The values of conditions that are proposed to be held out do not influence the draft.
/// \param caseFolder  case of the simulation; known are cases that write massInHopper or particleHeight
/// \param measured  files, and folders of files (.csv, .txt, .dat, .tsv)
/// \param study  file to write; its folder must exist
/// \throws std::runtime_error, without writing, if the study exists already, if no file can be read, or if the files do
/// not agree with each other or with the case
void draftStudy(const std::filesystem::path& caseFolder, const std::vector<std::filesystem::path>& measured,
    const std::filesystem::path& study, std::ostream& out);

} // namespace clepsydra::identification
