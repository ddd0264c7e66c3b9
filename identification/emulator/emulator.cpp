#include "emulator/emulator.h"

#include "emulator/covariance.h"
#include "emulator/settings.h"

#include "lists.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/tools/minima.hpp>

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

/// A feature is left out where more than this share of the runs lacks it; else the runs that lack it are.
constexpr double mostGaps = 0.2;

/// Without scatter a run is as good as exact: noise of this share of what a feature varies over the runs.
constexpr double exactShare = 1e-3;

/// Repeats of an effect that is not declared to raise the scatter do so all the same where chance alone would in fewer
/// cases than this.
constexpr double otherScatter = 1e-2;

/// The variance, between conditions, of the log of a feature's scatter is at least this: 10 %.
constexpr double leastBetween = 0.01;

/// Scatter of an effect in one condition counts against that of all conditions as much as this many degrees of freedom.
constexpr double sharedScatter = 8.0;

/// Large effects bend, and go on to act otherwise beside others, in proportion to their size (heredity: Chipman, Can. J.
/// Stat. 24, 17 (1996)). Priors of one scale for all effects would call both impossible. Sd of the squared term, and of what an
/// effect does in the design's runs beyond what it does alone, as shares of its main effect.
constexpr double mainShare = 3.0;
constexpr double curvatureShare = 0.4;
constexpr double curvatureOfCorrections = 0.05;
constexpr double designShare = 0.1;

/// Where runs do not scatter they show what is no polynomial of second order.
constexpr Eigen::Index waves = 128;

/// The largest scale of a prior, in units of one run's noise, and the smallest.
constexpr double largestScale = 1e5;
constexpr double smallestScale = 1e-2;

bool sameSetting(const Setting& a, const Setting& b)
{
    return a.parameters == b.parameters && a.amplitudes == b.amplitudes;
}

/// Repeats of one setting, as lists of row numbers.
std::vector<std::vector<Eigen::Index>> repeatsOf(const std::vector<Setting>& settings)
{
    std::vector<std::vector<Eigen::Index>> groups;
    for (std::size_t i = 0; i < settings.size(); ++i)
    {
        const auto group = std::find_if(groups.begin(), groups.end(),
            [&](const auto& one) { return sameSetting(settings[one.front()], settings[i]); });
        if (group == groups.end())
        {
            groups.push_back({static_cast<Eigen::Index>(i)});
        }
        else
        {
            group->push_back(i);
        }
    }
    return groups;
}

/// The log of a mean square is too small by this on average.
double biasOfLog(double degreesOfFreedom)
{
    return boost::math::digamma(degreesOfFreedom / 2.0) - std::log(degreesOfFreedom / 2.0);
}

Eigen::VectorXd priorSds(const Basis& basis, const std::array<double, Basis::kinds>& scales)
{
    return Eigen::VectorXd::NullaryExpr(basis.size(), [&](Eigen::Index term) { return scales[basis.kind(term)]; });
}

/// Effects of a run that raise its scatter.
std::vector<Present> scatteringOf(const ConditionEmulator& emulator, const Setting& setting)
{
    std::vector<Present> scattering;
    for (const auto& [e, logs] : emulator.logScatter)
    {
        if (setting.amplitudes(e) != 0.0)
        {
            scattering.push_back({e, setting.amplitudes(e)});
        }
    }
    return scattering;
}

/// What was simulated, before the measuring chain.
struct BeforeChain
{
    Setting setting;
    Eigen::VectorXd features;
};

BeforeChain beforeChain(const Study& study, const Simulator& simulator, const Run& run)
{
    BeforeChain before{run.setting, run.simulation.features};
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        double& amplitude = before.setting.amplitudes(e);
        if (study.effects[e].isOfChain() && amplitude != 0.0)
        {
            amplitude = 0.0;
            before.features = simulator.featuresOf(run.simulation.plain);
        }
    }
    return before;
}

} // namespace

//--- One condition --------------------------------------------------------------------------------------------------

Eigen::VectorXd ConditionEmulator::terms(const Eigen::VectorXd& parameters, const std::vector<Present>& present) const
{
    return basis.at(parameters.cwiseProduct(reach(present)), amplitudes(present));
}

Eigen::VectorXd ConditionEmulator::amplitudes(const std::vector<Present>& present) const
{
    Eigen::VectorXd all = Eigen::VectorXd::Zero(basis.effects.size());
    for (const auto& [effect, amplitude] : present)
    {
        const std::size_t place = basis.placeOf(effect);
        if (place < basis.effects.size())
        {
            all(place) = amplitude;
        }
    }
    return all;
}

Eigen::VectorXd ConditionEmulator::at(const Eigen::VectorXd& parameters, const std::vector<Present>& present) const
{
    return mean(present, parameters) * parameterTermsAt(parameters);
}

Eigen::VectorXd ConditionEmulator::reach(const std::vector<Present>& present) const
{
    Eigen::VectorXd factors = Eigen::VectorXd::Ones(basis.parameters);
    const Eigen::VectorXd here = amplitudes(present);
    for (std::size_t p = 0; p < owners.size(); ++p)
    {
        if (owners[p])
        {
            const std::size_t place = basis.placeOf(*owners[p]);
            factors(p) = place < basis.effects.size() ? here(place) : 0.0;
        }
    }
    return factors;
}

Eigen::MatrixXd ConditionEmulator::mean(const std::vector<Present>& present, const Eigen::VectorXd& around) const
{
    const Eigen::Index q = basis.parameters;
    Eigen::MatrixXd whitened = coefficients.topRows(parameterTerms(q)).transpose();
    for (std::size_t k = 0; k < present.size(); ++k)
    {
        const std::size_t place = basis.placeOf(present[k].effect);
        if (place == basis.effects.size())
        {
            continue;
        }
        const double a = present[k].amplitude;
        const Eigen::Index first = basis.effectTerm(place);
        whitened.col(0) += (a * coefficients.row(first) + a * a * coefficients.row(first + 1)).transpose();
        whitened.middleCols(1, q) += a * coefficients.middleRows(first + 2, q).transpose();
        for (std::size_t other = 0; other < k; ++other)
        {
            const std::size_t second = basis.placeOf(present[other].effect);
            if (second < basis.effects.size())
            {
                whitened.col(0) +=
                    a * present[other].amplitude * coefficients.row(basis.pairTerm(place, second)).transpose();
            }
        }
    }
    if (basis.waves.size() > 0)
    {
        whitened.leftCols(1 + q) += coefficients.middleRows(basis.firstWave(), basis.waves.size()).transpose()
                                    * basis.waves.linearAt(around.cwiseProduct(reach(present)), amplitudes(present));
    }
    Eigen::MatrixXd polynomial = root * whitened * parameterTermsAt(reach(present)).asDiagonal();
    polynomial.col(0) += centre;
    for (const auto& [effect, a] : present)
    {
        const auto found = chain.find(effect);
        if (found != chain.end())
        {
            const Chain& one = found->second;
            const Eigen::VectorXd weights = one.amplitudes.weightsAt(a).transpose();
            polynomial.col(0) += one.changes * weights;
            for (Eigen::Index i = 0; i < q; ++i)
            {
                polynomial.col(1 + i) += one.slopes[i] * weights;
            }
        }
    }
    return polynomial;
}

Eigen::MatrixXd ConditionEmulator::uncertainty(
    const Eigen::VectorXd& parameters, const std::vector<Present>& present) const
{
    // Only the terms that are not zero here.
    const Eigen::VectorXd all = terms(parameters, present);
    const auto used = numbersWhere(all.size(), [&](Eigen::Index i) { return all(i) != 0.0; });
    const Eigen::VectorXd x = all(used);
    Eigen::VectorXd variances(covariances.size());
    for (Eigen::Index f = 0; f < variances.size(); ++f)
    {
        const Eigen::MatrixXd& covariance = covariances[f];
        variances(f) = x.dot(covariance(used, used) * x);
    }
    return root * variances.cwiseMax(0.0).asDiagonal() * root.transpose();
}

Eigen::MatrixXd ConditionEmulator::noiseOf(const std::vector<Present>& present) const
{
    Eigen::VectorXd factor = Eigen::VectorXd::Zero(noise.rows());
    for (const auto& [effect, amplitude] : present)
    {
        const auto found = logScatter.find(effect);
        if (found != logScatter.end())
        {
            factor += std::abs(amplitude) * found->second;
        }
        const auto recorded = chain.find(effect);
        if (recorded != chain.end())
        {
            factor += recorded->second.logScatter * recorded->second.amplitudes.weightsAt(amplitude).transpose();
        }
    }
    factor = factor.array().exp();
    return factor.asDiagonal() * noise * factor.asDiagonal();
}

//--- Other worlds ---------------------------------------------------------------------------------------------------

Emulator Emulator::possibleWorld(std::mt19937_64& random) const
{
    std::normal_distribution<double> normal;
    Emulator world = *this;
    for (auto& condition : world.conditions_)
    {
        for (Eigen::Index f = 0; condition && f < condition->coefficients.cols(); ++f)
        {
            const Eigen::LDLT<Eigen::MatrixXd> factor(condition->covariances[f]);
            Eigen::VectorXd z = factor.vectorD().cwiseMax(0.0).cwiseSqrt();
            z = z.unaryExpr([&](double sd) { return sd * normal(random); }).eval();
            const Eigen::VectorXd error = factor.transpositionsP().transpose() * Eigen::VectorXd(factor.matrixL() * z);
            condition->coefficients.col(f) += error;
        }
        if (condition && condition->logSdError > 0.0)
        {
            // `root` stays, the unit of the coefficients
            const Eigen::VectorXd factor = Eigen::VectorXd::NullaryExpr(
                condition->noise.rows(), [&] { return std::exp(condition->logSdError * normal(random)); });
            condition->noise = factor.asDiagonal() * condition->noise * factor.asDiagonal();
        }
    }
    return world;
}

Emulator Emulator::relearnt(const Emulator& world, std::mt19937_64& random) const
{
    std::normal_distribution<double> normal;
    Emulator other = *this;
    for (const auto c : learnt_)
    {
        const ConditionEmulator& here = *world.conditions_[c];
        Rows& rows = other.rows_[c];
        Eigen::MatrixXd whitened = rows.terms * here.coefficients;
        for (Eigen::Index row = 0; row < whitened.rows(); ++row)
        {
            const double missed = rows.hasSeveral(row) ? lackOfFit_ : 0.0;
            whitened.row(row) =
                whitened.row(row).unaryExpr([&](double mean) { return mean + missed * normal(random); }).eval();
            const Eigen::MatrixXd root = here.noiseOf(rows.scattering[row]).llt().matrixL();
            const Eigen::VectorXd z = Eigen::VectorXd::NullaryExpr(whitened.cols(), [&] { return normal(random); });
            rows.values.row(row) = (here.centre + here.root * whitened.row(row).transpose() + root * z).transpose();
        }
    }
    other.learnNoiseAndScatter();
    for (const auto c : learnt_)
    {
        other.solve(c);
    }
    return other;
}

//--- All conditions -------------------------------------------------------------------------------------------------

Emulator::Emulator(const Study& study, const Simulator& simulator, const std::vector<Run>& runs,
    const std::vector<std::vector<Eigen::Index>>& features)
    : study_(&study),
      rows_(study.conditions.size()),
      conditions_(study.conditions.size()),
      known_(study.effects.size(), true),
      scatters_(!study.rig.seedEntry.empty())
{
    for (std::size_t c = 0; c < conditions_.size(); ++c)
    {
        choose(c, goodRuns(runs, c), features[c]);
        if (conditions_[c])
        {
            learnt_.push_back(c);
            append(c, simulator, goodRuns(runs, c));
        }
    }
    learnNoiseAndScatter();
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        for (const auto c : learnt_)
        {
            if (study.effects[e].isOfChain() && acts(study.effects[e], study.conditions[c]))
            {
                learnChain(e, c, simulator, goodRuns(runs, c));
            }
        }
    }
    chooseScales();
    for (const auto c : learnt_)
    {
        solve(c);
    }
}

/// Features and effects of a condition, from what its runs have.
void Emulator::choose(std::size_t c, const std::vector<const Run*>& good, const std::vector<Eigen::Index>& wanted)
{
    ConditionEmulator emulator;
    for (const auto f : wanted)
    {
        const auto has = std::count_if(
            good.begin(), good.end(), [&](const Run* run) { return std::isfinite(run->simulation.features(f)); });
        if (static_cast<double>(has) >= (1.0 - mostGaps) * static_cast<double>(good.size()) && has > 0)
        {
            emulator.features.push_back(f);
        }
        else
        {
            remarks_.push_back("feature " + study_->features[f].name + " is left out in condition "
                               + study_->conditions[c].name + ": too many runs do not have it");
        }
    }
    if (emulator.features.empty())
    {
        return;
    }
    emulator.basis.parameters = static_cast<Eigen::Index>(study_->parameters.size());
    emulator.owners = mapped(study_->parameters, [](const Parameter& parameter) { return parameter.effect; });
    for (const auto e : simulatedEffects(*study_, c))
    {
        const auto isOn = [&](const Run* run) {
            return run->setting.amplitudes(e) != 0.0
                   && run->simulation.features(emulator.features).array().isFinite().all();
        };
        if (std::any_of(good.begin(), good.end(), isOn))
        {
            emulator.basis.effects.push_back(e);
        }
        else
        {
            known_[e] = false;
            remarks_.push_back("effect " + study_->effects[e].name + " is not judged: in condition "
                               + study_->conditions[c].name + " all its runs have failed");
        }
        if (study_->effects[e].raisesScatter)
        {
            emulator.logScatter[e] = Eigen::VectorXd::Zero(emulator.features.size());
        }
    }
    if (!scatters_)
    {
        // Of parameters of the model itself, polynomials: a fit without any effect must not go where waves say anything
        const auto isOfEffect = mapped(emulator.owners, [](const auto& owner) { return owner.has_value(); });
        emulator.basis.waves = Waves(waves, isOfEffect, emulator.basis.effects.size());
    }
    conditions_[c] = std::move(emulator);
}

void Emulator::append(std::size_t c, const Simulator& simulator, const std::vector<const Run*>& runs)
{
    const ConditionEmulator& emulator = *conditions_[c];
    Rows& rows = rows_[c];
    for (const auto* run : runs)
    {
        const auto [setting, all] = beforeChain(*study_, simulator, *run);
        const Eigen::VectorXd values = all(emulator.features);
        if (!values.array().isFinite().all())
        {
            continue;
        }
        std::vector<Present> present;
        for (const auto e : emulator.basis.effects)
        {
            present.push_back({e, setting.amplitudes(e)});
        }
        const Eigen::Index row = rows.values.rows();
        rows.values.conservativeResize(row + 1, values.size());
        rows.values.row(row) = values.transpose();
        rows.terms.conservativeResize(row + 1, emulator.basis.size());
        rows.terms.row(row) = emulator.terms(inSds(*study_, setting.parameters), present).transpose();
        rows.settings.push_back(setting);
        const auto on = (setting.amplitudes(emulator.basis.effects).array() != 0.0).count();
        rows.terms(row, emulator.basis.designTerm()) = on > 1 ? 1.0 : 0.0;
        rows.scattering.push_back(scatteringOf(emulator, setting));
    }
    conditions_[c]->centre = rows.values.colwise().mean().transpose();
}


/// Effects that raise the scatter without being declared to are found by the noise of runs without effects.
void Emulator::learnNoiseAndScatter()
{
    if (scatters_)
    {
        learnNoise(true);
        learnScatter();
    }
    learnNoise(false);
}

/// Noise from repeats at equal settings, and from nothing else: what a regression leaves is too small by what it has taken
/// up. Correlations are those of all conditions together; the variances of a condition are drawn towards those of all by as
/// much as chance explains.
void Emulator::learnNoise(bool ofPlainRuns)
{
    const Eigen::Index features = study_->featureCount();
    std::vector<Eigen::VectorXd> logSds(conditions_.size());
    std::vector<Eigen::VectorXd> smallest(conditions_.size());
    std::vector<double> freedom(conditions_.size(), 0.0);
    std::vector<Eigen::MatrixXd> deviations(conditions_.size());
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(features);
    Eigen::VectorXd weight = squares;
    for (const auto c : learnt_)
    {
        const auto& kept = conditions_[c]->features;
        const Rows& rows = rows_[c];
        Scatter own;
        for (const auto& group : repeatsOf(rows.settings))
        {
            const std::size_t first = group.front();
            const bool isPlain = rows.settings[first].amplitudes.isZero() || !ofPlainRuns;
            if (scatters_ && rows.scattering[first].empty() && isPlain)
            {
                own.add(rows.values(group, Eigen::all));
            }
        }
        const Eigen::RowVectorXd mean = rows.values.colwise().mean();
        smallest[c] = exactShare
                      * ((rows.values.rowwise() - mean).colwise().squaredNorm().transpose()
                          / static_cast<double>(rows.values.rows()))
                            .cwiseSqrt()
                            .cwiseMax(1e-9);
        freedom[c] = own.degreesOfFreedom();
        logSds[c] = smallest[c].array().log();
        if (freedom[c] > 0.0)
        {
            deviations[c] = own.deviations();
            const Eigen::VectorXd meanSquare = deviations[c].cwiseAbs2().colwise().mean();
            logSds[c] = meanSquare.cwiseSqrt().cwiseMax(smallest[c]).array().log() - 0.5 * biasOfLog(freedom[c]);
            squares(kept) += freedom[c] * meanSquare;
            weight(kept).array() += freedom[c];
        }
    }
    const Eigen::VectorXd pooled =
        0.5 * squares.cwiseQuotient(weight.cwiseMax(1e-9)).cwiseMax(1e-30).array().log().matrix();
    // Variance between conditions beyond that of chance, 1/(2 nu) for the log of a standard deviation. It is that of all
    // features together: a feature's own would follow the one condition whose few repeats happen to lie close.
    double between = 0.0;
    double count = 0.0;
    degreesOfFreedom_ = 0.0;
    for (const auto c : learnt_)
    {
        if (freedom[c] > 0.0)
        {
            between += ((logSds[c] - pooled(conditions_[c]->features)).array().square() - 0.5 / freedom[c]).sum();
            count += static_cast<double>(logSds[c].size());
            degreesOfFreedom_ += freedom[c];
        }
    }
    between = std::max(leastBetween, between / std::max(count, 1.0));
    Eigen::MatrixXd standardised(0, features);
    for (const auto c : degreesOfFreedom_ > 0.0 ? learnt_ : std::vector<std::size_t>{})
    {
        const auto& kept = conditions_[c]->features;
        const Eigen::VectorXd common = pooled(kept).cwiseMax(smallest[c].array().log().matrix());
        if (freedom[c] == 0.0)
        {
            logSds[c] = common;
            conditions_[c]->logSdError = std::sqrt(between);
            continue;
        }
        const double own = between / (between + 0.5 / freedom[c]);
        logSds[c] = common + (logSds[c] - common) * own;
        conditions_[c]->logSdError = std::sqrt(0.5 * own / freedom[c]);
        const Eigen::Index first = standardised.rows();
        standardised.conservativeResize(first + deviations[c].rows(), Eigen::NoChange);
        standardised.bottomRows(deviations[c].rows()).setConstant(std::nan(""));
        for (std::size_t k = 0; k < kept.size(); ++k)
        {
            const Eigen::Index place = k;
            standardised.col(kept[k]).tail(deviations[c].rows()) =
                deviations[c].col(place) * std::exp(-logSds[c](place));
        }
    }
    Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(features, features);
    if (standardised.rows() > 0)
    {
        correlation = pooledCovariance(standardised, degreesOfFreedom_).matrix;
        const Eigen::VectorXd scale = correlation.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
        correlation = scale.asDiagonal() * correlation * scale.asDiagonal();
        correlation.diagonal().setOnes();
    }
    const Eigen::VectorXd typical = (weight.array() > 0.0).select(pooled.array().exp(), 0.0).matrix();
    noise_ = typical.asDiagonal() * correlation * typical.asDiagonal();
    for (const auto c : learnt_)
    {
        ConditionEmulator& here = *conditions_[c];
        const Eigen::VectorXd sds = logSds[c].array().exp();
        here.noise = sds.asDiagonal() * Eigen::MatrixXd(correlation(here.features, here.features)) * sds.asDiagonal();
        here.root = here.noise.llt().matrixL();
    }
}

/// Variances of the runs in units of the noise, runs x features.
Eigen::ArrayXXd Emulator::variances(std::size_t c) const
{
    const ConditionEmulator& emulator = *conditions_[c];
    const Rows& rows = rows_[c];
    Eigen::ArrayXXd all = Eigen::ArrayXXd::Ones(rows.values.rows(), rows.values.cols());
    const auto lower = emulator.root.triangularView<Eigen::Lower>();
    for (Eigen::Index row = 0; row < all.rows(); ++row)
    {
        const auto& scattering = rows.scattering[row];
        if (!scattering.empty())
        {
            const Eigen::MatrixXd wide = emulator.noiseOf(scattering).llt().matrixL();
            all.row(row) = lower.solve(wide).rowwise().squaredNorm().transpose().array();
        }
        if (rows.hasSeveral(row))
        {
            all.row(row) += lackOfFit_ * lackOfFit_;
        }
    }
    return all;
}

/// Values of the runs from their centre, in units of the noise, runs x features.
Eigen::MatrixXd Emulator::whitened(std::size_t c) const
{
    const ConditionEmulator& emulator = *conditions_[c];
    const Eigen::MatrixXd values = rows_[c].values.rowwise() - emulator.centre.transpose();
    return emulator.root.triangularView<Eigen::Lower>().solve(values.transpose()).transpose();
}

/// Log marginal likelihood of all runs, without constants.
double Emulator::logEvidence(const std::array<double, Basis::kinds>& scales) const
{
    double sum = 0.0;
    for (const auto c : learnt_)
    {
        const Eigen::MatrixXd scaled = rows_[c].terms * priorSds(conditions_[c]->basis, scales).asDiagonal();
        Eigen::MatrixXd covariance = scaled * scaled.transpose();
        covariance.diagonal() += variances(c).rowwise().mean().matrix();
        const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
        const Eigen::MatrixXd left = factor.matrixL().solve(whitened(c));
        sum -= 0.5 * left.squaredNorm()
               + static_cast<double>(left.cols()) * factor.matrixLLT().diagonal().array().abs().log().sum();
    }
    return sum;
}

/// Scales of largest evidence, one after the other, twice round.
void Emulator::chooseScales()
{
    if (scales_[Basis::linear] == 0.0)
    {
        scales_ = {largestScale, 10.0, 1.0, 1.0, 1.0, scatters_ ? 0.0 : 1.0};
    }
    constexpr int bits = 8;
    constexpr int sweeps = 2;
    constexpr std::uintmax_t mostEvaluations = 16;
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
        for (const auto kind : {Basis::linear, Basis::square, Basis::mixed, Basis::interaction, Basis::wave})
        {
            if (kind == Basis::wave && scatters_)
            {
                continue;
            }
            const auto misfit = [&](double logScale) {
                auto scales = scales_;
                scales[kind] = std::exp(logScale);
                return -logEvidence(scales);
            };
            std::uintmax_t most = mostEvaluations;
            scales_[kind] = std::exp(boost::math::tools::brent_find_minima(
                misfit, std::log(smallestScale), std::log(largestScale / 10.0), bits, most)
                                         .first);
        }
        if (scatters_)
        {
            const auto misfit = [&](double logSize) {
                lackOfFit_ = std::exp(logSize);
                return -logEvidence(scales_);
            };
            std::uintmax_t most = mostEvaluations;
            lackOfFit_ = std::exp(
                boost::math::tools::brent_find_minima(misfit, std::log(smallestScale), std::log(10.0), bits, most)
                    .first);
        }
    }
}

/// Coefficients and their covariance.
void Emulator::solve(std::size_t c)
{
    ConditionEmulator& emulator = *conditions_[c];
    const Rows& rows = rows_[c];
    const Eigen::Index features = rows.values.cols();
    const Eigen::VectorXd prior = priorSds(emulator.basis, scales_).cwiseAbs2();
    const Eigen::MatrixXd values = whitened(c);
    const Eigen::ArrayXXd variance = variances(c);
    emulator.coefficients.resize(prior.size(), features);
    emulator.covariances.resize(features);
    for (Eigen::Index f = 0; f < features; ++f)
    {
        Eigen::VectorXd own = prior;
        Eigen::MatrixXd inDesign = Eigen::MatrixXd::Zero(rows.terms.rows(), rows.terms.rows());
        // First without, then with what effects of this size may do beside their main effect.
        for (const bool heredity : {false, true})
        {
            for (Eigen::Index p = 0; heredity && p < emulator.basis.parameters; ++p)
            {
                own(parameterTerm(emulator.basis.parameters, p, p)) +=
                    std::pow(curvatureShare * emulator.coefficients(1 + p, f), 2);
            }
            for (std::size_t k = 0; heredity && k < emulator.basis.effects.size(); ++k)
            {
                const Eigen::Index term = emulator.basis.effectTerm(k);
                const double main = emulator.coefficients(term, f);
                own(term) += std::pow(mainShare * main, 2);
                const bool isCorrection = study_->effects[emulator.basis.effects[k]].bounds.lower < 0.0;
                own(term + 1) += std::pow((isCorrection ? curvatureOfCorrections : curvatureShare) * main, 2);
                Eigen::VectorXd design = rows.terms.col(term);
                design.array() *= rows.terms.col(emulator.basis.designTerm()).array() * designShare * main;
                inDesign += design * design.transpose();
            }
            const Eigen::MatrixXd spread = own.asDiagonal() * rows.terms.transpose();
            Eigen::MatrixXd covariance = rows.terms * spread + inDesign;
            covariance.diagonal() += variance.col(f).matrix();
            const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
            emulator.coefficients.col(f) = spread * factor.solve(values.col(f));
            if (heredity)
            {
                const Eigen::MatrixXd half = factor.matrixL().solve(spread.transpose());
                Eigen::MatrixXd& posterior = emulator.covariances[f];
                posterior = -half.transpose() * half;
                posterior.diagonal() += own;
            }
        }
    }
}

/// How much effects raise the scatter: from repeats of runs with one effect alone.
void Emulator::learnScatter()
{
    for (std::size_t e = 0; e < study_->effects.size(); ++e)
    {
        Eigen::VectorXd squares = Eigen::VectorXd::Zero(study_->featureCount()); // over the usual variance
        Eigen::VectorXd freedom = squares;
        std::map<std::size_t, std::pair<Eigen::VectorXd, double>> own; // by condition: the same, degrees of freedom
        double statistic = 0.0;
        double statisticFreedom = 0.0;
        for (const auto c : learnt_)
        {
            const auto& kept = conditions_[c]->features;
            for (const auto& group : repeatsOf(rows_[c].settings))
            {
                const Setting& setting = rows_[c].settings[group.front()];
                Eigen::VectorXd others = setting.amplitudes;
                others(e) = 0.0;
                if (group.size() < 2 || setting.amplitudes(e) == 0.0 || !others.isZero())
                {
                    continue;
                }
                const Eigen::MatrixXd values = rows_[c].values(group, Eigen::all);
                const Eigen::MatrixXd deviations = values.rowwise() - Eigen::RowVectorXd(values.colwise().mean());
                const double nu = static_cast<double>(group.size()) - 1.0;
                const Eigen::VectorXd ratio =
                    deviations.colwise().squaredNorm().transpose().cwiseQuotient(conditions_[c]->noise.diagonal());
                squares(kept) += ratio;
                freedom(kept).array() += nu;
                own[c] = {ratio, nu};
                statistic +=
                    conditions_[c]->root.triangularView<Eigen::Lower>().solve(deviations.transpose()).squaredNorm();
                statisticFreedom += nu * static_cast<double>(kept.size());
            }
        }
        if (own.empty())
        {
            continue;
        }
        // The noise is an estimate itself.
        const boost::math::fisher_f chance(statisticFreedom,
            std::max(
                1.0, degreesOfFreedom_ * statisticFreedom / (freedom.maxCoeff() > 0.0 ? freedom.maxCoeff() : 1.0)));
        if (!study_->effects[e].raisesScatter
            && boost::math::cdf(boost::math::complement(chance, statistic / statisticFreedom)) > otherScatter)
        {
            continue;
        }
        for (const auto& [c, ratioAndFreedom] : own)
        {
            const auto& [ratio, nu] = ratioAndFreedom;
            const auto& kept = conditions_[c]->features;
            Eigen::VectorXd logs(ratio.size());
            for (Eigen::Index k = 0; k < ratio.size(); ++k)
            {
                const auto f = kept[k];
                const double all = 0.5 * (std::log(squares(f) / freedom(f)) - biasOfLog(freedom(f)));
                const double here = 0.5 * (std::log(ratio(k) / nu) - biasOfLog(nu));
                logs(k) = all + (here - all) * nu / (nu + sharedScatter);
            }
            conditions_[c]->logScatter[e] = logs;
        }
    }
    for (const auto c : learnt_)
    {
        rows_[c].scattering =
            mapped(rows_[c].settings, [&](const Setting& setting) { return scatteringOf(*conditions_[c], setting); });
    }
}

/// The curves of runs without effects, once more through the chain.
void Emulator::learnChain(std::size_t e, std::size_t c, const Simulator& simulator, const std::vector<const Run*>& runs)
{
    const Effect& effect = study_->effects[e];
    const auto& kept = conditions_[c]->features;
    const Eigen::Index q = study_->parameters.size();
    std::vector<const Curve*> curves;
    std::vector<Setting> settings;
    std::vector<Eigen::VectorXd> features;
    for (const auto* run : runs)
    {
        const auto [setting, all] = beforeChain(*study_, simulator, *run);
        if (setting.amplitudes.isZero() && all(kept).array().isFinite().all())
        {
            curves.push_back(&run->simulation.plain);
            settings.push_back(setting);
            features.emplace_back(all(kept));
        }
    }
    const Eigen::Index rows = curves.size();
    Eigen::MatrixXd before(rows, kept.size());
    Eigen::MatrixXd terms = Eigen::MatrixXd::Ones(rows, 1 + q);
    for (Eigen::Index row = 0; row < rows; ++row)
    {
        before.row(row) = features[row].transpose();
        terms.row(row).tail(q) = inSds(*study_, settings[row].parameters).transpose();
    }
    const auto groups = repeatsOf(settings);
    const auto squares = [&](const Eigen::MatrixXd& values, const std::vector<Eigen::Index>& some) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(values.cols());
        for (const auto& group : groups)
        {
            std::vector<Eigen::Index> own;
            std::set_intersection(group.begin(), group.end(), some.begin(), some.end(), std::back_inserter(own));
            if (own.size() > 1)
            {
                const Eigen::MatrixXd chosen = values(own, Eigen::all);
                sum += (chosen.rowwise() - Eigen::RowVectorXd(chosen.colwise().mean()))
                           .colwise()
                           .squaredNorm()
                           .transpose();
            }
        }
        return sum;
    };

    ConditionEmulator::Chain chain;
    chain.amplitudes = Grid(effect);
    const Eigen::VectorXd& amplitudes = chain.amplitudes.amplitudes();
    chain.changes = Eigen::MatrixXd::Zero(before.cols(), amplitudes.size());
    chain.logScatter = chain.changes;
    chain.slopes.assign(q, chain.changes);
    for (Eigen::Index node = 0; node < amplitudes.size(); ++node)
    {
        Setting setting = simulator.plainSetting();
        setting.amplitudes(e) = amplitudes(node);
        Eigen::MatrixXd after(rows, before.cols());
        std::vector<Eigen::Index> good;
        for (Eigen::Index row = 0; row < rows; ++row)
        {
            const Curve& curve = *curves[row];
            after.row(row) = simulator.featuresOf(simulator.throughChain(curve, c, setting))(kept).transpose();
            if (after.row(row).array().isFinite().all())
            {
                good.push_back(row);
            }
        }
        if (good.empty())
        {
            known_[e] = false;
            remarks_.push_back("effect " + effect.name
                               + " is not judged: with it no curve has the features of condition "
                               + study_->conditions[c].name);
            return;
        }
        const Eigen::MatrixXd solution = Eigen::MatrixXd(terms(good, Eigen::all))
                                             .completeOrthogonalDecomposition()
                                             .solve(Eigen::MatrixXd((after - before)(good, Eigen::all)));
        chain.changes.col(node) = solution.row(0).transpose();
        for (Eigen::Index i = 0; i < q; ++i)
        {
            chain.slopes[i].col(node) = solution.row(1 + i).transpose();
        }
        if (scatters_)
        {
            const Eigen::ArrayXd ratio = squares(after, good).array() / squares(before, good).array();
            chain.logScatter.col(node) = (ratio.isFinite() && ratio > 0.0).select(0.5 * ratio.log(), 0.0);
        }
    }
    conditions_[c]->chain[e] = std::move(chain);
}

} // namespace clepsydra::identification
