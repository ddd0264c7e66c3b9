#pragma once

#include "study/study.h"
#include "study/yaml.h"

namespace clepsydra::identification
{

/// Reads columns and features of a study's `observable`. Its file, factor and offset are read with the conditions.
void readObservable(const YamlPlace& place, Study& study);

/// Reads the conditions of a study file with the descriptions of their measurements.
/// \param study  with its simulator and features
/// \throws StudyError naming file, line and what is allowed
void readConditions(const YamlPlace& root, Study& study);

} // namespace clepsydra::identification
