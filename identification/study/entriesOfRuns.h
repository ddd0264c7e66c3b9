#pragma once

#include "study/study.h"
#include "study/yaml.h"

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// The case's own entries.
Entries ownEntries(const SimulatorSpecification& simulator);

/// Entries of a run of a condition without any parameter or effect: the condition's, else the simulator's, else the case's own.
Entries plainEntries(const SimulatorSpecification& simulator, const Condition& condition);

/// Entries that an effect needs and the case does not have.
std::vector<std::string> missingEntries(const Effect& effect, const Entries& known);

/// \throws StudyError where the case has no such entry: a run must not ignore what it was asked for
void requireEntry(const YamlPlace& place, const std::string& entry, const SimulatorSpecification& simulator);

/// A value of an entry goes into a file that the case reads: more than a value would be code there.
/// \throws StudyError if it holds what ends an entry or begins a command
void requireEntryValue(const YamlPlace& value);

/// Values of entries that the case has.
Entries readValues(const YamlPlace& place, const SimulatorSpecification& simulator);

} // namespace clepsydra::identification
