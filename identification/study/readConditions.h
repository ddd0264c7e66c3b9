#pragma once

#include "study/study.h"
#include "study/yaml.h"

namespace clepsydra::identification
{

/// Columns and features of a study's `observable`; scale and file belong to its conditions.
void readObservable(const YamlPlace& place, Study& study);

/// The conditions of a study file with what was measured in each. \param study  with its simulator and features
/// \throws StudyError that names file, line and what is allowed
void readConditions(const YamlPlace& root, Study& study);

} // namespace clepsydra::identification
