#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Files that are taken as repeats of one condition.
struct DraftedCondition
{
    std::string name;
    std::vector<std::filesystem::path> files;
    std::string number; // the last one in the name; empty: none
    bool isHeldOut = false;
};

/// Files whose names differ in a mark at the end are repeats: dry10a and dry10b; dry_1 and dry_2; bead3t1 and
/// bead3_trial_2. A number without a word before it is a mark where the numbers begin with 0 or 1 and miss none; else, as in
/// dry10 and dry12, it belongs to the condition. Of four conditions or more two are proposed to be held out, by their names
/// alone: one inside, one at the end of the range.
std::vector<DraftedCondition> draftConditions(const std::vector<std::filesystem::path>& files);

} // namespace clepsydra::identification
