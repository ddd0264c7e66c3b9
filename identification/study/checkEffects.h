#pragma once

#include "study/study.h"
#include "study/yaml.h"

namespace clepsydra::identification
{

/// Checks for mistakes that would otherwise be found only when runs have started, or never: unknown names in formulas
/// of effects and parameters, entries that a parameter overrides, misspelt tags and families.
/// \throws StudyError naming file, line and what is allowed
void checkEffects(const YamlPlace& root, const Study& study);

} // namespace clepsydra::identification
