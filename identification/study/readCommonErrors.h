#pragma once

#include "study/study.h"
#include "study/yaml.h"

namespace clepsydra::identification
{

/// The errors of a study's list `commonErrors`; one with `each: true` becomes one for each of its conditions.
/// \param study  with its simulator, features and conditions
/// \throws StudyError that names file, line and what is allowed
std::vector<CommonError> readCommonErrors(const YamlPlace& list, const Study& study);

} // namespace clepsydra::identification
