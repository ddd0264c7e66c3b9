#pragma once

#include "procedure/answer.h"

#include <Eigen/Core>

#include <random>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// What an explanation predicts for a condition.
struct PredictedOutcome
{
    std::string name;
    double probability = 0.0;
    Eigen::VectorXd features;
    Eigen::VectorXd sd; // of one measurement and the prediction
};

/// A condition that could be measured next.
struct NextExperiment
{
    std::size_t condition = 0;
    double separation = 0.0; // sum over pairs of p_i p_j KL(i, j): how well one measurement would decide
    double perCost = 0.0;
    std::vector<PredictedOutcome> outcomes;
};

/// Divergence of two normal predictions, feature by feature, the mean of both directions; features that either lacks are
/// left out.
double divergence(const PredictedOutcome& a, const PredictedOutcome& b);

/// Simulates every candidate condition with each explanation that is left, at draws of what it leaves open of its
/// amplitude and the parameters, and orders them by what one measurement would decide for its cost, best first. Without a set of at
/// least two, what is compared is no effect against the best.
std::vector<NextExperiment> nextExperiments(
    StudySimulator& studySimulator, const Answer& answer, std::mt19937_64& random);

} // namespace clepsydra::identification
