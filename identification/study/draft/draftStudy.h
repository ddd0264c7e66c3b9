#pragma once

#include <filesystem>
#include <ostream>
#include <vector>

namespace clepsydra::identification
{

/// Writes a study file for measured files, with comments that tell what was guessed and how to correct it. What cannot be
/// guessed stands in it as "FILL IN: what to do", which the study's reader refuses. Tells the same to `out`.
///
/// Of files of conditions that are proposed to be held out no value is looked at.
/// \param caseFolder  of the simulation: hoppers that write massInHopper and particles that write particleHeight are known
/// \param measured  files, and folders of files (.csv, .txt, .dat, .tsv)
/// \param study  is made; its folder must be there
/// \throws std::runtime_error, with nothing written, where the study is there already, where nothing can be read, or where
/// the files do not fit each other or the case
void draftStudy(const std::filesystem::path& caseFolder, const std::vector<std::filesystem::path>& measured,
    const std::filesystem::path& study, std::ostream& out);

} // namespace clepsydra::identification
