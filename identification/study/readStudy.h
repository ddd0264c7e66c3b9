#pragma once

#include "study/study.h"

#include <filesystem>

namespace clepsydra::identification
{

/// Reads and checks a study file, whose keys docs/reference/study.md describes. The measured files are not read here.
/// \throws StudyError naming file, line, key and what is allowed
Study readStudy(const std::filesystem::path& file);

} // namespace clepsydra::identification
