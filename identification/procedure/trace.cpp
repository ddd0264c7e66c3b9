#include "procedure/trace.h"

#include "procedure/assemble.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

/// A fit that ends further than this from where the simulator was run is run again there.
constexpr double farInPriorSds = 1.0;
constexpr int nullFits = 2;
constexpr int exactNullFits = 5;

/// Repeats of data and simulation whose spreads differ by as much as in fewer cases than this are not pooled.
constexpr double otherSpread = 0.01;

/// Effects this much less likely than the best one in the linear scores are not worth runs of the simulator.
constexpr double hopeless = 6.0;

/// Of an effect of the measuring chain: steps towards its fit, which cost no runs, and how near is near enough.
constexpr int chainSteps = 8;
constexpr double nearInAmplitude = 0.01;
constexpr double smallAmplitude = 0.02; // for derivatives

/// A confirmation is near enough to its fit if the fit is this many standard errors away.
constexpr double nearInErrors = 1.0;

/// Pairs that are simulated, the most likely ones by the effects' columns.
constexpr std::size_t simulatedPairs = 3;

/// Explanations are simulated with the same seeds, so that chance speaks for none of them: two that set the same entries
/// are alike to the last digit, instead of as far apart as two simulations.
const std::string confirmationSeeds = "confirmation";

/// Steps beyond the study's rounds for an explanation that misfits and has not come to the end of its way.
constexpr int stepsToTheEnd = 3;

class Tracing
{
public:
    Tracing(Simulator& simulator, const EffectLibrary& library, const std::vector<MeasuredCondition>& data,
        std::mt19937_64& random)
        : simulator_(simulator),
          study_(simulator.study()),
          library_(library),
          data_(data),
          random_(random),
          training_(study_.conditionsOf(Role::training))
    {}

    Answer run()
    {
        answer_.remarks = library_.remarks;
        estimateNoise();
        fitNull();
        test();
        scoreAll();
        if (answer_.significance.pValue < study_.settings.level)
        {
            confirmBest();
            decide();
        }
        return std::move(answer_);
    }

private:
    void estimateNoise()
    {
        Scatter measured;
        bool declared = true;
        for (const auto condition : training_)
        {
            measured.add(data_[condition].features);
            declared = declared && hasDeclaredErrors(data_[condition]);
        }
        answer_.spread = compareSpread(measured, library_.scatter, study_.settings.draws, random_);
        const bool alike = answer_.spread.pValue > otherSpread;
        answer_.noise = noiseModel(measured, library_.scatter, study_.modelError, alike, declared);
        if (measured.degreesOfFreedom() < 2.0 && answer_.noise.data.matrix.isZero())
        {
            answer_.remarks.emplace_back(
                "Nothing has been measured more than once: the noise is what the study declares, "
                "taken as independent from number to number.");
        }
        if (!alike)
        {
            answer_.remarks.push_back(
                "Repeats of the measurement scatter " + textOf(answer_.spread.ratio)
                + " times as much (in variance) as those of the simulation, p = " + textOf(answer_.spread.pValue)
                + ": a signature of its own, as of cohesion or clogging. They are not pooled.");
        }
    }

    /// Linear fit on the library, simulation at the fit, fit again: the test must not see the library's curvature.
    void fitNull()
    {
        std::vector<Simulation> base;
        for (const auto condition : training_)
        {
            const auto& rows = library_.conditions[condition].baseFeatures;
            for (Eigen::Index row = 0; row < rows.rows(); ++row)
            {
                base.push_back({condition, rows.row(row).transpose(), {}, {}, 0, false});
            }
        }
        Eigen::VectorXd anchor = simulator_.plainSetting().parameters;
        atBase_ = assemble(study_, library_, data_, base, anchor);
        answer_.problem = atBase_;
        if (answer_.problem.residual.size() <= answer_.problem.parameterColumns.cols())
        {
            throw std::runtime_error(
                study_.file.string() + ": the training conditions have too few features in common with the simulation");
        }
        // Without scatter a fit can be followed to its end: what is left of it would be taken for a residual.
        const bool exact = study_.rig.seedEntry.empty();
        for (int fit = 0; fit < (exact ? exactNullFits : nullFits); ++fit)
        {
            anchor = shifted(answer_.problem, Fits(whitened(answer_.problem, answer_.noise)).parameterShift());
            answer_.atFit = simulator_.repeats(training_, simulator_.plainSetting(anchor),
                fit == 0 ? "null fit" : "null fit, again", study_.settings.repeatsAtFit);
            answer_.problem = assemble(study_, library_, data_, answer_.atFit, anchor);
            const Fits refit(whitened(answer_.problem, answer_.noise));
            const Eigen::VectorXd shift = refit.parameterShift();
            answer_.null.setting = simulator_.plainSetting(shifted(answer_.problem, shift));
            answer_.null.misfit = refit.nullMisfit();
            answer_.parameterSd = refit.parameterCovariance().diagonal().cwiseSqrt();
            const Eigen::ArrayXd away = shift.cwiseAbs();
            const bool far =
                (away >= farInPriorSds).any() || (exact && (away > nearInErrors * answer_.parameterSd.array()).any());
            if (!far)
            {
                break;
            }
        }
    }

    /// Physical parameters after a shift from a problem's anchor, within their limits.
    Eigen::VectorXd shifted(const ResidualProblem& problem, const Eigen::VectorXd& shift) const
    {
        return physical(study_, problem.parameterOffset + shift);
    }

    void test()
    {
        answer_.significance =
            significance(answer_.problem, answer_.noise, study_.bounds(), study_.settings.draws, random_);
        answer_.null.misfitLimit = answer_.significance.nullMisfitLimit;
        answer_.nullLogOdds = nullEvidence(answer_.problem, answer_.noise);
        answer_.null.logOdds = answer_.nullLogOdds;
        answer_.otherLogOdds = otherEvidence(answer_.problem, answer_.noise) + std::log(study_.settings.otherWeight);
    }

    /// Whether the null fit has gone so far that the library's columns, taken at the base setting, may not hold there. A
    /// large effect that is left out does so; with the effect the parameters are nearer to the base setting again.
    bool nullIsFar() const
    {
        const Eigen::ArrayXd away = (answer_.problem.parameterOffset - atBase_.parameterOffset).array().abs();
        return (away >= farInPriorSds).any() && atBase_.residual.size() == answer_.problem.residual.size();
    }

    void scoreAll()
    {
        const bool alsoFromBase = nullIsFar();
        for (std::size_t e = 0; e < study_.effects.size(); ++e)
        {
            const Effect& effect = study_.effects[e];
            EffectFinding finding;
            finding.linear = effect.isOfChain() ? scoreChain(e)
                                                : score(answer_.problem, answer_.noise, static_cast<Eigen::Index>(e),
                                                    effect.bounds, 0.0, effect.isSwitch);
            finding.parameters = shifted(answer_.problem, finding.linear.parameterShift);
            if (alsoFromBase)
            {
                const Score fromBase =
                    score(atBase_, answer_.noise, static_cast<Eigen::Index>(e), effect.bounds, 0.0, effect.isSwitch);
                if (fromBase.logEvidence > finding.linear.logEvidence)
                {
                    finding.linear = fromBase;
                    finding.parameters = shifted(atBase_, fromBase.parameterShift);
                }
            }
            finding.logOdds = finding.linear.logEvidence + std::log(effect.prior);
            finding.misfitLimit = answer_.significance.misfitLimit[e];
            answer_.effects.push_back(std::move(finding));
        }
    }

    /// The simulations with effects of the measuring chain at other amplitudes; nothing is run.
    std::vector<Simulation> throughChain(std::vector<Simulation> simulations, const Eigen::VectorXd& amplitudes) const
    {
        for (auto& simulation : simulations)
        {
            if (!simulation.failed)
            {
                simulation.curve = simulator_.throughChain(simulation.plain, simulation.condition, amplitudes);
                simulation.features = simulator_.featuresOf(simulation.curve);
            }
        }
        return simulations;
    }

    /// The problem at simulations of a setting. Of the effects given, the columns of those of the measuring chain are
    /// taken at their amplitudes, from these very curves.
    ResidualProblem problemAt(const std::vector<Simulation>& simulations, const Setting& setting,
        const std::vector<std::size_t>& effects) const
    {
        ResidualProblem problem = assemble(study_, library_, data_, simulations, setting.parameters);
        for (const std::size_t e : effects)
        {
            if (!study_.effects[e].isOfChain())
            {
                continue;
            }
            const auto column = static_cast<Eigen::Index>(e);
            const Bounds& bounds = study_.effects[e].bounds;
            Eigen::VectorXd lower = setting.amplitudes;
            Eigen::VectorXd upper = setting.amplitudes;
            lower(column) = std::max(lower(column) - smallAmplitude, bounds.lower);
            upper(column) = std::min(upper(column) + smallAmplitude, bounds.upper);
            const auto below = assemble(study_, library_, data_, throughChain(simulations, lower), setting.parameters);
            const auto above = assemble(study_, library_, data_, throughChain(simulations, upper), setting.parameters);
            if (below.residual.size() == problem.residual.size() && above.residual.size() == problem.residual.size())
            {
                problem.effectColumns.col(column) = (below.residual - above.residual) / (upper(column) - lower(column));
            }
        }
        return problem;
    }

    /// Gauss-Newton for an effect of the measuring chain, on the curves of the null fit.
    Score scoreChain(std::size_t e) const
    {
        const Effect& effect = study_.effects[e];
        const auto index = static_cast<Eigen::Index>(e);
        Setting setting = simulator_.plainSetting(physical(study_, answer_.problem.parameterOffset));
        double& amplitude = setting.amplitudes(index);
        amplitude = effect.isSwitch ? 1.0 : 0.0;
        Score best = score(answer_.problem, answer_.noise, index, effect.bounds, 0.0, effect.isSwitch);
        for (int step = 0; step < chainSteps; ++step)
        {
            const auto problem = problemAt(throughChain(answer_.atFit, setting.amplitudes), setting, {e});
            if (problem.residual.size() != answer_.problem.residual.size())
            {
                break;
            }
            best = score(problem, answer_.noise, index, effect.bounds, amplitude, effect.isSwitch);
            if (std::abs(best.amplitude - amplitude) < nearInAmplitude)
            {
                break;
            }
            // Half a step where the first ones did not settle: features are kinked at the ends of windows.
            amplitude = step < chainSteps / 2 ? best.amplitude : (best.amplitude + amplitude) / 2;
        }
        return best;
    }

    std::vector<std::size_t> byOdds() const
    {
        std::vector<std::size_t> order(answer_.effects.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
            [&](auto a, auto b) { return answer_.effects[a].logOdds > answer_.effects[b].logOdds; });
        return order;
    }

    /// The few best effects, switched on in the simulator with fresh seeds, and one Gauss-Newton step from there. Once
    /// more where that step was a long one, or where several effects are so close that seeds decide between them.
    void confirmBest()
    {
        for (int round = 0; round < study_.settings.rounds; ++round)
        {
            const auto order = byOdds();
            const auto most = std::min(order.size(), static_cast<std::size_t>(study_.settings.confirmations));
            const double best = order.empty() ? 0.0 : answer_.effects[order.front()].logOdds;
            const auto contenders = std::count_if(answer_.effects.begin(), answer_.effects.end(),
                [&](const EffectFinding& finding) { return finding.logOdds > best - study_.settings.setWidth; });
            for (std::size_t rank = 0; rank < most; ++rank)
            {
                const EffectFinding& finding = answer_.effects[order[rank]];
                const bool contends = contenders > 1 && finding.logOdds > best - study_.settings.setWidth;
                if (finding.logOdds > best - hopeless && finding.score().amplitude != 0.0
                    && (contends || !isNear(order[rank])))
                {
                    confirm(order[rank], round);
                }
            }
        }
        followBest();
    }

    /// A large effect that was left out has carried the null's parameters far away, where the library's columns do not
    /// hold; one or two steps do not lead back. Without this it would be answered by "unknown".
    void followBest()
    {
        for (int step = 0; step < stepsToTheEnd && !answer_.effects.empty(); ++step)
        {
            const std::size_t best = byOdds().front();
            const EffectFinding& finding = answer_.effects[best];
            if (simulatedAt_.count(best) == 0 || isNear(best) || finding.score().misfit <= finding.misfitLimit)
            {
                return;
            }
            confirm(best, study_.settings.rounds);
        }
    }

    /// Whether the effect has been simulated close to where its fit ended.
    bool isNear(std::size_t e) const
    {
        const auto simulated = simulatedAt_.find(e);
        if (simulated == simulatedAt_.end())
        {
            return false;
        }
        const Score& score = *answer_.effects[e].confirmed;
        const double away = std::abs(score.amplitude - simulated->second);
        return away <= nearInErrors * score.sd
               && (score.parameterShift.size() == 0 || score.parameterShift.cwiseAbs().maxCoeff() < farInPriorSds);
    }

    void confirm(std::size_t e, int round)
    {
        const Effect& effect = study_.effects[e];
        EffectFinding& finding = answer_.effects[e];
        Setting setting = settingOf(e);
        const double amplitude = setting.amplitudes(static_cast<Eigen::Index>(e));
        const std::string again = round > 0 ? ", again" : "";
        const auto simulations = simulator_.repeats(training_, setting, "confirmation of " + effect.name + again,
            study_.settings.repeatsConfirmation, confirmationSeeds + again);
        auto problem = problemAt(simulations, setting, {e});
        if (problem.residual.size() < answer_.problem.residual.size())
        {
            answer_.remarks.push_back(
                "effect " + effect.name
                + " could not be confirmed: runs with it on have failed or lack features; its linear score is kept");
            return;
        }
        if (isNear(e) && problems_.at(e).residual.size() == problem.residual.size())
        {
            averageWithEarlier(problem, problems_.at(e), static_cast<Eigen::Index>(e), amplitude - simulatedAt_.at(e));
        }
        finding.confirmed =
            score(problem, answer_.noise, static_cast<Eigen::Index>(e), effect.bounds, amplitude, effect.isSwitch);
        finding.logOdds = finding.confirmed->logEvidence + std::log(effect.prior);
        simulatedAt_[e] = amplitude;
        setting.parameters = shifted(problem, finding.confirmed->parameterShift);
        setting.amplitudes(static_cast<Eigen::Index>(e)) = finding.confirmed->amplitude;
        settings_[e] = setting;
        simulations_[e] = simulations;
        problems_[e] = problem;
    }

    /// Earlier simulations of the same effect close by count as well, carried over the short way by the columns: the
    /// more seeds, the fairer the comparison of effects, each of which has simulations of its own.
    static void averageWithEarlier(
        ResidualProblem& problem, const ResidualProblem& earlier, Eigen::Index effect, double step)
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

    /// Where an effect's last fit ended.
    Setting settingOf(std::size_t e) const
    {
        if (const auto found = settings_.find(e); found != settings_.end())
        {
            return found->second;
        }
        const EffectFinding& finding = answer_.effects[e];
        Setting setting = simulator_.plainSetting(finding.parameters);
        setting.amplitudes(static_cast<Eigen::Index>(e)) = finding.linear.amplitude;
        return setting;
    }

    Explanation explanationOf(std::size_t e) const
    {
        const EffectFinding& finding = answer_.effects[e];
        Explanation explanation;
        explanation.effects = {e};
        explanation.logOdds = finding.logOdds;
        explanation.misfit = finding.score().misfit;
        explanation.misfitLimit = finding.misfitLimit;
        explanation.confirmed = finding.confirmed.has_value();
        explanation.setting = settingOf(e);
        return explanation;
    }

    /// The most likely pairs, where they beat the best single effect by more than their penalty, switched on and scored
    /// again.
    void tryPairs(std::vector<Explanation>& explanations)
    {
        if (!study_.settings.pairs || study_.effects.size() < 2)
        {
            return;
        }
        const Eigen::VectorXd none = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(study_.effects.size()));
        const auto pairsAt = [&](const ResidualProblem& problem) {
            return pairScores(problem, answer_.noise, study_.bounds(), study_.fixed(), none);
        };
        auto pairs = pairsAt(answer_.problem);
        const ResidualProblem* problem = &answer_.problem;
        if (nullIsFar())
        {
            const auto fromBase = pairsAt(atBase_);
            if (fromBase.front().logEvidence > pairs.front().logEvidence)
            {
                pairs = fromBase;
                problem = &atBase_;
            }
        }
        for (const auto& pair : pairs)
        {
            pairsByColumns_.push_back(byColumns(pair, *problem));
        }
        for (std::size_t i = 0; i < std::min(simulatedPairs, pairsByColumns_.size()); ++i)
        {
            if (pairsByColumns_[i].logOdds > explanations.front().logOdds - study_.settings.setWidth)
            {
                answer_.pairs.push_back(confirmedPair(pairsByColumns_[i]));
            }
        }
        explanations.insert(explanations.end(), answer_.pairs.begin(), answer_.pairs.end());
    }

    double logPriorOfPair(std::size_t first, std::size_t second) const
    {
        return std::log(study_.effects[first].prior) + std::log(study_.effects[second].prior)
               - study_.settings.pairPenalty - std::log((static_cast<double>(study_.effects.size()) - 1.0) / 2.0);
    }

    /// A pair as the library's columns show it.
    Explanation byColumns(const PairScore& pair, const ResidualProblem& problem) const
    {
        const auto first = static_cast<std::size_t>(pair.first);
        const auto second = static_cast<std::size_t>(pair.second);
        Explanation explanation;
        explanation.effects = {first, second};
        explanation.logOdds = pair.logEvidence + logPriorOfPair(first, second);
        explanation.misfit = pair.misfit;
        explanation.misfitLimit = std::min(answer_.effects[first].misfitLimit, answer_.effects[second].misfitLimit);
        explanation.setting = simulator_.plainSetting(shifted(problem, pair.parameterShift));
        explanation.setting.amplitudes(pair.first) = pair.firstAmplitude;
        explanation.setting.amplitudes(pair.second) = pair.secondAmplitude;
        return explanation;
    }

    /// The pair, simulated where its last fit ended; again from there while it misfits and its steps are long.
    Explanation confirmedPair(Explanation explanation)
    {
        for (int step = 0; step <= stepsToTheEnd; ++step)
        {
            if (!stepOfPair(explanation) || explanation.misfit <= explanation.misfitLimit)
            {
                break;
            }
        }
        return explanation;
    }

    /// \return whether it was a long step
    bool stepOfPair(Explanation& explanation)
    {
        const auto first = explanation.effects[0];
        const auto second = explanation.effects[1];
        const auto simulations = simulator_.repeats(training_, explanation.setting,
            "confirmation of " + study_.effects[first].name + " with " + study_.effects[second].name,
            study_.settings.repeatsConfirmation, confirmationSeeds);
        const std::vector<Eigen::Index> columns = {static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(second)};
        const ResidualProblem problem =
            problemAt(simulations, explanation.setting, explanation.effects).withEffects(columns);
        const Eigen::VectorXd anchor = explanation.setting.amplitudes(columns);
        const auto bounds = study_.bounds();
        const auto fixed = study_.fixed();
        const PairScore best =
            pairScores(problem, answer_.noise, {bounds[first], bounds[second]}, {fixed[first], fixed[second]}, anchor)
                .front();
        explanation.logOdds = best.logEvidence + logPriorOfPair(first, second);
        explanation.misfit = best.misfit;
        explanation.confirmed = problem.residual.size() == answer_.problem.residual.size();
        explanation.setting.parameters = shifted(problem, best.parameterShift);
        explanation.setting.amplitudes(columns[0]) = best.firstAmplitude;
        explanation.setting.amplitudes(columns[1]) = best.secondAmplitude;
        return best.parameterShift.size() > 0 && best.parameterShift.cwiseAbs().maxCoeff() >= farInPriorSds;
    }

    /// Pairs that nobody simulated and that are as likely as this one. The columns, crude for the evidence itself, are
    /// believed for the difference between two pairs: a name for one of many alike would be a set reported as a name.
    std::vector<Explanation> pairsLike(const Explanation& best) const
    {
        std::vector<Explanation> alike;
        const auto own = std::find_if(pairsByColumns_.begin(), pairsByColumns_.end(),
            [&](const Explanation& pair) { return pair.effects == best.effects; });
        if (own == pairsByColumns_.end())
        {
            return alike;
        }
        const auto isSimulated = [&](const Explanation& pair) {
            return std::any_of(answer_.pairs.begin(), answer_.pairs.end(),
                [&](const Explanation& other) { return other.effects == pair.effects; });
        };
        std::copy_if(
            pairsByColumns_.begin(), pairsByColumns_.end(), std::back_inserter(alike), [&](const Explanation& pair) {
                return pair.logOdds > own->logOdds - study_.settings.setWidth && !isSimulated(pair);
            });
        return alike;
    }

    void decide()
    {
        std::vector<Explanation> explanations;
        for (const auto e : byOdds())
        {
            explanations.push_back(explanationOf(e));
        }
        if (explanations.empty())
        {
            answer_.decision = Decision::unknown;
            return;
        }
        tryPairs(explanations);
        std::stable_sort(explanations.begin(), explanations.end(),
            [](const auto& a, const auto& b) { return a.logOdds > b.logOdds; });
        const Explanation& best = explanations.front();
        if (best.misfit > best.misfitLimit || answer_.otherLogOdds > best.logOdds)
        {
            answer_.decision = Decision::unknown;
            answer_.bestOfUnknown = best;
            return;
        }
        for (const auto& explanation : explanations)
        {
            if (explanation.logOdds > best.logOdds - study_.settings.setWidth
                && explanation.misfit <= explanation.misfitLimit)
            {
                answer_.set.push_back(explanation);
                if (explanation.effects.size() == 1)
                {
                    answer_.effects[explanation.effects.front()].inSet = true;
                }
            }
        }
        answer_.otherInSet = answer_.otherLogOdds > best.logOdds - study_.settings.setWidth;
        answer_.pairsAlike = pairsLike(best);
        const bool alone = answer_.set.size() == 1 && answer_.pairsAlike.empty() && !answer_.otherInSet;
        answer_.decision = alone ? Decision::named : Decision::set;
        if (const auto found = simulations_.find(best.effects.front());
            found != simulations_.end() && best.effects.size() == 1)
        {
            answer_.ofBest = found->second;
        }
    }

    Simulator& simulator_;
    const Study& study_;
    const EffectLibrary& library_;
    const std::vector<MeasuredCondition>& data_;
    std::mt19937_64& random_;
    std::vector<std::size_t> training_;
    ResidualProblem atBase_;                  // at the prior's means
    std::vector<Explanation> pairsByColumns_; // most likely first, as the library's columns show them
    std::map<std::size_t, Setting> settings_;
    std::map<std::size_t, double> simulatedAt_; // amplitude
    std::map<std::size_t, ResidualProblem> problems_;
    std::map<std::size_t, std::vector<Simulation>> simulations_;
    Answer answer_;
};

} // namespace

Answer trace(Simulator& simulator, const EffectLibrary& library, const std::vector<MeasuredCondition>& data,
    std::mt19937_64& random)
{
    return Tracing(simulator, library, data, random).run();
}

} // namespace clepsydra::identification
