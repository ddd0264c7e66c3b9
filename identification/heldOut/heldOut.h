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

/// Before and after on conditions that no fit has seen.
struct HeldOutResult
{
    HeldOutScore before;               // the null, refitted
    std::optional<HeldOutScore> after; // the best explanation; none where there is none
    HeldOutScore oneMoreParameter;     // control 1: the null with one more free parameter
    /// Control 2: the null with a discrepancy without a name; none where conditions have no coordinates.
    std::optional<HeldOutScore> gaussianProcess;
    std::vector<HeldOutScore> members; // of Answer::set
    Estimate improvement;              // of the rms error, before minus after, with the noise they share
    Estimate overOneMore;              // the same, control 1 minus after
    double noiseFloor = 0.0;           // rms error that noise alone would give
    double noiseLimit = 0.0;           // 99 % of right predictions have a smaller one
    double oneMoreAmplitude = 0.0;     // what control 1 fitted
    std::vector<std::string> notAcceptedBecause;
    std::vector<std::size_t> conditions;
    std::vector<Prediction> predictedBefore;
    std::vector<Prediction> predictedAfter;
    std::vector<std::vector<Simulation>> simulations; // before, after
    std::vector<HeldOutData> data;

    /// Whether the best explanation may enter the model: it is a name, the error falls and is smaller than with one more
    /// free parameter, both beyond chance (one-sided, at the study's level), and reaches the noise.
    bool accepted() const
    {
        return after && notAcceptedBecause.empty();
    }
};

/// Simulates the held-out conditions with fresh seeds and holds that against their measurements.
/// \param training, heldOut  what was measured, by condition of the study
HeldOutResult evaluateHeldOut(StudySimulator& studySimulator, const Library& library, const Answer& answer,
    const std::vector<MeasuredCondition>& training, const std::vector<MeasuredCondition>& heldOut,
    std::mt19937_64& random);

} // namespace clepsydra::identification
