#include "procedure/trace.h"

#include "procedure/assemble.h"
#include "procedure/decide.h"
#include "procedure/doubts.h"
#include "procedure/effectPairs.h"
#include "procedure/nullFit.h"
#include "procedure/singleEffects.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

class Tracing
{
public:
    Tracing(Simulator& simulator, const EffectLibrary& library, const std::vector<MeasuredCondition>& data,
        std::mt19937_64& random)
        : study_(simulator.study()),
          inputs_{simulator, study_, library, data, study_.conditionsOf(Role::training)},
          random_(random)
    {}

    Answer run()
    {
        answer_.remarks = inputs_.library.remarks;
        estimateNoise();
        const NullFit null = fitNull(inputs_, answer_.noise);
        test(null);
        SingleEffects singles(inputs_, null, answer_.noise, answer_.significance);
        if (answer_.significance.pValue < study_.settings.level)
        {
            singles.confirmBest();
            explain(null, singles.explanations());
        }
        report(null, singles);
        return std::move(answer_);
    }

private:
    void estimateNoise()
    {
        const auto [repeats, declared] = scatterOf(inputs_.data, inputs_.training);
        measured_ = repeats;
        const Scatter& simulated = inputs_.library.scatter;
        answer_.spread = compareSpread(measured_, simulated, study_.settings.draws, random_);
        const bool alike = answer_.spread.pValue > otherSpread;
        answer_.noise = noiseModel(measured_, simulated, study_.modelError, alike, declared);
        if (measured_.degreesOfFreedom() < 2.0 && answer_.noise.data.matrix.isZero())
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

    void test(const NullFit& null)
    {
        answer_.significance =
            significance(null.problem, answer_.noise, study_.bounds(), study_.settings.draws, random_);
        answer_.otherLogOdds = otherEvidence(null.problem, answer_.noise) + std::log(study_.settings.otherWeight);
    }

    void explain(const NullFit& null, std::vector<Explanation> explanations)
    {
        const EffectPairs pairs = tryPairs(inputs_, null, answer_.noise, answer_.significance, explanations);
        answer_.pairs = pairs.simulated;
        explanations.insert(explanations.end(), pairs.simulated.begin(), pairs.simulated.end());
        std::stable_sort(explanations.begin(), explanations.end(),
            [](const auto& a, const auto& b) { return a.logOdds > b.logOdds; });
        if (explanations.empty())
        {
            answer_.decision = Decision::unknown;
            return;
        }
        const Explanation& best = explanations.front();
        auto pairsAlike = pairs.like(best, study_.settings.setWidth);
        auto doubts = doubtsAbout(best, answer_, null.misfit, measured_, inputs_, random_);
        Verdict verdict = decide(
            explanations, answer_.otherLogOdds, !doubts.empty() || !pairsAlike.empty(), study_.settings.setWidth);
        answer_.decision = verdict.decision;
        answer_.set = std::move(verdict.set);
        answer_.bestOfUnknown = std::move(verdict.bestOfUnknown);
        if (!answer_.set.empty())
        {
            answer_.somethingElseBecause = std::move(doubts);
            answer_.pairsAlike = std::move(pairsAlike);
        }
    }

    void report(const NullFit& null, const SingleEffects& singles)
    {
        answer_.null.setting = null.setting;
        answer_.null.misfit = null.misfit;
        answer_.null.misfitLimit = answer_.significance.nullMisfitLimit;
        answer_.null.logOdds = nullEvidence(null.problem, answer_.noise);
        answer_.problem = null.problem;
        answer_.parameterSd = null.parameterSd;
        answer_.atFit = null.simulations;
        answer_.effects = singles.findings();
        answer_.remarks.insert(answer_.remarks.end(), singles.remarks().begin(), singles.remarks().end());
        for (const auto& explanation : answer_.set)
        {
            if (explanation.effects.size() == 1)
            {
                answer_.effects[explanation.effects.front()].inSet = true;
            }
        }
    }

    const Study& study_;
    const TraceInputs inputs_;
    std::mt19937_64& random_;
    Scatter measured_;
    Answer answer_;
};

} // namespace

Answer trace(Simulator& simulator, const EffectLibrary& library, const std::vector<MeasuredCondition>& data,
    std::mt19937_64& random)
{
    return Tracing(simulator, library, data, random).run();
}

} // namespace clepsydra::identification
