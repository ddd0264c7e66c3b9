#pragma once

#include "decision/answer.h"

#include <Eigen/Core>

#include <random>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Prediction of one explanation for a condition.
struct PredictedOutcome
{
    std::string name;
    double probability = 0.0;
    Eigen::VectorXd features;
    Eigen::VectorXd sd; // standard deviation of one measurement, including that of the prediction
};

/// A candidate condition for the next measurement.
struct NextExperiment
{
    std::size_t condition = 0;
    double separation = 0.0; // sum of p_i p_j divergence(i, j) over all pairs of explanations
    double perCost = 0.0;    // separation divided by the condition's cost
    std::vector<PredictedOutcome> outcomes;
};

/// Kullback-Leibler divergence of two normal predictions, averaged over both directions and summed over the features.
/// Features that one prediction lacks are left out.
double divergence(const PredictedOutcome& a, const PredictedOutcome& b);

/// Simulates each candidate condition with each explanation of the set, with parameters and amplitudes drawn from the
/// fits, and sorts the conditions by separation per cost, best first. A single member is compared with its rival; without
/// one, its predictions stand alone, and the separation is 0. An empty set gives no candidates.
std::vector<NextExperiment> nextExperiments(
    StudySimulator& studySimulator, const Answer& answer, std::mt19937_64& random);

} // namespace clepsydra::identification
