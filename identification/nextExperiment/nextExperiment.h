#pragma once

#include "procedure/answer.h"
#include "runner/simulator.h"
#include "study/measurements.h"

#include <Eigen/Core>

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

/// Kullback-Leibler divergence of two normal distributions with the same covariance; features that either lacks are
/// left out.
double divergence(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::MatrixXd& covariance);

/// Separation from outcomes and the covariance of one measurement against them.
double separationOf(const std::vector<PredictedOutcome>& outcomes, const Eigen::MatrixXd& covariance);

/// Covariance of one measurement against its prediction: noise of both, the simulator's own error, and what is not seen in
/// repeats, as large as it was declared at most for the measurements so far.
Eigen::MatrixXd outcomeCovariance(const Noise& noise, const std::vector<MeasuredCondition>& measured);

/// Simulates every candidate condition with each explanation that is left, and orders them by what one measurement
/// would decide for its cost, best first. Without a set of at least two, what is compared is no effect against the best.
std::vector<NextExperiment> nextExperiments(
    Simulator& simulator, const Answer& answer, const std::vector<MeasuredCondition>& measured);

} // namespace clepsydra::identification
