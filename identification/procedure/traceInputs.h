#pragma once

#include "design/effectLibrary.h"
#include "study/measurements.h"

#include <vector>

namespace clepsydra::identification
{

/// What every step of a trace looks at, and the simulator, which is all that costs.
struct TraceInputs
{
    Simulator& simulator;
    const Study& study;
    const EffectLibrary& library;
    const std::vector<MeasuredCondition>& data; // by condition of the study; training conditions only are looked at
    std::vector<std::size_t> training;
};

/// A fit that ends further than this from where the simulator was run is run again there.
constexpr double farInPriorSds = 1.0;

/// A fit is near enough to the simulation that it was made from if it is this many standard errors away.
constexpr double nearInErrors = 1.0;

/// Steps beyond the study's rounds for an explanation that misfits and has not come to the end of its way.
constexpr int stepsToTheEnd = 3;

/// Explanations are simulated with the same seeds, so that chance speaks for none of them: two that set the same entries
/// are alike to the last digit, instead of as far apart as two simulations.
constexpr const char* confirmationSeeds = "confirmation";

} // namespace clepsydra::identification
