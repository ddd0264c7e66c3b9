#include "nextRuns/nextExperiment.h"

#include "emulator/settings.h"
#include "lists.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

/// Number of runs of one explanation in one condition, each with parameters and amplitude drawn from the fit.
constexpr int draws = 4;

} // namespace

double divergence(const PredictedOutcome& a, const PredictedOutcome& b)
{
    double sum = 0.0;
    for (Eigen::Index f = 0; f < a.features.size(); ++f)
    {
        const double va = a.sd(f) * a.sd(f);
        const double vb = b.sd(f) * b.sd(f);
        const double difference = a.features(f) - b.features(f);
        const double both = 0.25 * (va / vb + vb / va - 2.0 + difference * difference * (1.0 / va + 1.0 / vb));
        sum += std::isfinite(both) ? both : 0.0;
    }
    return sum;
}

std::vector<NextExperiment> nextExperiments(
    StudySimulator& studySimulator, const Answer& answer, std::mt19937_64& random)
{
    const Study& study = studySimulator.study();
    std::vector<Explanation> left = answer.set;
    append(left, answer.rivals);
    if (left.empty())
    {
        return {};
    }
    double sum = 0.0;
    for (const auto& explanation : left)
    {
        sum += std::exp(explanation.logOdds - left.front().logOdds);
    }
    Eigen::ArrayXd common = Eigen::ArrayXd::Zero(study.featureCount()); // largest variance that repeats do not show
    for (const auto& block : answer.layout.blocks)
    {
        const auto& features = (*answer.emulator)[block.condition]->features;
        const Eigen::VectorXd variances = block.unshown().diagonal();
        for (Eigen::Index k = 0; k < block.size(); ++k)
        {
            double& largest = common(features[block.places[k]]);
            largest = std::max(largest, variances(k));
        }
    }
    std::vector<NextExperiment> all;
    for (const auto condition : study.conditionsOf(Role::candidate))
    {
        NextExperiment next;
        next.condition = condition;
        for (const auto& explanation : left)
        {
            const std::string name = nameOf(study, explanation.effects);
            std::vector<SimulationOrder> orders;
            orders.reserve(draws);
            for (int number = 0; number < draws; ++number)
            {
                const Eigen::VectorXd parameters = around(explanation.fits.front(), random);
                const auto present = drawnAmplitudes(study, explanation.effects, explanation.fits, random);
                orders.push_back(
                    {condition, settingOf(studySimulator, parameters, present), "next experiment, " + name, number});
            }
            const auto rows = featureRows(studySimulator.run(orders), condition, study.featureCount());
            const Eigen::VectorXd mean = meanFeatures(rows);
            // The spread contains the noise of the runs, which it must not fall below.
            const Eigen::ArrayXXd squares = (rows.rowwise() - mean.transpose()).array().square();
            const Eigen::ArrayXd freedom = squares.isFinite().cast<double>().colwise().sum().transpose() - 1.0;
            const Eigen::ArrayXd spread = squares.isFinite().select(squares, 0.0).colwise().sum().transpose()
                                          / freedom.max(1.0); // without failed runs
            const Eigen::ArrayXd noise = answer.layout.noise.diagonal().array();
            next.outcomes.push_back({name, std::exp(explanation.logOdds - left.front().logOdds) / sum, mean,
                (noise + spread.max(answer.emulator->noise().diagonal().array()) + common).sqrt().matrix()});
        }
        for (std::size_t i = 0; i < next.outcomes.size(); ++i)
        {
            for (std::size_t j = 0; j < i; ++j)
            {
                next.separation += next.outcomes[i].probability * next.outcomes[j].probability
                                   * divergence(next.outcomes[i], next.outcomes[j]);
            }
        }
        next.perCost = next.separation / study.conditions[condition].cost;
        all.push_back(std::move(next));
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.perCost > b.perCost; });
    return all;
}

} // namespace clepsydra::identification
