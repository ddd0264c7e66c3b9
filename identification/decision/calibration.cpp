#include "decision/calibration.h"

#include "emulator/distributions.h"
#include "lists.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace clepsydra::identification
{

namespace
{

/// Number of detected draws per effect that is aimed at, and largest number of draws made to obtain them.
constexpr std::size_t wantedDraws = 100;
constexpr int mostDraws = 200;

constexpr double coverageOfIntervals = 0.95;

/// Range of the price of a wrong name, in right names.
constexpr double smallestPrice = 0.1;
constexpr double largestPrice = 1e4;
constexpr double priceStep = 1.3;

/// Factor by which an interval must be widened to contain an amplitude.
double widthNeeded(const Fit& fit, double amplitude)
{
    const double distance = amplitude - fit.amplitude;
    const double own = distance < 0.0 ? fit.amplitude - fit.lower : fit.upper - fit.amplitude;
    return std::abs(distance) / std::max(own, 1e-12);
}

/// The quantile of draws; the observed data count as one more draw.
double upperQuantile(std::vector<double> values, double share)
{
    if (values.empty())
    {
        return 1.0;
    }
    std::sort(values.begin(), values.end());
    const auto place = static_cast<std::size_t>(std::ceil(share * (static_cast<double>(values.size()) + 1.0)));
    return values[std::min(place, values.size()) - 1];
}

/// The log probability that the share `coverage` of draws of an explanation reaches; the observed data count as one more
/// draw. Draws from the posterior are known slightly better than the real system. Therefore an explanation with a
/// probability of at least 1 - coverage always belongs to the set.
double membershipOf(std::vector<double> logProbabilities, double coverage)
{
    std::sort(logProbabilities.begin(), logProbabilities.end());
    const double place = (1.0 - coverage) * (static_cast<double>(logProbabilities.size()) + 1.0);
    const double notUnlikely = std::log(1.0 - coverage);
    return place < 1.0 ? notUnlikely : std::min(notUnlikely, logProbabilities[static_cast<std::size_t>(place) - 1]);
}

/// Upper limit of a chi-square, a number of standard deviations above the mean. Both are taken of the cube roots of the
/// draws, which are nearly normal (Wilson & Hilferty, PNAS 17, 684 (1931)). Infinite if there are no draws.
double chiSquareLimit(
    const std::vector<Odds>& draws, Eigen::VectorXd Odds::*chiSquares, std::size_t explanation, double sds)
{
    if (draws.empty())
    {
        return std::numeric_limits<double>::infinity();
    }
    const Eigen::ArrayXd all =
        Eigen::ArrayXd::NullaryExpr(draws.size(), [&](Eigen::Index i) { return (draws[i].*chiSquares)(explanation); });
    const Eigen::ArrayXd roots = all.max(0.0).pow(1.0 / 3.0);
    const double sd = std::sqrt((roots - roots.mean()).square().mean());
    return std::pow(roots.mean() + sds * sd, 3);
}

} // namespace

double logPrior(const Study& study, std::size_t e)
{
    const auto variants =
        numbersWhere(study.effects.size(), [&](std::size_t other) { return shareName(study, e, other); });
    return std::log(study.effects[e].prior / static_cast<double>(variants.size()));
}

Eigen::VectorXd around(const Fit& fit, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    const Eigen::VectorXd z = Eigen::VectorXd::NullaryExpr(fit.parameters.size(), [&] { return normal(random); });
    return fit.parameters + fit.covariance.llt().matrixL() * z;
}

Eigen::VectorXd fromPrior(const Study& study, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    return Eigen::VectorXd::NullaryExpr(study.parameters.size(), [&] { return normal(random); });
}

double drawnAmplitude(const Effect& effect, const Normal& distribution, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    return effect.isSwitch ? 1.0
                           : std::clamp(distribution.mean + distribution.sd * normal(random), effect.bounds.lower,
                               effect.bounds.upper);
}

std::vector<Present> drawnAmplitudes(
    const Study& study, const std::vector<std::size_t>& effects, const std::vector<Fit>& fits, std::mt19937_64& random)
{
    std::vector<Present> present;
    for (std::size_t k = 0; k < effects.size(); ++k)
    {
        const Normal fitted{fits[k].amplitude, fits[k].sd};
        present.push_back({effects[k], drawnAmplitude(study.effects[effects[k]], fitted, random)});
    }
    return present;
}

double largestChiSquare(const Evidence& evidence, const std::vector<Odds>& draws, std::size_t explanation, double sds)
{
    return std::min(chiSquareLimit(draws, &Odds::chiSquares, explanation, sds), evidence.largestChiSquare(sds));
}

void setLimits(Calibration& calibration, std::size_t explanation, const std::vector<Odds>& draws, const Study& study,
    const Evidence& evidence)
{
    calibration.membership(explanation) = membershipOf(
        mapped(draws, [&](const Odds& odds) { return odds.effects(explanation); }), study.settings.coverage);
    calibration.chiSquares(explanation) = largestChiSquare(evidence, draws, explanation, meansStillFit);
    calibration.scatterChiSquares(explanation) =
        chiSquareLimit(draws, &Odds::scatterChiSquares, explanation, scatterStillFits);
}

Odds oddsOf(const Study& study, const Evidences& evidences, std::size_t without)
{
    // The variants of the left-out effect are left out too, because they share its name.
    return oddsOf(evidences, Eigen::VectorXd::NullaryExpr(evidences.effects.size(), [&](Eigen::Index e) {
        return shareName(study, e, without) ? -std::numeric_limits<double>::infinity() : logPrior(study, e);
    }));
}

Odds oddsOf(const Evidences& evidences, const Eigen::VectorXd& logPriors)
{
    const Eigen::Index count = logPriors.size();
    Eigen::VectorXd all(count + 1);
    Eigen::VectorXd peaks(count + 1);
    all << evidences.effects + logPriors, evidences.other;
    peaks << evidences.peaks + logPriors, evidences.other;
    const double sum = logSumExp(all);
    return {sum - evidences.null, logSumExp(peaks) - evidences.null, (all.head(count).array() - sum).matrix(),
        all(count) - sum, evidences.chiSquares, evidences.scatterChiSquares, evidences.chanceOfChiSquare,
        evidences.peaks.array() - evidences.null};
}

bool shareName(const Study& study, std::size_t one, std::size_t other)
{
    return one == other
           || (one < study.effects.size() && other < study.effects.size() && !study.effects[one].family.empty()
               && study.effects[one].family == study.effects[other].family);
}

double marginOf(const Study& study, const Odds& odds, std::size_t effect)
{
    double inVariants = 0.0;
    double outside = std::exp(odds.other);
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        const double probability = std::exp(odds.effects(e));
        (shareName(study, effect, e) ? inVariants : outside) += probability;
    }
    constexpr double least = std::numeric_limits<double>::min();
    return std::log(std::max(inVariants, least)) - std::log(std::max(outside, least));
}

double leastGain(const Study& study)
{
    const double sds = normalQuantile(1.0 - study.settings.level / 2.0);
    return 0.5 * sds * sds;
}

std::string exclusionOf(const Calibration& calibration, const Odds& odds, std::size_t effect)
{
    return !std::isfinite(odds.effects(effect))         ? "its runs have failed"
           : odds.gains(effect) < calibration.leastGain ? "it fits no better than no effect"
           : odds.chiSquares(effect) > calibration.chiSquares(effect)
               ? "it does not fit: its chi-square is " + textOf(std::round(odds.chiSquares(effect)))
                     + ", and where it is the cause " + "it is below "
                     + textOf(std::ceil(calibration.chiSquares(effect)))
           : odds.scatterChiSquares(effect) > calibration.scatterChiSquares(effect)
               ? "the scatter of the repeats is not the one that it causes"
               : "";
}

bool isMember(const Calibration& calibration, const Odds& odds, std::size_t explanation)
{
    return odds.effects(explanation) >= calibration.membership(explanation)
           && exclusionOf(calibration, odds, explanation).empty();
}

std::vector<std::size_t> membersOf(const Calibration& calibration, const Odds& odds)
{
    auto members = numbersWhere(
        static_cast<std::size_t>(odds.effects.size()), [&](std::size_t e) { return isMember(calibration, odds, e); });
    std::sort(members.begin(), members.end(),
        [&](std::size_t a, std::size_t b) { return odds.effects(a) > odds.effects(b); });
    return members;
}

std::optional<std::size_t> soleMember(const Study& study, const Calibration& calibration, const Odds& odds)
{
    const auto members = membersOf(calibration, odds);
    if (members.empty() || odds.other >= calibration.otherMembership)
    {
        return std::nullopt;
    }
    // The variants together must be more probable than any other effect.
    const std::size_t first = members.front();
    double inVariants = 0.0;
    double best = 0.0;
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        const double probability = std::exp(odds.effects(e));
        const bool isVariant = shareName(study, first, e);
        inVariants += isVariant ? probability : 0.0;
        best = std::max(best, isVariant ? 0.0 : probability);
    }
    constexpr double rounding = 1e-9;
    const bool isSole =
        std::all_of(members.begin(), members.end(), [&](std::size_t other) { return shareName(study, first, other); });
    return isSole && best <= inVariants + rounding ? std::optional(first) : std::nullopt;
}

double Calibration::pValue(const Odds& odds) const
{
    const auto above =
        nullStatistics.end() - std::lower_bound(nullStatistics.begin(), nullStatistics.end(), odds.statistic);
    const double ofStatistic = (1.0 + static_cast<double>(above)) / (1.0 + static_cast<double>(nullStatistics.size()));
    // Without scatter there is a second test, on the chi-square of the null fit. Draws far from all runs are as unusual
    // as any data, but the runs at the null fit are exact. The factor 2 corrects for two tests (Bonferroni).
    const double p = odds.chanceOfChiSquare ? 2.0 * std::min(ofStatistic, *odds.chanceOfChiSquare) : ofStatistic;
    return std::clamp(p, leastPValue, 1.0);
}

bool isDetected(const Study& study, const Calibration& calibration, const Odds& odds)
{
    return calibration.pValue(odds) < study.settings.level;
}

Fit Calibration::widened(std::size_t effect, Fit fit, const Bounds& bounds) const
{
    const double factor = widths(effect);
    fit.sd *= factor;
    fit.lower = std::max(bounds.lower, fit.amplitude - factor * (fit.amplitude - fit.lower));
    fit.upper = std::min(bounds.upper, fit.amplitude + factor * (fit.upper - fit.amplitude));
    return fit;
}

namespace
{

struct Calibrator
{
    struct Draw
    {
        std::size_t truth; // effect; the number of effects stands for an unlisted cause
        Odds odds;
        Odds without; // odds when the truth is left out of the library
    };

    const Study& study;
    const Evidence& evidence;
    Replicas& replicas;
    const Measured& measured;
    std::mt19937_64& random;
    const std::size_t effects = study.effects.size();
    std::vector<Draw> detected = {};
    Calibration calibration = {};

    Calibration run()
    {
        calibration.leastGain = leastGain(study);
        drawNull();
        drawEffects();
        drawOther();
        setMembership();
        setNaming();
        return calibration;
    }

    void drawNull()
    {
        auto& all = calibration.nullStatistics;
        for (int i = 0; i < study.settings.draws; ++i)
        {
            const auto [data, judge] = replicas.draw({}, fromPrior(study, random), random);
            all.push_back(oddsOf(study, judge(data)).statistic);
        }
        std::sort(all.begin(), all.end());
        const auto index = static_cast<std::size_t>((1.0 - study.settings.level) * static_cast<double>(all.size()));
        calibration.critical = all[std::min(index, all.size() - 1)];
    }

    void drawEffects()
    {
        calibration.widths = Eigen::VectorXd::Ones(effects);
        for (std::size_t e = 0; e < effects; ++e)
        {
            std::vector<double> amplitudes = evidence.amplitudes(e);
            eraseIf(amplitudes, [](double amplitude) { return amplitude == 0.0; });
            if (amplitudes.empty())
            {
                continue;
            }
            const Effect& effect = study.effects[e];
            const Fit fit = evidence.fit(e, measured);
            std::vector<double> widths; // of the detected draws
            for (int i = 0; i < mostDraws && widths.size() < wantedDraws; ++i)
            {
                const double amplitude = effect.measured ? drawnAmplitude(effect, *effect.measured, random)
                                                         : amplitudes[static_cast<std::size_t>(i) % amplitudes.size()];
                const auto [data, judge] = replicas.draw({{e, amplitude}}, around(fit, random), random);
                const Evidences evidences = judge(data);
                const Odds odds = oddsOf(study, evidences);
                if (isDetected(study, calibration, odds))
                {
                    detected.push_back({e, odds, oddsOf(study, evidences, e)});
                    widths.push_back(widthNeeded(judge.fit(e, data), amplitude));
                }
            }
            calibration.widths(e) = std::max(1.0, upperQuantile(widths, coverageOfIntervals));
        }
    }

    void drawOther()
    {
        const Fit fit = evidence.fitNull(measured);
        for (int i = 0; i < mostDraws; ++i)
        {
            const double size = Evidence::sizes[static_cast<std::size_t>(i) % Evidence::sizes.size()];
            const auto [data, judge] = replicas.drawOther(size, around(fit, random), random);
            const Odds odds = oddsOf(study, judge(data));
            if (isDetected(study, calibration, odds))
            {
                detected.push_back({effects, odds, odds});
            }
        }
    }

    /// Sets with the smallest mean size at a given coverage of each class: Sadinle, Lei & Wasserman, J. Am. Stat. Assoc.
    /// 114, 223 (2019).
    void setMembership()
    {
        std::vector<std::vector<Odds>> byTruth(effects + 1);
        for (const auto& draw : detected)
        {
            byTruth[draw.truth].push_back(draw.odds);
        }
        calibration.membership = calibration.chiSquares = calibration.scatterChiSquares = calibration.widths;
        for (std::size_t e = 0; e < effects; ++e)
        {
            setLimits(calibration, e, byTruth[e], study, evidence);
        }
        calibration.membership = calibration.membership.cwiseMax(-negligibleLogOdds);
        const auto ofOther = mapped(byTruth.back(), [](const Odds& odds) { return odds.other; });
        calibration.otherMembership = std::max(-negligibleLogOdds, membershipOf(ofOther, study.settings.coverage));
    }

    void setNaming()
    {
        calibration.naming = chosenNaming(candidatesOf(detected));
        // Thresholds look better on the draws that they were chosen from. Each half is therefore judged by thresholds
        // from the other; draws of one effect follow each other.
        std::array<std::vector<Draw>, 2> halves;
        for (std::size_t i = 0; i < detected.size(); ++i)
        {
            halves[i % 2].push_back(detected[i]);
        }
        const auto first = candidatesOf(halves[0]);
        const auto second = candidatesOf(halves[1]);
        calibration.wrongNames =
            0.5 * (wrongNamesAt(chosenNaming(first), second) + wrongNamesAt(chosenNaming(second), first));
    }

    /// A draw in whose set one effect is alone.
    struct Candidate
    {
        std::size_t effect;
        double margin; // as in marginOf
        double right;  // weight of the draw if the name is right
        double wrong;  // and if it is wrong
    };

    /// What the draws say of names: the effects that would be named if the thresholds allowed it.
    std::vector<Candidate> candidatesOf(const std::vector<Draw>& draws) const
    {
        Eigen::ArrayXd numbers = Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(effects) + 1);
        for (const auto& draw : draws)
        {
            numbers(draw.truth) += 1.0;
        }
        const auto classes = static_cast<double>((numbers > 0.0).count());
        std::vector<Candidate> candidates;
        for (const auto& draw : draws)
        {
            const double weight = 1.0 / (numbers(draw.truth) * classes);
            const auto add = [&](const Odds& odds, bool isDecoy) {
                if (const auto sole = soleMember(study, calibration, odds))
                {
                    const bool isRight = !isDecoy && shareName(study, *sole, draw.truth);
                    candidates.push_back(
                        {*sole, marginOf(study, odds, *sole), isRight ? weight : 0.0, isRight ? 0.0 : weight});
                }
            };
            if (draw.truth < effects)
            {
                add(draw.odds, false);
            }
            add(draw.without, true);
        }
        return candidates;
    }

    /// The naming thresholds that give the most right names among the library's own draws at the allowed share of wrong
    /// names among the detected decoys. Each effect has its own threshold; the price of a wrong name is the same for
    /// all.
    Eigen::VectorXd chosenNaming(std::vector<Candidate> candidates) const
    {
        std::sort(
            candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.margin > b.margin; });
        // For each effect the threshold that maximises right names minus price times wrong names.
        const auto thresholdsAt = [&](double price) {
            Eigen::VectorXd gains = Eigen::VectorXd::Zero(effects);
            Eigen::VectorXd best = gains;
            Eigen::VectorXd thresholds = gains.array() + std::numeric_limits<double>::infinity();
            for (const auto& one : candidates)
            {
                gains(one.effect) += one.right - price * one.wrong;
                if (gains(one.effect) >= best(one.effect))
                {
                    best(one.effect) = gains(one.effect);
                    thresholds(one.effect) = one.margin;
                }
            }
            return thresholds;
        };
        double price = smallestPrice;
        Eigen::VectorXd thresholds = thresholdsAt(price);
        while (wrongNamesAt(thresholds, candidates) > study.settings.wrongNames && price < largestPrice)
        {
            price *= priceStep;
            thresholds = thresholdsAt(price);
        }
        return thresholds;
    }

    static double wrongNamesAt(const Eigen::VectorXd& thresholds, const std::vector<Candidate>& candidates)
    {
        return std::accumulate(candidates.begin(), candidates.end(), 0.0, [&](double sum, const Candidate& one) {
            return sum + (one.margin >= thresholds(one.effect) ? one.wrong : 0.0);
        });
    }
};

} // namespace

Calibration calibrate(
    const Study& study, const Evidence& evidence, Replicas& replicas, const Measured& measured, std::mt19937_64& random)
{
    return Calibrator{study, evidence, replicas, measured, random}.run();
}

} // namespace clepsydra::identification
