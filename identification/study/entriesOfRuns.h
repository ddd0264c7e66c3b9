#pragma once

#include "study/study.h"
#include "study/yaml.h"

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Entries of the case's parameter file.
Entries ownEntries(const SimulatorSpecification& simulator);

/// Entries of a run without parameters and effects. The condition's values take precedence over the simulator's, and
/// these over the case's.
Entries plainEntries(const SimulatorSpecification& simulator, const Condition& condition);

/// Entries that an effect sets and the case does not have.
std::vector<std::string> missingEntries(const Effect& effect, const Entries& known);

/// \throws StudyError if the case has no such entry
void requireEntry(const YamlPlace& place, const std::string& entry, const SimulatorSpecification& simulator);

/// Checks a value that is written into the case's parameter file, where more than a value would be executed.
/// \throws StudyError if the value contains characters that end an entry or begin a command
void requireEntryValue(const YamlPlace& value);

/// Reads values of entries. \throws StudyError if the case lacks an entry, or if a value is not allowed
Entries readValues(const YamlPlace& place, const SimulatorSpecification& simulator);

} // namespace clepsydra::identification
