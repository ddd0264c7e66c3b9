#pragma once

#include "emulator/library.h"
#include "heldOut/predictive.h"
#include "decision/answer.h"
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
    std::optional<HeldOutScore> after; // most probable candidate, if there is one
    /// Answer::nearest, if no effect explains the residual. It is no explanation: nothing is judged by it.
    std::optional<HeldOutScore> nearest;
    HeldOutScore oneMoreParameter; // control 1: null fit with one more free parameter
    /// Control 2: null with a Gaussian process on its residual; empty if conditions lack coordinates.
    std::optional<HeldOutScore> gaussianProcess;
    LogRatio overOneMore;          // most probable candidate against control 1
    LogRatio overGaussianProcess;  // most probable candidate against control 2
    Estimate improvement;          // rms error before minus after
    double noiseFloor = 0.0;       // expected rms error from noise alone
    double oneMoreAmplitude = 0.0; // fitted size of control 1
    bool ofLogs = true;            // whether rms errors are those of logarithms, which are relative
    bool better = false;
    bool complete = false;
    std::vector<std::string> notBetterBecause;
    std::vector<std::string> notScored; // features of the study that are not compared, and why
    std::vector<std::size_t> conditions;
    std::vector<Prediction> predictedBefore;
    std::vector<Prediction> predictedAfter;           // by the most probable candidate or the nearest effect
    std::vector<std::vector<Simulation>> simulations; // before, after
    std::vector<HeldOutData> data;
};

/// Simulates the held-out conditions at the fitted settings and compares the results with the measurements. What is
/// shared with the training data, the two controls, and what makes an effect better or complete is described in
/// docs/theory/statistics.md. The held-out slopes are finite differences of runs in which one parameter or amplitude is
/// moved by its standard deviation after the training data. An amplitude that was not measured has the mean and variance
/// of the uniform prior in its range.
///
/// \param training, heldOut  measurements, by condition of the study
HeldOutResult evaluateHeldOut(StudySimulator& studySimulator, const Library& library, const Answer& answer,
    const std::vector<MeasuredCondition>& training, const std::vector<MeasuredCondition>& heldOut,
    std::mt19937_64& random);

} // namespace clepsydra::identification
