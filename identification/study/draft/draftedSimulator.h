#pragma once

#include "runner/entries.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// What a case's own files tell about it.
struct DraftedSimulator
{
    std::filesystem::path folder;
    Entries entries;
    std::string observable;        // that it writes: massInHopper, particleHeight; empty: none that is known
    bool hasSteps = false;         // step.dry and step.submerged, as cases/tutorials/hopperQuick
    std::filesystem::path library; // the effects that fit it best; empty: none is near
    std::size_t fitting = 0;       // of its effects, those that the case has entries for
    std::size_t effects = 0;
    std::vector<std::string> tagValues; // of `medium`, that effects of the library ask for

    bool has(const std::string& entry) const
    {
        return entries.count(entry) > 0;
    }
};

/// \throws std::runtime_error where the folder is no case
DraftedSimulator draftSimulator(const std::filesystem::path& folder);

} // namespace clepsydra::identification
