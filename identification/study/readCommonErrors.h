#pragma once

#include "study/study.h"
#include "study/yaml.h"

namespace clepsydra::identification
{

/// Reads the list `commonErrors` of a study. An error with `each: true` becomes one error for each of its conditions.
/// \param study  with its simulator, features and conditions
/// \throws StudyError naming file, line and what is allowed
std::vector<CommonError> readCommonErrors(const YamlPlace& list, const Study& study);

} // namespace clepsydra::identification
