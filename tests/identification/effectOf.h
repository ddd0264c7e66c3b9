#pragma once

#include "study/readValues.h"
#include "study/study.h"

#include <algorithm>

namespace clepsydra::identification::tests
{

/// Index of an effect in the study, by its name.
inline std::size_t effectOf(const Study& study, const std::string& name)
{
    const auto names = namesOfItems(study.effects);
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

} // namespace clepsydra::identification::tests
