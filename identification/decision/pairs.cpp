#include "decision/pairs.h"

#include "lists.h"
#include "tokens/didYouMean.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace clepsydra::identification
{

namespace
{

/// Largest number of pairs that are followed up, and number of synthetic data sets with each.
constexpr std::size_t mostPairs = 4;
constexpr int trials = 100;

/// A pair can imitate another cause with two amplitudes. Therefore it is named only if it fits as well as its own
/// synthetic data, within this number of standard deviations, and if all other causes have at most this probability.
constexpr double fitsWell = 1.0;
constexpr double largestRest = 0.01;

/// Whether an effect sets an entry to a value that does not depend on the entry's previous value.
bool replaces(const Effect& effect, const std::string& entry)
{
    const auto formula = effect.entries.find(entry);
    return effect.textEntries.count(entry) > 0 || (formula != effect.entries.end() && !formula->second.holds(entry));
}

bool mayGoTogether(const Study& study, const Evidence& evidence, std::size_t one, std::size_t other)
{
    return !shareName(study, one, other) && !undoEachOther(study.effects[one], study.effects[other])
           && !evidence.amplitudes(one).empty() && !evidence.amplitudes(other).empty();
}

std::vector<Evidence::Explanation> explanationsOf(const Evidence& evidence, const std::vector<PairFinding>& pairs)
{
    return mapped(pairs, [&](const PairFinding& pair) { return evidence.explanationOf(pair.effects); });
}

/// Whether the effects of two pairs are equal or variants of each other.
bool shareName(const Study& study, const PairFinding& one, const PairFinding& other)
{
    const auto match = [&](std::size_t first, std::size_t second) {
        return shareName(study, one.effects.front(), first) && shareName(study, one.effects.back(), second);
    };
    return match(other.effects.front(), other.effects.back()) || match(other.effects.back(), other.effects.front());
}

} // namespace

std::string sharedName(const Study& study, const std::vector<PairFinding>& pairs)
{
    const auto names = mapped(pairs.front().effects, [&](std::size_t e) {
        const bool isShared = std::all_of(pairs.begin(), pairs.end(),
            [&](const PairFinding& pair) { return !pair.inSet || contains(pair.effects, e); });
        return isShared ? study.effects[e].name : study.effects[e].family;
    });
    return listed(names, " with ");
}

bool mayBeNamed(const Study& study, const std::vector<PairFinding>& pairs)
{
    double together = 0.0;
    for (const auto& pair : pairs)
    {
        const bool isVariant = shareName(study, pairs.front(), pair);
        if (pair.inSet && !isVariant)
        {
            return false;
        }
        together += isVariant ? pair.probability : 0.0;
    }
    return !pairs.empty() && pairs.front().fitsWell && together >= 1.0 - largestRest;
}

bool undoEachOther(const Effect& one, const Effect& other)
{
    const auto clash = [&](const auto& set) {
        return (one.textEntries.count(set.first) > 0 || one.entries.count(set.first) > 0)
               && (replaces(one, set.first) || replaces(other, set.first));
    };
    return std::any_of(other.textEntries.begin(), other.textEntries.end(), clash)
           || std::any_of(other.entries.begin(), other.entries.end(), clash);
}

std::vector<PairFinding> leadingPairs(const Study& study, Evidence& evidence, const Measured& measured)
{
    std::vector<PairFinding> pairs;
    double weights = 0.0;
    for (std::size_t other = 0; other < study.effects.size(); ++other)
    {
        for (std::size_t one = 0; one < other; ++one)
        {
            if (mayGoTogether(study, evidence, one, other))
            {
                pairs.push_back({{one, other}, {}, logPrior(study, one) + logPrior(study, other)});
                weights += std::exp(pairs.back().logPrior);
            }
        }
    }
    const double null = evidence.compare({}, measured).null;
    const auto judge = [&] {
        for (auto& pair : pairs)
        {
            pair.logOdds =
                evidence.judge(evidence.explanationOf(pair.effects), measured).logEvidence - null + pair.logPrior;
        }
        std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.logOdds > b.logOdds; });
    };
    for (auto& pair : pairs)
    {
        pair.logPrior -= std::log(weights);
    }
    judge();
    pairs.resize(std::min(pairs.size(), mostPairs));
    for (const auto& pair : pairs)
    {
        evidence.refine(pair.effects, measured);
    }
    judge();
    const double least = pairs.empty() ? 0.0 : pairs.front().logOdds - negligibleLogOdds;
    eraseIf(pairs, [&](const PairFinding& pair) { return !(pair.logOdds >= least); });
    for (auto& pair : pairs)
    {
        pair.fits = evidence.fits(evidence.explanationOf(pair.effects), measured);
    }
    return pairs;
}

double judgePairs(std::vector<PairFinding>& pairs, const Study& study, const Evidence& evidence, Replicas& replicas,
    const Measured& measured, std::mt19937_64& random)
{
    const Eigen::VectorXd logPriors =
        Eigen::VectorXd::NullaryExpr(pairs.size(), [&](Eigen::Index i) { return pairs[i].logPrior; });
    const Odds odds = oddsOf(evidence.compare(explanationsOf(evidence, pairs), measured), logPriors);
    Calibration limits;
    limits.leastGain = leastGain(study);
    limits.membership = limits.chiSquares = limits.scatterChiSquares = logPriors; // to be set
    std::map<const Evidence*, std::vector<Evidence::Explanation>> explanations;   // by judge
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
        PairFinding& pair = pairs[i];
        std::vector<Odds> draws;
        for (int trial = 0; trial < trials; ++trial)
        {
            const Eigen::VectorXd parameters = around(pair.fits.front(), random);
            const auto [data, judge] =
                replicas.draw(drawnAmplitudes(study, pair.effects, pair.fits, random), parameters, random);
            auto& ofJudge = explanations[&judge];
            if (ofJudge.empty())
            {
                ofJudge = explanationsOf(judge, pairs);
            }
            draws.push_back(oddsOf(judge.compare(ofJudge, data), logPriors));
        }
        setLimits(limits, i, draws, study, evidence);
        pair.probability = std::exp(odds.effects(i));
        pair.inSet = isMember(limits, odds, i);
        pair.fitsWell = pair.inSet && odds.chiSquares(i) <= largestChiSquare(evidence, draws, i, fitsWell);
    }
    return std::exp(odds.other);
}

} // namespace clepsydra::identification
