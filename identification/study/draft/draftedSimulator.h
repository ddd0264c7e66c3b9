#pragma once

#include "runner/entries.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Properties of a case that follow from its files.
struct DraftedSimulator
{
    std::filesystem::path folder;
    Entries entries;
    std::string observable;             // massInHopper or particleHeight; empty: unknown
    bool hasSteps = false;              // whether it has the steps dry and submerged, as cases/tutorials/hopperQuick
    std::filesystem::path library;      // library of effects that fits best; empty if none was found
    std::size_t fitting = 0;            // number of the library's effects that the case has entries for
    std::size_t effects = 0;            // number of the library's effects
    std::vector<std::string> tagValues; // values of the tag `medium` that the library's effects refer to

    bool has(const std::string& entry) const
    {
        return entries.count(entry) > 0;
    }
};

/// Reads the properties of a case. \throws std::runtime_error if the folder is no case
DraftedSimulator draftSimulator(const std::filesystem::path& folder);

} // namespace clepsydra::identification
