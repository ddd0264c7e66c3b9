#include "procedure/singleEffects.h"

#include "procedure/assemble.h"
#include "procedure/problemAt.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace clepsydra::identification
{

namespace
{

/// Effects this much less likely than the best one in the linear scores are not worth runs of the simulator.
constexpr double hopeless = 6.0;

/// Of an effect of the measuring chain: steps towards its fit, which cost no runs, and how near is near enough.
constexpr int chainSteps = 8;
constexpr double nearInAmplitude = 0.01;

/// Earlier simulations of the same effect close by count as well, carried over the short way by the columns: the more
/// seeds, the fairer the comparison of effects, each of which has simulations of its own.
void averageWithEarlier(ResidualProblem& problem, const ResidualProblem& earlier, Eigen::Index effect, double step)
{
    const Eigen::VectorXd carried = earlier.residual
                                    - problem.parameterColumns * (problem.parameterOffset - earlier.parameterOffset)
                                    - step * problem.effectColumns.col(effect);
    problem.residual = 0.5 * (problem.residual + carried);
    for (std::size_t block = 0; block < problem.blocks.size(); ++block)
    {
        double& share = problem.blocks[block].simulationShare;
        share = 0.25 * (share + earlier.blocks[block].simulationShare);
    }
}

} // namespace

SingleEffects::SingleEffects(
    const TraceInputs& inputs, const NullFit& null, const Noise& noise, const Significance& test)
    : inputs_(inputs),
      null_(null),
      noise_(noise)
{
    for (std::size_t e = 0; e < inputs.study.effects.size(); ++e)
    {
        trials_.push_back(scoredByColumn(e));
        trials_.back().finding.misfitLimit = test.misfitLimit[e];
    }
}

SingleEffects::Trial SingleEffects::scoredByColumn(std::size_t e) const
{
    const Effect& effect = inputs_.study.effects[e];
    const auto index = static_cast<Eigen::Index>(e);
    Trial trial;
    EffectFinding& finding = trial.finding;
    for (const ResidualProblem* anchor : null_.anchors())
    {
        const bool isFirst = anchor == &null_.problem;
        const Score fromHere = isFirst && effect.isOfChain()
                                   ? scoreChain(e)
                                   : score(*anchor, noise_, index, effect.bounds, 0.0, effect.isSwitch);
        if (isFirst || fromHere.logEvidence > finding.linear.logEvidence)
        {
            finding.linear = fromHere;
            finding.parameters = shifted(inputs_.study, *anchor, fromHere.parameterShift);
        }
    }
    finding.logOdds = finding.linear.logEvidence + std::log(effect.prior);
    trial.setting = inputs_.simulator.plainSetting(finding.parameters);
    trial.setting.amplitudes(index) = finding.linear.amplitude;
    return trial;
}

/// Gauss-Newton for an effect of the measuring chain, on the curves of the null fit.
Score SingleEffects::scoreChain(std::size_t e) const
{
    const Effect& effect = inputs_.study.effects[e];
    const auto index = static_cast<Eigen::Index>(e);
    Setting setting = inputs_.simulator.plainSetting(physical(inputs_.study, null_.problem.parameterOffset));
    double& amplitude = setting.amplitudes(index);
    amplitude = effect.isSwitch ? 1.0 : 0.0;
    Score best = score(null_.problem, noise_, index, effect.bounds, 0.0, effect.isSwitch);
    for (int step = 0; step < chainSteps; ++step)
    {
        const auto problem =
            problemAt(inputs_, throughChain(inputs_, null_.simulations, setting.amplitudes), setting, {e});
        if (problem.residual.size() != null_.problem.residual.size())
        {
            break;
        }
        best = score(problem, noise_, index, effect.bounds, amplitude, effect.isSwitch);
        if (std::abs(best.amplitude - amplitude) < nearInAmplitude)
        {
            break;
        }
        // Half a step where the first ones did not settle: features are kinked at the ends of windows.
        amplitude = step < chainSteps / 2 ? best.amplitude : (best.amplitude + amplitude) / 2;
    }
    return best;
}

std::vector<std::size_t> SingleEffects::byOdds() const
{
    std::vector<std::size_t> order(trials_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
        [&](auto a, auto b) { return trials_[a].finding.logOdds > trials_[b].finding.logOdds; });
    return order;
}

void SingleEffects::confirmBest()
{
    const Settings& settings = inputs_.study.settings;
    for (int round = 0; !trials_.empty() && round < settings.rounds; ++round)
    {
        const auto order = byOdds();
        const auto most = std::min(order.size(), static_cast<std::size_t>(settings.confirmations));
        const double best = trials_[order.front()].finding.logOdds;
        const auto isClose = [&](const Trial& trial) { return trial.finding.logOdds > best - settings.setWidth; };
        const bool seedsDecide = std::count_if(trials_.begin(), trials_.end(), isClose) > 1;
        for (std::size_t rank = 0; rank < most; ++rank)
        {
            const Trial& trial = trials_[order[rank]];
            const bool contends = seedsDecide && isClose(trial);
            if (trial.finding.logOdds > best - hopeless && trial.finding.score().amplitude != 0.0
                && (contends || !isNear(trial)))
            {
                confirm(order[rank], round);
            }
        }
    }
    followBest();
}

/// A large effect that was left out has carried the null's parameters far away, where the library's columns do not hold;
/// one or two steps do not lead back. Without this it would be answered by "unknown".
void SingleEffects::followBest()
{
    for (int step = 0; step < stepsToTheEnd && !trials_.empty(); ++step)
    {
        const std::size_t best = byOdds().front();
        const Trial& trial = trials_[best];
        if (!trial.finding.confirmed || isNear(trial) || trial.finding.score().misfit <= trial.finding.misfitLimit)
        {
            return;
        }
        confirm(best, inputs_.study.settings.rounds);
    }
}

/// Whether the effect has been simulated close to where its fit ended.
bool SingleEffects::isNear(const Trial& trial) const
{
    if (!trial.finding.confirmed)
    {
        return false;
    }
    const Score& score = *trial.finding.confirmed;
    return std::abs(score.amplitude - trial.simulatedAt) <= nearInErrors * score.sd
           && (score.parameterShift.size() == 0 || score.parameterShift.cwiseAbs().maxCoeff() < farInPriorSds);
}

void SingleEffects::confirm(std::size_t e, int round)
{
    const Effect& effect = inputs_.study.effects[e];
    const auto index = static_cast<Eigen::Index>(e);
    Trial& trial = trials_[e];
    const double amplitude = trial.setting.amplitudes(index);
    const std::string again = round > 0 ? ", again" : "";
    auto simulations =
        inputs_.simulator.repeats(inputs_.training, trial.setting, "confirmation of " + effect.name + again,
            inputs_.study.settings.repeatsConfirmation, confirmationSeeds + again);
    auto problem = problemAt(inputs_, simulations, trial.setting, {e});
    if (problem.residual.size() < null_.problem.residual.size())
    {
        remarks_.push_back(
            "effect " + effect.name
            + " could not be confirmed: runs with it on have failed or lack features; its linear score is "
              "kept");
        return;
    }
    if (isNear(trial) && trial.problem.residual.size() == problem.residual.size())
    {
        averageWithEarlier(problem, trial.problem, index, amplitude - trial.simulatedAt);
    }
    const Score confirmed = score(problem, noise_, index, effect.bounds, amplitude, effect.isSwitch);
    trial.finding.confirmed = confirmed;
    trial.finding.logOdds = confirmed.logEvidence + std::log(effect.prior);
    trial.simulatedAt = amplitude;
    trial.setting.parameters = shifted(inputs_.study, problem, confirmed.parameterShift);
    trial.setting.amplitudes(index) = confirmed.amplitude;
    trial.problem = std::move(problem);
    trial.simulations = std::move(simulations);
}

std::vector<EffectFinding> SingleEffects::findings() const
{
    std::vector<EffectFinding> all;
    for (const Trial& trial : trials_)
    {
        all.push_back(trial.finding);
    }
    return all;
}

std::vector<Explanation> SingleEffects::explanations() const
{
    std::vector<Explanation> all;
    for (const auto e : byOdds())
    {
        const Trial& trial = trials_[e];
        const EffectFinding& finding = trial.finding;
        all.push_back({{e}, trial.setting, finding.logOdds, finding.score().misfit, finding.misfitLimit,
            finding.confirmed.has_value(), trial.simulations});
    }
    return all;
}

} // namespace clepsydra::identification
