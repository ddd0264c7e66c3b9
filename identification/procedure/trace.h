#pragma once

#include "design/effectLibrary.h"
#include "procedure/answer.h"
#include "study/measurements.h"

#include <random>
#include <vector>

namespace clepsydra::identification
{

/// From training data to an answer: null fit, re-simulation, test, scores, confirmation, decision.
/// \param data  by condition; only training conditions are looked at
Answer trace(Simulator& simulator, const EffectLibrary& library, const std::vector<MeasuredCondition>& data,
    std::mt19937_64& random);

} // namespace clepsydra::identification
