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
constexpr int wantedDraws = 100;
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

} // namespace

double logPrior(const Study& study, std::size_t e)
{
    const Effect& effect = study.effects[e];
    const auto variants = effect.family.empty() ? 1
                                                : std::count_if(study.effects.begin(), study.effects.end(),
                                                    [&](const Effect& other) { return other.family == effect.family; });
    return std::log(effect.prior / static_cast<double>(variants));
}

Eigen::VectorXd around(const Fit& fit, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    if (fit.parameters.size() == 0)
    {
        return fit.parameters;
    }
    const Eigen::VectorXd z = Eigen::VectorXd::NullaryExpr(fit.parameters.size(), [&] { return normal(random); });
    return fit.parameters + fit.covariance.llt().matrixL() * z;
}

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

double chiSquareLimit(const std::vector<double>& draws, double sds)
{
    const Eigen::ArrayXd roots = Eigen::Map<const Eigen::ArrayXd>(draws.data(), draws.size()).max(0.0).pow(1.0 / 3.0);
    const double sd = std::sqrt((roots - roots.mean()).square().mean());
    return std::pow(roots.mean() + sds * sd, 3);
}

double drawnAmplitude(const Effect& effect, const Normal& distribution, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    return effect.isSwitch ? 1.0
                           : std::clamp(distribution.mean + distribution.sd * normal(random), effect.bounds.lower,
                               effect.bounds.upper);
}

Odds oddsOf(const Study& study, const Evidences& evidences, std::size_t without)
{
    const Eigen::Index count = evidences.effects.size();
    Eigen::VectorXd all(count + 1);
    Eigen::VectorXd peaks(count + 1);
    for (Eigen::Index e = 0; e < count; ++e)
    {
        // The variants of the left-out effect are left out too, because they share its name.
        const std::size_t effect = e;
        const double weight = effect == without || areVariants(study, effect, without)
                                  ? -std::numeric_limits<double>::infinity()
                                  : logPrior(study, effect);
        all(e) = evidences.effects(e) + weight;
        peaks(e) = evidences.peaks(e) + weight;
    }
    all(count) = peaks(count) = evidences.other;
    const double sum = logSumExp(all);
    return {sum - evidences.null, logSumExp(peaks) - evidences.null, (all.head(count).array() - sum).matrix(),
        all(count) - sum, evidences.chiSquares, evidences.scatterChiSquares, evidences.chanceOfChiSquare,
        evidences.peaks.array() - evidences.null};
}

bool areVariants(const Study& study, std::size_t one, std::size_t other)
{
    return one < study.effects.size() && other < study.effects.size() && !study.effects[one].family.empty()
           && study.effects[one].family == study.effects[other].family;
}

double marginOf(const Study& study, const Odds& odds, std::size_t effect)
{
    double inVariants = 0.0;
    double outside = std::exp(odds.other);
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        const double probability = std::exp(odds.effects(e));
        (e == effect || areVariants(study, effect, e) ? inVariants : outside) += probability;
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

std::vector<std::size_t> membersOf(const Calibration& calibration, const Odds& odds)
{
    auto members = numbersWhere(static_cast<std::size_t>(odds.effects.size()), [&](std::size_t e) {
        return odds.effects(e) >= calibration.membership(e) && exclusionOf(calibration, odds, e).empty();
    });
    std::sort(members.begin(), members.end(),
        [&](std::size_t a, std::size_t b) { return odds.effects(a) > odds.effects(b); });
    return members;
}

std::optional<std::size_t> soleMember(const Study& study, const Calibration& calibration, const Odds& odds)
{
    const auto members = membersOf(calibration, odds);
    const bool one = !members.empty() && std::all_of(members.begin(), members.end(), [&](std::size_t other) {
        return other == members.front() || areVariants(study, members.front(), other);
    });
    if (!one || odds.other >= calibration.otherMembership)
    {
        return std::nullopt;
    }
    // The variants together must be more probable than any other effect.
    double inVariants = 0.0;
    double best = 0.0;
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        const double probability = std::exp(odds.effects(e));
        if (e == members.front() || areVariants(study, members.front(), e))
        {
            inVariants += probability;
        }
        else
        {
            best = std::max(best, probability);
        }
    }
    constexpr double rounding = 1e-9;
    return best <= inVariants + rounding ? std::optional(members.front()) : std::nullopt;
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

Calibrator::Calibrator(
    const Study& study, const Evidence& evidence, Replicas& replicas, const Measured& measured, std::mt19937_64& random)
    : study_(study),
      evidence_(evidence),
      replicas_(replicas),
      measured_(measured),
      random_(random)
{}

Calibration Calibrator::calibrate()
{
    calibration_.leastGain = leastGain(study_);
    drawNull();
    drawEffects();
    drawOther();
    setMembership();
    setNaming();
    return std::move(calibration_);
}

void Calibrator::drawNull()
{
    // The parameters are drawn from their priors: data that move them far from there are a residual too (Box, J. R.
    // Stat. Soc. A 143, 383 (1980)).
    Fit prior;
    const Eigen::Index parameters = study_.parameters.size();
    prior.parameters = Eigen::VectorXd::Zero(parameters);
    prior.covariance = Eigen::MatrixXd::Identity(parameters, parameters);
    auto& all = calibration_.nullStatistics;
    for (int i = 0; i < study_.settings.draws; ++i)
    {
        const auto [data, judge] = replicas_.draw({}, around(prior, random_), random_);
        all.push_back(oddsOf(study_, judge(data)).statistic);
    }
    std::sort(all.begin(), all.end());
    const auto index = static_cast<std::size_t>((1.0 - study_.settings.level) * static_cast<double>(all.size()));
    calibration_.critical = all[std::min(index, all.size() - 1)];
}

void Calibrator::drawEffects()
{
    calibration_.widths = Eigen::VectorXd::Ones(study_.effects.size());
    for (std::size_t e = 0; e < study_.effects.size(); ++e)
    {
        std::vector<double> amplitudes = evidence_.amplitudes(e);
        amplitudes.erase(std::remove(amplitudes.begin(), amplitudes.end(), 0.0), amplitudes.end());
        if (amplitudes.empty())
        {
            continue;
        }
        const Fit fit = evidence_.fit(e, measured_);
        std::vector<double> widths;
        int found = 0;
        for (int i = 0; i < mostDraws && found < wantedDraws; ++i)
        {
            const double amplitude = study_.effects[e].measured
                                         ? drawnAmplitude(study_.effects[e], *study_.effects[e].measured, random_)
                                         : amplitudes[static_cast<std::size_t>(i) % amplitudes.size()];
            const auto [data, judge] = replicas_.draw({{e, amplitude}}, around(fit, random_), random_);
            const Evidences evidences = judge(data);
            const Odds odds = oddsOf(study_, evidences);
            if (isDetected(study_, calibration_, odds))
            {
                detected_.push_back({e, odds, oddsOf(study_, evidences, e)});
                widths.push_back(widthNeeded(judge.fit(e, data), amplitude));
                ++found;
            }
        }
        calibration_.widths(e) = std::max(1.0, upperQuantile(widths, coverageOfIntervals));
    }
}

void Calibrator::drawOther()
{
    const Fit fit = evidence_.fitNull(measured_);
    for (int i = 0; i < mostDraws; ++i)
    {
        const auto& sizes = Evidence::sizes();
        const double size = sizes[static_cast<std::size_t>(i) % sizes.size()];
        const auto [data, judge] = replicas_.drawOther(size, around(fit, random_), random_);
        const Odds odds = oddsOf(study_, judge(data));
        if (isDetected(study_, calibration_, odds))
        {
            detected_.push_back({study_.effects.size(), odds, odds});
        }
    }
}

/// Sets with the smallest mean size at a given coverage of each class: Sadinle, Lei & Wasserman, J. Am. Stat. Assoc.
/// 114, 223 (2019).
void Calibrator::setMembership()
{
    const auto ofTruth = [&](std::size_t truth, auto valueOf) {
        std::vector<double> own;
        for (const auto& draw : detected_)
        {
            if (draw.truth == truth)
            {
                own.push_back(valueOf(draw.odds));
            }
        }
        return own;
    };
    const auto quantileOf = [&](std::size_t truth) {
        auto own = ofTruth(
            truth, [&](const Odds& odds) { return truth < study_.effects.size() ? odds.effects(truth) : odds.other; });
        std::sort(own.begin(), own.end());
        // The observed data count as one more draw.
        const double place = (1.0 - study_.settings.coverage) * (static_cast<double>(own.size()) + 1.0);
        // Draws from the posterior are known slightly better than the real system. Therefore an effect with a
        // probability of at least 1 - coverage always belongs to the set.
        const double notUnlikely = std::log(1.0 - study_.settings.coverage);
        const double usual = place < 1.0 ? notUnlikely : own[static_cast<std::size_t>(place) - 1];
        return std::clamp(usual, -negligibleLogOdds, notUnlikely);
    };
    calibration_.membership.resize(study_.effects.size());
    for (std::size_t e = 0; e < study_.effects.size(); ++e)
    {
        calibration_.membership(e) = quantileOf(e);
    }
    calibration_.otherMembership = quantileOf(study_.effects.size());
    const auto limitsOf = [&](const Eigen::VectorXd Odds::*chiSquares, double sds) {
        Eigen::VectorXd limits(calibration_.membership.size());
        for (Eigen::Index e = 0; e < limits.size(); ++e)
        {
            const auto own = ofTruth(e, [&](const Odds& odds) { return (odds.*chiSquares)(e); });
            limits(e) = own.empty() ? std::numeric_limits<double>::infinity() : chiSquareLimit(own, sds);
        }
        return limits;
    };
    calibration_.chiSquares =
        limitsOf(&Odds::chiSquares, meansStillFit).cwiseMin(evidence_.largestChiSquare(meansStillFit));
    calibration_.scatterChiSquares = limitsOf(&Odds::scatterChiSquares, scatterStillFits);
}

/// What the draws say of names: the effects that would be named if the thresholds allowed it.
std::vector<Calibrator::Candidate> Calibrator::candidatesOf(const std::vector<Draw>& draws) const
{
    const std::size_t count = study_.effects.size();
    std::vector<double> numbers(count + 1, 0.0);
    for (const auto& draw : draws)
    {
        numbers[draw.truth] += 1.0;
    }
    const auto classes =
        static_cast<double>(std::count_if(numbers.begin(), numbers.end(), [](double number) { return number > 0.0; }));
    std::vector<Candidate> candidates;
    for (const auto& draw : draws)
    {
        const double weight = 1.0 / (numbers[draw.truth] * classes);
        const auto add = [&](const Odds& odds, bool isDecoy) {
            if (const auto sole = soleMember(study_, calibration_, odds))
            {
                const bool isRight = !isDecoy && (*sole == draw.truth || areVariants(study_, *sole, draw.truth));
                candidates.push_back(
                    {*sole, marginOf(study_, odds, *sole), isRight ? weight : 0.0, isRight ? 0.0 : weight});
            }
        };
        if (draw.truth < count)
        {
            add(draw.odds, false);
        }
        add(draw.without, true);
    }
    return candidates;
}

/// The naming thresholds that give the most right names among the library's own draws at the allowed share of wrong
/// names among the detected decoys. Each effect has its own threshold; the price of a wrong name is the same for all.
Eigen::VectorXd Calibrator::chosenNaming(std::vector<Candidate> candidates) const
{
    std::sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) { return a.margin > b.margin; });
    // For each effect the threshold that maximises right names minus price times wrong names.
    const auto thresholdsAt = [&](double price) {
        Eigen::VectorXd thresholds =
            Eigen::VectorXd::Constant(study_.effects.size(), std::numeric_limits<double>::infinity());
        Eigen::VectorXd gains = Eigen::VectorXd::Zero(thresholds.size());
        Eigen::VectorXd best = gains;
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
    while (wrongNamesAt(thresholds, candidates) > study_.settings.wrongNames && price < largestPrice)
    {
        price *= priceStep;
        thresholds = thresholdsAt(price);
    }
    return thresholds;
}

double Calibrator::wrongNamesAt(const Eigen::VectorXd& thresholds, const std::vector<Candidate>& candidates)
{
    return std::accumulate(candidates.begin(), candidates.end(), 0.0, [&](double sum, const Candidate& one) {
        return sum + (one.margin >= thresholds(one.effect) ? one.wrong : 0.0);
    });
}

void Calibrator::setNaming()
{
    calibration_.naming = chosenNaming(candidatesOf(detected_));
    // Thresholds look better on the draws that they were chosen from. Each half is therefore judged by thresholds from
    // the other; draws of one effect follow each other.
    std::array<std::vector<Draw>, 2> halves;
    for (std::size_t i = 0; i < detected_.size(); ++i)
    {
        halves[i % 2].push_back(detected_[i]);
    }
    const auto first = candidatesOf(halves[0]);
    const auto second = candidatesOf(halves[1]);
    calibration_.wrongNames =
        0.5 * (wrongNamesAt(chosenNaming(first), second) + wrongNamesAt(chosenNaming(second), first));
}

} // namespace clepsydra::identification
