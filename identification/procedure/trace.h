#pragma once

#include "emulator/library.h"
#include "decision/answer.h"
#include "study/measurements.h"

#include <random>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Finds the cause of the residual from training data: emulator, evidence, deciding runs, calibration, decision.
/// \param data  by condition of the study; only training conditions are read
/// \param withVisibility  whether the answer also says which effects these data could have shown
/// \throws std::runtime_error if all runs at the null fit fail, or if the noise cannot be estimated
Answer trace(StudySimulator& studySimulator, const Library& library, const std::vector<MeasuredCondition>& data,
    std::mt19937_64& random, bool withVisibility = false);

/// Why an explanation may not be named however well it fits: the amplitude of an effect is at the end of its range while
/// a parameter is more than 2 standard deviations from its measurement. The effect then stands for something that acts in
/// the same direction. Parameters that describe an effect further are not measured. Empty if it may.
std::string strainOf(const Study& study, const Explanation& explanation);

} // namespace clepsydra::identification
