#pragma once

#include "runner/studySimulator.h"
#include "study/measurements.h"

#include <vector>

namespace clepsydra::identification
{

/// Purpose of the runs of checkMagnitudes. They are the library's first runs and are counted there.
inline constexpr const char* checkOfUnits = "check of units";

/// Compares measured curves, and features that are logarithms, with the first run of the baseline in each training
/// condition. A factor above study.magnitudeLimit means a wrong unit or column, which would make all other runs
/// useless.
/// \param data  by condition of the study; conditions without repeats are skipped
/// \param execute  make runs that are not stored yet; otherwise their conditions are skipped
/// \throws std::runtime_error naming the condition, both values and the remedy
void checkMagnitudes(StudySimulator& studySimulator, const std::vector<MeasuredCondition>& data, bool execute);

} // namespace clepsydra::identification
