#pragma once

#include "study/study.h"
#include "study/yaml.h"

#include <filesystem>

namespace clepsydra::identification
{

/// Reads and checks a study file (README.md describes every key). Measurements are not read here.
/// \throws StudyError that names file, line, key and what is allowed
Study readStudy(const std::filesystem::path& file);

/// The effects of a library file, in its order.
std::vector<Effect> readEffects(const YamlPlace& list);

} // namespace clepsydra::identification
