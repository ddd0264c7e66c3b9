#pragma once

#include "emulator/library.h"
#include "heldOut/scores.h"
#include "procedure/answer.h"
#include "study/measurements.h"

#include <optional>
#include <random>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Errors on held-out conditions, which are used in no fit, without and with the effect.
struct HeldOutResult
{
    HeldOutScore before;               // null fit
    std::optional<HeldOutScore> after; // best explanation, if there is one
    HeldOutScore oneMoreParameter;     // control 1: null fit with one more free parameter
    /// Control 2: null fit with a Gaussian process on its residual; empty if conditions lack coordinates.
    std::optional<HeldOutScore> gaussianProcess;
    std::vector<HeldOutScore> members; // of Answer::set
    Estimate improvement;              // rms error before minus after
    Estimate overOneMore;              // rms error of control 1 minus after
    double noiseFloor = 0.0;           // expected rms error from noise alone
    double noiseLimit = 0.0;           // 99 % quantile of the rms error from noise alone
    double oneMoreAmplitude = 0.0;     // fitted size of control 1
    std::vector<std::string> notAcceptedBecause;
    std::vector<std::size_t> conditions;
    std::vector<Prediction> predictedBefore;
    std::vector<Prediction> predictedAfter;
    std::vector<std::vector<Simulation>> simulations; // before, after
    std::vector<HeldOutData> data;

    /// Whether the effect may enter the model: it is the only explanation, its error is significantly smaller than both
    /// that of the null and that of one more free parameter (one-sided, at the study's level), and is no larger than
    /// noise.
    bool accepted() const
    {
        return after && notAcceptedBecause.empty();
    }
};

/// Simulates the held-out conditions with seeds of their own and compares the results with the measurements.
/// \param training, heldOut  measurements, by condition of the study
HeldOutResult evaluateHeldOut(StudySimulator& studySimulator, const Library& library, const Answer& answer,
    const std::vector<MeasuredCondition>& training, const std::vector<MeasuredCondition>& heldOut,
    std::mt19937_64& random);

} // namespace clepsydra::identification
