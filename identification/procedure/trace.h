#pragma once

#include "emulator/library.h"
#include "procedure/answer.h"
#include "study/measurements.h"

#include <random>
#include <vector>

namespace clepsydra::identification
{

/// From training data to an answer: emulator, evidence, runs where they decide, calibration, decision.
/// \param data  by condition; only training conditions are looked at
/// \param withVisibility  whether to find what these data could have shown, too
Answer trace(StudySimulator& studySimulator, const Library& library, const std::vector<MeasuredCondition>& data,
    std::mt19937_64& random, bool withVisibility = false);

} // namespace clepsydra::identification
