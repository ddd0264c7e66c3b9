#include "emulator/covariance.h"
#include "emulator/distributions.h"
#include "emulator/emulator.h"
#include "emulator/settings.h"

#include "lists.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

/// Noise of runs without scatter, as a share of the standard deviation of a feature over all runs.
constexpr double exactShare = 1e-3;

/// An effect that is not declared to raise the scatter is found to do so if chance alone would give its repeats as
/// large a scatter with less than this probability.
constexpr double otherScatter = 1e-2;

/// Smallest variance, between conditions, of the log of a feature's scatter: 10 % of scatter.
constexpr double leastBetween = 0.01;

/// Weight of the scatter of all conditions beside that of one condition, in degrees of freedom.
constexpr double sharedScatter = 8.0;

/// Standard deviation, before any run, of the log of the factor by which an effect of amplitude 1 changes the scatter.
/// Without it, two runs of a small amplitude that differ by chance would make that factor huge.
constexpr double priorOfLogFactor = 2.0;

/// Bias of the log of a mean square.
double biasOfLog(double degreesOfFreedom)
{
    return digamma(degreesOfFreedom / 2.0) - std::log(degreesOfFreedom / 2.0);
}

/// Sums of squares of deviations in units of the noise's variance, and their degrees of freedom, by feature.
struct Squares
{
    Eigen::VectorXd sum;
    Eigen::VectorXd freedom;
};

/// By the magnitude of the amplitude, to which the log of the factor on the standard deviation is proportional.
using SquaresByAmplitude = std::map<double, Squares>;

void add(SquaresByAmplitude& all, double amplitude, Eigen::Index features, const std::vector<Eigen::Index>& kept,
    const Eigen::VectorXd& squares, double freedom)
{
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(features);
    Squares& here = all.try_emplace(std::abs(amplitude), Squares{none, none}).first->second;
    here.sum(kept) += squares;
    here.freedom(kept).array() += freedom;
}

/// Log of the factor at amplitude 1, the mean of the prior, 0, and of the amplitudes with weights that are inverse to
/// their variances, and the weight of the amplitudes in degrees of freedom at amplitude 1.
std::pair<double, double> logFactor(const SquaresByAmplitude& all, Eigen::Index feature)
{
    double sum = 0.0;
    double weights = 0.0;
    for (const auto& [amplitude, squares] : all)
    {
        if (const double freedom = squares.freedom(feature); freedom > 0.0)
        {
            const double weight = freedom * amplitude * amplitude;
            sum += weight * 0.5 * (std::log(squares.sum(feature) / freedom) - biasOfLog(freedom)) / amplitude;
            weights += weight;
        }
    }
    // The variance of the log of a standard deviation is 1/(2 nu).
    return {sum / (weights + 0.5 / (priorOfLogFactor * priorOfLogFactor)), weights};
}

} // namespace

/// The noise of runs without effects is estimated first, because the effects that raise the scatter are found by
/// comparison with it.
void Emulator::learnNoiseAndScatter()
{
    learnNoise(true);
    learnScatter();
    learnNoise(false);
}

/// Places of the runs of a condition with equal settings. Runs that are equal because they do not scatter say nothing
/// about noise.
std::vector<std::vector<Eigen::Index>> Emulator::repeats(std::size_t c) const
{
    return scatters_ ? repeatsOf(rows_[c].settings) : std::vector<std::vector<Eigen::Index>>{};
}

/// Estimates the noise from repeats at equal settings only, because the residual of a regression underestimates it. The
/// correlations are pooled over all conditions. The variances of a condition are shrunk towards the pooled ones by the
/// share of their differences that chance explains.
void Emulator::learnNoise(bool ofPlainRuns)
{
    const Eigen::Index features = study_->featureCount();
    std::vector<Eigen::VectorXd> logSds(conditions_.size());
    std::vector<Eigen::VectorXd> smallest(conditions_.size());
    std::vector<Scatter> ofRepeats(conditions_.size());
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(features);
    Eigen::VectorXd weight = squares;
    for (const auto c : learnt_)
    {
        const auto& kept = conditions_[c]->features;
        const Eigen::MatrixXd& values = rows_[c].values;
        Scatter& own = ofRepeats[c];
        for (const auto& group : repeats(c))
        {
            const Setting& setting = rows_[c].settings[group.front()];
            if ((setting.amplitudes.isZero() || !ofPlainRuns) && conditions_[c]->scatteringIn(setting).empty())
            {
                own.add(values(group, Eigen::all));
            }
        }
        const Eigen::RowVectorXd mean = values.colwise().mean();
        const Eigen::VectorXd all = (values.rowwise() - mean).colwise().squaredNorm().transpose();
        smallest[c] = exactShare * (all / static_cast<double>(values.rows())).cwiseSqrt().cwiseMax(1e-9);
        logSds[c] = smallest[c].array().log();
        if (own.freedom > 0.0)
        {
            const Eigen::VectorXd meanSquare = own.deviations.cwiseAbs2().colwise().mean();
            logSds[c] = meanSquare.cwiseSqrt().cwiseMax(smallest[c]).array().log() - 0.5 * biasOfLog(own.freedom);
            squares(kept) += own.freedom * meanSquare;
            weight(kept).array() += own.freedom;
        }
    }
    const Eigen::VectorXd pooled =
        0.5 * squares.cwiseQuotient(weight.cwiseMax(1e-9)).cwiseMax(1e-30).array().log().matrix();
    // Variance between conditions beyond that of chance, which is 1/(2 nu) for the log of a standard deviation. It is
    // pooled over all features; a single feature's would follow the one condition whose few repeats happen to agree.
    double between = 0.0;
    double count = 0.0;
    degreesOfFreedom_ = 0.0;
    for (const auto c : learnt_)
    {
        const double freedom = ofRepeats[c].freedom;
        if (freedom > 0.0)
        {
            between += ((logSds[c] - pooled(conditions_[c]->features)).array().square() - 0.5 / freedom).sum();
            count += static_cast<double>(logSds[c].size());
            degreesOfFreedom_ += freedom;
        }
    }
    between = std::max(leastBetween, between / std::max(count, 1.0));
    Eigen::MatrixXd standardised(0, features);
    for (const auto c : degreesOfFreedom_ > 0.0 ? learnt_ : std::vector<std::size_t>{})
    {
        const auto& kept = conditions_[c]->features;
        const auto& [deviations, freedom] = ofRepeats[c];
        const Eigen::VectorXd common = pooled(kept).cwiseMax(smallest[c].array().log().matrix());
        if (freedom == 0.0)
        {
            logSds[c] = common;
            conditions_[c]->logSdError = std::sqrt(between);
            continue;
        }
        const double own = between / (between + 0.5 / freedom);
        logSds[c] = common + (logSds[c] - common) * own;
        conditions_[c]->logSdError = std::sqrt(0.5 * own / freedom);
        const Eigen::VectorXd scales = logSds[c].unaryExpr([](double log) { return std::exp(-log); });
        standardised.conservativeResize(standardised.rows() + deviations.rows(), Eigen::NoChange);
        auto added = standardised.bottomRows(deviations.rows());
        added.setConstant(std::nan(""));
        added(Eigen::all, kept) = deviations * scales.asDiagonal();
    }
    Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(features, features);
    if (standardised.rows() > 0)
    {
        correlation = pooledCovariance({standardised, degreesOfFreedom_}).matrix;
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

/// Estimates how much each effect raises the scatter, from repeats of runs with that effect alone.
void Emulator::learnScatter()
{
    const Eigen::Index features = study_->featureCount();
    for (std::size_t e = 0; e < study_->effects.size(); ++e)
    {
        SquaresByAmplitude all;
        std::map<std::size_t, SquaresByAmplitude> own; // by condition
        double freedom = 0.0;
        double statistic = 0.0;
        double statisticFreedom = 0.0;
        for (const auto c : learnt_)
        {
            conditions_[c]->logScatter.erase(e);
            const auto& kept = conditions_[c]->features;
            for (const auto& group : repeats(c))
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
                add(all, setting.amplitudes(e), features, kept, ratio, nu);
                add(own[c], setting.amplitudes(e), features, kept, ratio, nu);
                freedom += nu;
                statistic +=
                    conditions_[c]->root.triangularView<Eigen::Lower>().solve(deviations.transpose()).squaredNorm();
                statisticFreedom += nu * static_cast<double>(kept.size());
            }
        }
        if (own.empty())
        {
            continue;
        }
        // An F distribution, because the noise is an estimate too.
        const double freedomOfNoise = std::max(1.0, degreesOfFreedom_ * statisticFreedom / freedom);
        if (!study_->effects[e].raisesScatter
            && probabilityBeyondFisher(statistic / statisticFreedom, statisticFreedom, freedomOfNoise) > otherScatter)
        {
            continue;
        }
        for (const auto& [c, squares] : own)
        {
            const auto& kept = conditions_[c]->features;
            conditions_[c]->logScatter[e] = Eigen::VectorXd::NullaryExpr(
                static_cast<Eigen::Index>(kept.size()), [&, &squares = squares](Eigen::Index k) {
                    const double ofAll = logFactor(all, kept[k]).first;
                    const auto [here, weight] = logFactor(squares, kept[k]);
                    return ofAll + (here - ofAll) * weight / (weight + sharedScatter);
                });
        }
    }
}

} // namespace clepsydra::identification
