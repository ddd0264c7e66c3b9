#pragma once

#include "study/study.h"
#include "study/yaml.h"

#include <filesystem>

namespace clepsydra::identification
{

/// Reads and checks a study file (README.md describes every key). Measurements are not read here.
/// \throws StudyError that names file, line, key and what is allowed
Study readStudy(const std::filesystem::path& file);

/// A value of an entry goes into a file that the case reads: more than a value would be code there.
/// \throws StudyError if it holds what ends an entry or begins a command
void requireEntryValue(const YamlPlace& value);

/// Entries of a run of a condition without any parameter or effect: the condition's, else the rig's, else the case's own.
Entries plainEntries(const RigSpecification& rig, const Condition& condition);

/// Entries that an effect needs and the case does not have.
std::vector<std::string> missingEntries(const Effect& effect, const Entries& known);

/// The effects of a library file, in its order.
std::vector<Effect> readEffects(const YamlPlace& list);

} // namespace clepsydra::identification
