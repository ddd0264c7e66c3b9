#pragma once

#include "study/study.h"

#include <filesystem>
#include <vector>

namespace clepsydra::identification
{

class YamlPlace;

/// Reads and checks a study file, whose keys docs/reference/study.md describes. The measured files are not read here.
/// \throws StudyError naming file, line, key and what is allowed
Study readStudy(const std::filesystem::path& file);

// Parts of a study file, which readStudy reads in this order. All throw StudyError naming file, line and what is allowed.

/// Columns and features of `observable`. Its file, factor and offset are read with the conditions.
void readObservable(const YamlPlace& place, Study& study);

/// The conditions with the descriptions of their measurements. \param study  with its simulator and features
void readConditions(const YamlPlace& root, Study& study);

/// A list of effects.
std::vector<Effect> readEffects(const YamlPlace& list);

/// The list `commonErrors`. An error with `each: true` becomes one error for each of its conditions. An effect that an
/// item declares as measured with a gauge becomes a common error and is no effect of the study any more.
/// \param study  with its simulator, features, conditions and effects
void readCommonErrors(const YamlPlace& list, Study& study);

/// Checks for mistakes that would otherwise be found only when runs have started, or never: unknown names in formulas
/// of effects and parameters, entries that a parameter overrides, misspelt tags and families.
void checkEffects(const YamlPlace& root, const Study& study);

} // namespace clepsydra::identification
