#pragma once

#include "study/study.h"

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Columns of a measured file. An unknown unit is empty, and its numbers count as SI units.
struct GuessedColumns
{
    ColumnSpecification time;
    ColumnSpecification value;
    std::string quantity; // of the value: mass, length, speed or share; empty: unknown
};

/// Guesses the columns of time and value from units and words in the titles. Without these, the time is the first
/// column that never falls, and the value is the next one that is not constant.
/// \throws std::runtime_error naming the file if there are no two such columns
GuessedColumns guessColumns(const std::filesystem::path& file);

/// Files that are taken for repeats of one condition.
struct DraftedCondition
{
    std::string name;
    std::vector<std::filesystem::path> files;
    std::string number; // last number in the name; empty if there is none
    std::string series; // name with * for the number: dry*mm for dry10mm
    bool isHeldOut = false;
};

/// Groups files into conditions by their names. Names that differ in a mark at the end belong to repeats: dry10a and
/// dry10b; dry_1 and dry_2; bead3t1 and bead3_trial_2. A number without a word before it is a mark if the numbers begin
/// with 0 or 1 and none is missing; otherwise, as in dry10 and dry12, it belongs to the condition. Of four or more
/// conditions, two are proposed to be held out, by their names alone: one inside the range and one at its end.
std::vector<DraftedCondition> draftConditions(const std::vector<std::filesystem::path>& files);

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
