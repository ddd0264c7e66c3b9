#include "emulator/emulator.h"

#include "emulator/settings.h"

#include "lists.h"

#include <boost/math/tools/minima.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

/// A feature is left out if more than this share of the runs lacks it; otherwise the runs that lack it are left out.
constexpr double mostGaps = 0.2;

/// The curvature and the interactions of an effect are expected to be proportional to its size (heredity: Chipman, Can.
/// J. Stat. 24, 17 (1996)); a prior of one scale for all effects would exclude them for large effects. Prior standard
/// deviations as shares of the main effect: of the main effect itself, of the squared term, and of the difference
/// between the design's runs and runs with the effect alone.
constexpr double mainShare = 3.0;
constexpr double curvatureShare = 0.4;
constexpr double curvatureOfCorrections = 0.05;
constexpr double designShare = 0.1;

/// Number of waves if runs do not scatter, so that deviations from the quadratic polynomial can be seen.
constexpr Eigen::Index waves = 128;

/// Limits of the priors' scales, in units of one run's noise.
constexpr double largestScale = 1e5;
constexpr double smallestScale = 1e-2;

Eigen::VectorXd priorSds(const Basis& basis, const std::array<double, Basis::kinds>& scales)
{
    return Eigen::VectorXd::NullaryExpr(basis.size(), [&](Eigen::Index term) { return scales[basis.kind(term)]; });
}

} // namespace

//--- Draws from the posterior ---------------------------------------------------------------------------------------

Emulator Emulator::posteriorDraw(std::mt19937_64& random) const
{
    std::normal_distribution<double> normal;
    Emulator draw = *this;
    for (const auto c : learnt_)
    {
        ConditionEmulator& here = *draw.conditions_[c];
        for (Eigen::Index f = 0; f < here.coefficients.cols(); ++f)
        {
            const Eigen::LDLT<Eigen::MatrixXd> factor(here.covariances[f]);
            const Eigen::VectorXd sds = factor.vectorD().cwiseMax(0.0).cwiseSqrt();
            const Eigen::VectorXd z = sds.unaryExpr([&](double sd) { return sd * normal(random); });
            const Eigen::VectorXd error = factor.transpositionsP().transpose() * Eigen::VectorXd(factor.matrixL() * z);
            here.coefficients.col(f) += error;
        }
        if (here.logSdError > 0.0)
        {
            // `root` does not change, because it is the unit of the coefficients.
            const Eigen::VectorXd factor = Eigen::VectorXd::NullaryExpr(
                here.noise.rows(), [&] { return std::exp(here.logSdError * normal(random)); });
            here.noise = factor.asDiagonal() * here.noise * factor.asDiagonal();
        }
    }
    return draw;
}

Emulator Emulator::regenerated(const Emulator& truth, std::mt19937_64& random) const
{
    std::normal_distribution<double> normal;
    Emulator other = *this;
    for (const auto c : learnt_)
    {
        const ConditionEmulator& here = *truth.conditions_[c];
        Rows& rows = other.rows_[c];
        Eigen::MatrixXd whitened = rows.terms * here.coefficients;
        for (Eigen::Index row = 0; row < whitened.rows(); ++row)
        {
            const double missed = rows.hasSeveral(row) ? lackOfFit_ : 0.0;
            whitened.row(row) =
                whitened.row(row).unaryExpr([&](double mean) { return mean + missed * normal(random); }).eval();
            const Eigen::MatrixXd root = here.noiseOf(here.scatteringIn(rows.settings[row])).llt().matrixL();
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

Emulator::Emulator(const Study& study, const StudySimulator& studySimulator, const std::vector<Simulation>& runs,
    const std::vector<std::vector<Eigen::Index>>& features)
    : study_(&study),
      rows_(study.conditions.size()),
      conditions_(study.conditions.size()),
      known_(study.effects.size(), true),
      scatters_(study.simulator.scatters())
{
    std::vector<std::vector<const Curve*>> curves(conditions_.size());
    for (std::size_t c = 0; c < conditions_.size(); ++c)
    {
        choose(c, goodRuns(runs, c), features[c]);
        if (conditions_[c])
        {
            learnt_.push_back(c);
            curves[c] = append(c, studySimulator, goodRuns(runs, c));
        }
    }
    learnNoiseAndScatter();
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        for (const auto c : learnt_)
        {
            if (study.effects[e].isOfChain() && acts(study.effects[e], study.conditions[c]))
            {
                learnChain(e, c, studySimulator, curves[c]);
            }
        }
    }
    chooseScales();
    for (const auto c : learnt_)
    {
        solve(c);
    }
}

/// Chooses the features and effects of a condition that its runs contain.
void Emulator::choose(
    std::size_t c, const std::vector<const Simulation*>& good, const std::vector<Eigen::Index>& wanted)
{
    ConditionEmulator emulator;
    for (const auto f : wanted)
    {
        const auto has = std::count_if(
            good.begin(), good.end(), [&](const Simulation* run) { return std::isfinite(run->features(f)); });
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
        const auto isOn = [&](const Simulation* run) {
            return run->setting.amplitudes(e) != 0.0 && run->features(emulator.features).array().isFinite().all();
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
        // In the model's own parameters the emulator is a polynomial, so that waves cannot distort the null fit.
        const auto isOfEffect = mapped(emulator.owners, [](const auto& owner) { return owner.has_value(); });
        emulator.basis.waves = Waves(waves, isOfEffect, emulator.basis.effects.size());
    }
    conditions_[c] = std::move(emulator);
}

/// Fills in the rows of a condition. \return the curve of each row, before the measuring chain
std::vector<const Curve*> Emulator::append(
    std::size_t c, const StudySimulator& studySimulator, const std::vector<const Simulation*>& runs)
{
    ConditionEmulator& emulator = *conditions_[c];
    Rows& rows = rows_[c];
    std::vector<const Curve*> curves;
    for (const auto* run : runs)
    {
        Setting setting = run->setting;
        const auto ofChain = numbersWhere(study_->effects.size(),
            [&](std::size_t e) { return study_->effects[e].isOfChain() && setting.amplitudes(e) != 0.0; });
        setting.amplitudes(ofChain).setZero();
        const Eigen::VectorXd all = ofChain.empty() ? run->features : studySimulator.featuresOf(run->plain);
        const Eigen::VectorXd values = all(emulator.features);
        if (!values.array().isFinite().all())
        {
            continue;
        }
        const auto present = mapped(emulator.basis.effects, [&](std::size_t e) {
            return Present{e, setting.amplitudes(e)};
        });
        const Eigen::Index row = rows.values.rows();
        rows.values.conservativeResize(row + 1, values.size());
        rows.values.row(row) = values.transpose();
        rows.terms.conservativeResize(row + 1, emulator.basis.size());
        rows.terms.row(row) = emulator.terms(inSds(*study_, setting.parameters), present).transpose();
        rows.settings.push_back(setting);
        const auto on = (setting.amplitudes(emulator.basis.effects).array() != 0.0).count();
        rows.terms(row, emulator.basis.designTerm()) = on > 1 ? 1.0 : 0.0;
        curves.push_back(&run->plain);
    }
    emulator.centre = rows.values.colwise().mean().transpose();
    return curves;
}

/// Variances of the runs in units of the noise: runs x features.
Eigen::ArrayXXd Emulator::variances(std::size_t c) const
{
    const ConditionEmulator& emulator = *conditions_[c];
    const Rows& rows = rows_[c];
    Eigen::ArrayXXd all = Eigen::ArrayXXd::Ones(rows.values.rows(), rows.values.cols());
    const auto lower = emulator.root.triangularView<Eigen::Lower>();
    for (Eigen::Index row = 0; row < all.rows(); ++row)
    {
        const auto scattering = emulator.scatteringIn(rows.settings[row]);
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

/// Deviations of the runs from their centre in units of the noise: runs x features.
Eigen::MatrixXd Emulator::whitened(std::size_t c) const
{
    const ConditionEmulator& emulator = *conditions_[c];
    const Eigen::MatrixXd values = rows_[c].values.rowwise() - emulator.centre.transpose();
    return emulator.root.triangularView<Eigen::Lower>().solve(values.transpose()).transpose();
}

/// Log marginal likelihood of all runs, up to a constant.
double Emulator::logEvidence() const
{
    double sum = 0.0;
    for (const auto c : learnt_)
    {
        const Eigen::MatrixXd scaled = rows_[c].terms * priorSds(conditions_[c]->basis, scales_).asDiagonal();
        Eigen::MatrixXd covariance = scaled * scaled.transpose();
        covariance.diagonal() += variances(c).rowwise().mean().matrix();
        const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
        const Eigen::MatrixXd left = factor.matrixL().solve(whitened(c));
        sum -= 0.5 * left.squaredNorm()
               + static_cast<double>(left.cols()) * factor.matrixLLT().diagonal().array().abs().log().sum();
    }
    return sum;
}

/// Chooses the scales that maximise the evidence, by two sweeps of searches in one scale at a time.
void Emulator::chooseScales()
{
    scales_ = {largestScale, 10.0, 1.0, 1.0, 1.0, 1.0};
    constexpr int bits = 8;
    constexpr int sweeps = 2;
    constexpr std::uintmax_t mostEvaluations = 16;
    const auto maximise = [&](double& scale, double largest) {
        const auto cost = [&](double logScale) {
            scale = std::exp(logScale);
            return -logEvidence();
        };
        std::uintmax_t most = mostEvaluations;
        const auto found =
            boost::math::tools::brent_find_minima(cost, std::log(smallestScale), std::log(largest), bits, most);
        scale = std::exp(found.first);
    };
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
        for (const auto kind : {Basis::linear, Basis::square, Basis::mixed, Basis::interaction})
        {
            maximise(scales_[kind], largestScale / 10.0);
        }
        scatters_ ? maximise(lackOfFit_, 10.0) : maximise(scales_[Basis::wave], largestScale / 10.0);
    }
}

/// Computes the coefficients of a condition and their covariance.
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
        // The second pass adds priors of curvature and interaction in proportion to the main effects of the first.
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

} // namespace clepsydra::identification
