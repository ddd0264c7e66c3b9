#include "nextExperiment/nextExperiment.h"

#include "procedure/assemble.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

constexpr int seedsPerOutcome = 2;

} // namespace

double divergence(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::MatrixXd& covariance)
{
    std::vector<Eigen::Index> both;
    for (Eigen::Index f = 0; f < a.size(); ++f)
    {
        if (std::isfinite(a(f)) && std::isfinite(b(f)))
        {
            both.push_back(f);
        }
    }
    const Eigen::VectorXd difference = a(both) - b(both);
    const Eigen::MatrixXd kept = covariance(both, both);
    return 0.5 * difference.dot(kept.llt().solve(difference));
}

double separationOf(const std::vector<PredictedOutcome>& outcomes, const Eigen::MatrixXd& covariance)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < outcomes.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
        {
            sum += outcomes[i].probability * outcomes[j].probability
                   * divergence(outcomes[i].features, outcomes[j].features, covariance);
        }
    }
    return sum;
}

Eigen::MatrixXd outcomeCovariance(const Noise& noise, const std::vector<MeasuredCondition>& measured)
{
    Eigen::MatrixXd covariance = noise.data.matrix + noise.simulation.matrix / seedsPerOutcome;
    Eigen::ArrayXd declared = Eigen::ArrayXd::Zero(noise.modelError.size());
    for (const auto& condition : measured)
    {
        if (condition.declaredError.size() > 0)
        {
            declared = declared.max(condition.declaredError.array());
        }
    }
    covariance.diagonal() += noise.modelError.cwiseAbs2() + declared.square().matrix();
    return covariance;
}

std::vector<NextExperiment> nextExperiments(
    Simulator& simulator, const Answer& answer, const std::vector<MeasuredCondition>& measured)
{
    const Study& study = simulator.study();
    std::vector<Explanation> left = answer.set;
    if (left.size() < 2)
    {
        left.push_back(answer.null);
    }
    if (left.size() < 2)
    {
        return {};
    }
    double sum = 0.0;
    for (const auto& explanation : left)
    {
        sum += std::exp(explanation.logOdds - left.front().logOdds);
    }
    const Eigen::MatrixXd covariance = outcomeCovariance(answer.noise, measured);
    std::vector<NextExperiment> all;
    for (const auto condition : study.conditionsOf(Role::candidate))
    {
        NextExperiment next;
        next.condition = condition;
        for (const auto& explanation : left)
        {
            const std::string name = nameOf(study, explanation);
            const auto simulations =
                simulator.repeats({condition}, explanation.setting, "next experiment, " + name, seedsPerOutcome);
            next.outcomes.push_back({name, std::exp(explanation.logOdds - left.front().logOdds) / sum,
                meanFeatures(featureRows(simulations, condition, study.featureCount())),
                covariance.diagonal().cwiseSqrt()});
        }
        next.separation = separationOf(next.outcomes, covariance);
        next.perCost = next.separation / study.conditions[condition].cost;
        all.push_back(std::move(next));
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.perCost > b.perCost; });
    return all;
}

} // namespace clepsydra::identification
