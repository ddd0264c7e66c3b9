#pragma once

#include "runner/studySimulator.h"
#include "study/measurements.h"

#include <vector>

namespace clepsydra::identification
{

/// The purpose of its runs, which are the library's first: they count there.
inline constexpr const char* checkOfUnits = "check of units";

/// Compares measured curves, and features that are logarithms, with the first run of the baseline in each training
/// condition: what is further apart than study.magnitudeLimit has a wrong unit or column, and all that the many other runs
/// would tell.
/// \param data  by condition of the study; conditions without repeats are skipped
/// \param execute  make runs that are not stored yet; otherwise their conditions are skipped
/// \throws std::runtime_error that names condition, numbers and the way out
void checkMagnitudes(StudySimulator& studySimulator, const std::vector<MeasuredCondition>& data, bool execute);

} // namespace clepsydra::identification
