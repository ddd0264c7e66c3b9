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

/// Simulates the held-out conditions at the fitted settings and compares the results with the measurements.
///
/// Each explanation (null, most probable candidate or, without any, the nearest effect, controls) predicts all measured
/// held-out features at once, as `predict` describes. What is taken from where:
///     training data    mean, slopes and uncertainty of the emulator at the fitted setting, slopes of common errors from
///                      the library, noise and declared errors of the measurements
///     held-out mean    runs of the simulator at the fitted setting
///     held-out slopes  finite differences of runs of the simulator, in which one parameter or amplitude is moved by its
///                      standard deviation after the training data; sharedErrorSlopes for common errors
///     shared           parameters (their priors), amplitudes (their independent measurement or, without one, mean and
///                      variance of the uniform prior in their ranges), common errors, and one model error per feature
///                      that is equal in all conditions
///     not shared       noise of measured means, declared errors, emulator's uncertainty, scatter of the simulated means
///     control 1        the null, with an operation of the measuring chain as if it were an effect; held-out slopes of
///                      parameters are those of the null
///     control 2        the null, with a Gaussian process over the coordinates for each feature as further shared
///                      quantities
/// All explanations are simulated with the same seeds.
///
/// *Better*: the effect is named, and its prediction is better than those of the null and of both controls, each by a log
/// ratio of densities above 0 that is beyond chance at the study's level. The effect may then enter the model.
/// *Complete*: the measurements differ from the prediction with the effect by no more than noise, at the same level.
///
/// \param training, heldOut  measurements, by condition of the study
HeldOutResult evaluateHeldOut(StudySimulator& studySimulator, const Library& library, const Answer& answer,
    const std::vector<MeasuredCondition>& training, const std::vector<MeasuredCondition>& heldOut,
    std::mt19937_64& random);

} // namespace clepsydra::identification
