#include "procedure/effectPairs.h"

#include "procedure/problemAt.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

/// Pairs that are simulated, the most likely ones by the effects' columns.
constexpr std::size_t simulatedPairs = 3;

double logPrior(const Study& study, std::size_t first, std::size_t second)
{
    return std::log(study.effects[first].prior) + std::log(study.effects[second].prior) - study.settings.pairPenalty
           - std::log((static_cast<double>(study.effects.size()) - 1.0) / 2.0);
}

/// A pair as the library's columns show it.
Explanation byColumns(
    const TraceInputs& inputs, const PairScore& pair, const ResidualProblem& problem, const Significance& test)
{
    const auto first = static_cast<std::size_t>(pair.first);
    const auto second = static_cast<std::size_t>(pair.second);
    Explanation explanation;
    explanation.effects = {first, second};
    explanation.logOdds = pair.logEvidence + logPrior(inputs.study, first, second);
    explanation.misfit = pair.misfit;
    explanation.misfitLimit = std::min(test.misfitLimit[first], test.misfitLimit[second]);
    explanation.setting = inputs.simulator.plainSetting(shifted(inputs.study, problem, pair.parameterShift));
    explanation.setting.amplitudes(pair.first) = pair.firstAmplitude;
    explanation.setting.amplitudes(pair.second) = pair.secondAmplitude;
    return explanation;
}

std::vector<Explanation> allByColumns(
    const TraceInputs& inputs, const NullFit& null, const Noise& noise, const Significance& test)
{
    const Study& study = inputs.study;
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(study.effects.size()));
    const auto anchors = null.anchors();
    std::vector<PairScore> best;
    const ResidualProblem* problem = anchors.front();
    for (const ResidualProblem* anchor : anchors)
    {
        auto pairs = pairScores(*anchor, noise, study.bounds(), study.fixed(), none);
        if (best.empty() || pairs.front().logEvidence > best.front().logEvidence)
        {
            best = std::move(pairs);
            problem = anchor;
        }
    }
    std::vector<Explanation> all;
    all.reserve(best.size());
    for (const auto& pair : best)
    {
        all.push_back(byColumns(inputs, pair, *problem, test));
    }
    return all;
}

/// Simulates the pair where its last fit ended, and fits again from there.
/// \return whether that was a long step
bool step(Explanation& explanation, const TraceInputs& inputs, const NullFit& null, const Noise& noise)
{
    const Study& study = inputs.study;
    const auto first = explanation.effects[0];
    const auto second = explanation.effects[1];
    explanation.simulations = inputs.simulator.repeats(inputs.training, explanation.setting,
        "confirmation of " + nameOf(study, explanation), study.settings.repeatsConfirmation, confirmationSeeds);
    const std::vector<Eigen::Index> columns = {static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(second)};
    const ResidualProblem problem =
        problemAt(inputs, explanation.simulations, explanation.setting, explanation.effects).withEffects(columns);
    const Eigen::VectorXd anchor = explanation.setting.amplitudes(columns);
    const auto bounds = study.bounds();
    const auto fixed = study.fixed();
    const PairScore best =
        pairScores(problem, noise, {bounds[first], bounds[second]}, {fixed[first], fixed[second]}, anchor).front();
    explanation.logOdds = best.logEvidence + logPrior(study, first, second);
    explanation.misfit = best.misfit;
    explanation.confirmed = problem.residual.size() == null.problem.residual.size();
    explanation.setting.parameters = shifted(study, problem, best.parameterShift);
    explanation.setting.amplitudes(columns[0]) = best.firstAmplitude;
    explanation.setting.amplitudes(columns[1]) = best.secondAmplitude;
    return best.parameterShift.size() > 0 && best.parameterShift.cwiseAbs().maxCoeff() >= farInPriorSds;
}

/// Simulated; again where it misfits and its steps are long.
Explanation confirmed(Explanation explanation, const TraceInputs& inputs, const NullFit& null, const Noise& noise)
{
    bool onItsWay = true;
    for (int i = 0; onItsWay && i <= stepsToTheEnd; ++i)
    {
        onItsWay = step(explanation, inputs, null, noise) && explanation.misfit > explanation.misfitLimit;
    }
    return explanation;
}

} // namespace

std::vector<Explanation> EffectPairs::like(const Explanation& pair, double setWidth) const
{
    std::vector<Explanation> alike;
    const auto isSame = [](const Explanation& one) {
        return [&one](const Explanation& other) { return other.effects == one.effects; };
    };
    const auto own = std::find_if(byColumns.begin(), byColumns.end(), isSame(pair));
    if (own == byColumns.end())
    {
        return alike;
    }
    std::copy_if(byColumns.begin(), byColumns.end(), std::back_inserter(alike), [&](const Explanation& other) {
        return other.logOdds > own->logOdds - setWidth
               && std::none_of(simulated.begin(), simulated.end(), isSame(other));
    });
    return alike;
}

EffectPairs tryPairs(const TraceInputs& inputs, const NullFit& null, const Noise& noise, const Significance& test,
    const std::vector<Explanation>& singles)
{
    EffectPairs pairs;
    if (!inputs.study.settings.pairs || singles.size() < 2)
    {
        return pairs;
    }
    pairs.byColumns = allByColumns(inputs, null, noise, test);
    for (std::size_t i = 0; i < std::min(simulatedPairs, pairs.byColumns.size()); ++i)
    {
        if (pairs.byColumns[i].logOdds > singles.front().logOdds - inputs.study.settings.setWidth)
        {
            pairs.simulated.push_back(confirmed(pairs.byColumns[i], inputs, null, noise));
        }
    }
    return pairs;
}

} // namespace clepsydra::identification
