#pragma once

#include "study/study.h"
#include "study/yaml.h"

#include <filesystem>

namespace clepsydra::identification
{

/// Reads and checks a study file, whose keys README.md describes. The measured files are not read here.
/// \throws StudyError naming file, line, key and what is allowed
Study readStudy(const std::filesystem::path& file);

/// Reads a list of effects. \throws StudyError naming file, line, key and what is allowed
std::vector<Effect> readEffects(const YamlPlace& list);

} // namespace clepsydra::identification
