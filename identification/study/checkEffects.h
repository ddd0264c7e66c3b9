#pragma once

#include "study/study.h"
#include "study/yaml.h"

namespace clepsydra::identification
{

/// What would be found only when runs have begun, or never: names in formulas of effects and parameters that are no
/// entries, entries that a parameter overrides, tags and families that are misspelt.
/// \throws StudyError
void checkEffects(const YamlPlace& root, const Study& study);

} // namespace clepsydra::identification
