#include "decision/evidence.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace clepsydra::identification
{

namespace
{

/// Measurements scatter as simulations do within some 12 %: degrees of freedom of the prior of their common factor.
constexpr double spreadFreedom = 30.0;

/// The same for something else, each condition by itself, and how likely that is to scatter in a way of its own.
constexpr double otherSpreadFreedom = 3.0;
constexpr double otherSpreadShare = 0.3;

/// Amplitudes that are integrated over.
constexpr Eigen::Index fineSteps = 512;

/// Of amplitudes of pairs, from end to end.
constexpr int pairSteps = 8;

/// Gauss-Newton steps for the parameters at most, how often one is halved, and the fall of the misfit that is still
/// worth one more: the emulator is all but linear in them.
constexpr int parameterSteps = 8;
constexpr int halvings = 6;
constexpr double worthAStep = 1e-3;

/// Something else acts on features of one condition, and on one feature in all conditions, in like ways to this extent.
constexpr double alikeFeatures = 0.5;
constexpr double alikeConditions = 0.3;

/// Log density of sums of squares about a common factor of the variance with an inverse gamma prior; what all
/// explanations share is left out.
double logSpread(double trace, double numbers, double freedom)
{
    return std::lgamma((freedom + numbers) / 2.0) - std::lgamma(freedom / 2.0) + freedom / 2.0 * std::log(freedom / 2.0)
           - (freedom + numbers) / 2.0 * std::log((freedom + trace) / 2.0);
}

/// Trace of w s w'.
double traceOf(const Eigen::MatrixXd& w, const Eigen::MatrixXd& s)
{
    return w.lazyProduct(s).cwiseProduct(w).sum();
}

/// Sum of the logs of positive numbers, with few calls of the logarithm.
double logProduct(const Eigen::ArrayXd& values)
{
    constexpr Eigen::Index atOnce = 8;
    double sum = 0.0;
    for (Eigen::Index first = 0; first < values.size(); first += atOnce)
    {
        sum += std::log(values.segment(first, std::min(atOnce, values.size() - first)).prod());
    }
    return sum;
}

} // namespace

double logSumExp(const Eigen::VectorXd& values)
{
    const double largest = values.maxCoeff();
    return std::isfinite(largest) ? largest + std::log((values.array() - largest).exp().sum()) : largest;
}

const std::vector<double>& Evidence::sizes()
{
    static const std::vector<double> all = {0.15, 0.3, 0.6, 1.2};
    return all;
}

Evidence::Evidence(const Study& study, const Emulator& emulator, const Layout& layout, const Eigen::VectorXd& around)
    : study_(study),
      emulator_(emulator),
      layout_(layout),
      around_(around),
      aroundEffects_(study.effects.size(), around),
      workspace_{Eigen::VectorXd(layout.rows), Eigen::VectorXd(layout.rows), Eigen::ArrayXd(layout.rows),
          Eigen::MatrixXd(layout.rows, static_cast<Eigen::Index>(study.parameters.size()))},
      null_(nodeAt({})),
      effects_(study.effects.size())
{
    if (static_cast<Eigen::Index>(study.parameters.size()) > FewNumbers::MaxRowsAtCompileTime)
    {
        throw std::runtime_error(study.file.string() + ": there are " + std::to_string(study.parameters.size())
                                 + " parameters; allowed: " + std::to_string(FewNumbers::MaxRowsAtCompileTime));
    }
    prepare();
}

void Evidence::prepare()
{
    const auto q = static_cast<Eigen::Index>(study_.parameters.size());
    lower_.resize(q);
    upper_.resize(q);
    for (Eigen::Index i = 0; i < q; ++i)
    {
        const Parameter& parameter = study_.parameters[static_cast<std::size_t>(i)];
        lower_(i) = (parameter.lower - parameter.mean) / parameter.sd;
        upper_(i) = (parameter.upper - parameter.mean) / parameter.sd;
    }
    for (std::size_t e = 0; e < effects_.size(); ++e)
    {
        if (emulator_.knows(e))
        {
            effects_[e] = explanationOf(e);
        }
    }
    prepareOther();
}

Evidence::Evidence(const Evidence& like, const Emulator& emulator)
    : study_(like.study_),
      emulator_(emulator),
      layout_(like.layout_),
      around_(like.around_),
      aroundEffects_(like.aroundEffects_),
      workspace_(like.workspace_),
      null_(nodeAt({})),
      effects_(like.effects_.size())
{
    prepare();
}

void Evidence::refine(const Measured& measured)
{
    for (std::size_t e = 0; e < effects_.size(); ++e)
    {
        if (!effects_[e].nodes.empty())
        {
            aroundEffects_[e] = fit(e, measured).parameters;
            effects_[e] = explanationOf(e);
        }
    }
}

Node Evidence::nodeAt(const std::vector<Present>& present) const
{
    const Eigen::VectorXd& here = present.size() == 1 ? aroundEffects_[present.front().effect] : around_;
    Node node;
    node.present = present;
    node.extra.resize(layout_.rows);
    node.terms.resize(layout_.rows, parameterTerms(static_cast<Eigen::Index>(study_.parameters.size())));
    for (const auto& block : layout_.blocks)
    {
        const ConditionEmulator& emulator = *emulator_[block.condition];
        const auto& places = block.places;
        const Eigen::MatrixXd single =
            block.noise.size() > 0 ? block.noise : Eigen::MatrixXd(emulator.noiseOf(present)(places, places));
        Eigen::MatrixXd noise = single.cwiseProduct(block.meanShare);
        const Eigen::MatrixXd extra =
            Eigen::MatrixXd(emulator.uncertainty(here, present)(places, places)) + block.common;
        // What is exact to the last digit could not be inverted.
        noise.diagonal() += 1e-9 * (noise + extra).diagonal() + Eigen::VectorXd::Constant(noise.rows(), 1e-18);
        const Eigen::LLT<Eigen::MatrixXd> factor(noise);
        const Eigen::MatrixXd half = factor.matrixL().solve(Eigen::MatrixXd::Identity(noise.rows(), noise.rows()));
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(half * extra * half.transpose());
        node.transform.emplace_back(eigen.eigenvectors().transpose() * half);
        node.extra.segment(block.first, block.size()) = eigen.eigenvalues().cwiseMax(0.0);
        node.logDeterminant += 2.0 * factor.matrixLLT().diagonal().array().log().sum();
        node.terms.middleRows(block.first, block.size()) =
            node.transform.back() * emulator.mean(present)(places, Eigen::all);
        if (block.freedom > 0.0)
        {
            const Eigen::LLT<Eigen::MatrixXd> one(single);
            node.whiten.emplace_back(one.matrixL().solve(Eigen::MatrixXd::Identity(single.rows(), single.rows())));
            node.spreadLogDeterminant += block.freedom * 2.0 * one.matrixLLT().diagonal().array().log().sum();
        }
        else
        {
            node.whiten.emplace_back(Eigen::MatrixXd::Zero(single.rows(), single.rows()));
        }
        for (const auto& [effect, amplitude] : present)
        {
            node.scatters = node.scatters || (amplitude != 0.0 && emulator.scatters(effect));
        }
    }
    return node;
}

Evidence::Explanation Evidence::explanationOf(std::size_t e) const
{
    const Effect& effect = study_.effects[e];
    Explanation explanation;
    if (effect.isSwitch)
    {
        explanation.nodes.push_back(nodeAt({{e, 1.0}}));
        explanation.amplitudes = Eigen::VectorXd::Ones(1);
        explanation.interpolation = Eigen::MatrixXd::Ones(1, 1);
        explanation.logWeights = Eigen::VectorXd::Zero(1);
        return explanation;
    }
    const Grid grid(effect);
    for (const double amplitude : grid.amplitudes())
    {
        explanation.nodes.push_back(nodeAt({{e, amplitude}}));
    }
    const auto [lower, upper] = effect.bounds;
    explanation.amplitudes.resize(fineSteps);
    explanation.interpolation.resize(fineSteps, grid.amplitudes().size());
    explanation.logWeights = Eigen::VectorXd::Constant(fineSteps, -std::log(static_cast<double>(fineSteps)));
    for (Eigen::Index i = 0; i < fineSteps; ++i)
    {
        explanation.amplitudes(i) = lower + (upper - lower) * (static_cast<double>(i) + 0.5) / fineSteps;
        explanation.interpolation.row(i) = grid.weightsAt(explanation.amplitudes(i));
    }
    return explanation;
}

Evidence::Spread Evidence::spreadOf(const Node& node, const Measured& measured) const
{
    double trace = 0.0;
    double numbers = 0.0;
    for (std::size_t b = 0; b < layout_.blocks.size(); ++b)
    {
        const Layout::Block& block = layout_.blocks[b];
        if (block.freedom > 0.0)
        {
            trace += traceOf(node.whiten[b], measured.scatter[b]);
            numbers += block.freedom * static_cast<double>(block.size());
        }
    }
    return {(spreadFreedom + trace) / (spreadFreedom + numbers),
        logSpread(trace, numbers, spreadFreedom) - 0.5 * node.spreadLogDeterminant};
}

double Evidence::otherSpread(const Measured& measured) const
{
    double sum = -0.5 * null_.spreadLogDeterminant;
    for (std::size_t b = 0; b < layout_.blocks.size(); ++b)
    {
        const Layout::Block& block = layout_.blocks[b];
        if (block.freedom > 0.0)
        {
            const double trace = traceOf(null_.whiten[b], measured.scatter[b]);
            sum += logSpread(trace, block.freedom * static_cast<double>(block.size()), otherSpreadFreedom);
        }
    }
    return sum;
}

Evidence::Solution Evidence::solve(const Node& node, double factor, const Measured& measured) const
{
    const auto q = static_cast<Eigen::Index>(study_.parameters.size());
    // This runs a million times for one data set: no memory is asked for.
    Eigen::VectorXd& y = workspace_.data;
    Eigen::VectorXd& r = workspace_.residual;
    Eigen::ArrayXd& weight = workspace_.weight;
    Eigen::MatrixXd& slope = workspace_.slope;
    for (std::size_t b = 0; b < layout_.blocks.size(); ++b)
    {
        const Layout::Block& block = layout_.blocks[b];
        y.segment(block.first, block.size()) =
            node.transform[b].lazyProduct(measured.mean.segment(block.first, block.size()));
    }
    weight = (node.extra.array() + factor).inverse();
    Solution solution;
    solution.parameters.setZero(q);
    FewNumbers& t = solution.parameters;
    const auto residual = [&] {
        r = y - node.terms.col(0);
        for (Eigen::Index i = 0; i < q; ++i)
        {
            r -= t(i) * node.terms.col(1 + i);
            for (Eigen::Index j = i; j < q; ++j)
            {
                r -= (t(i) * t(j)) * node.terms.col(parameterTerm(q, i, j));
            }
        }
    };
    const auto misfitHere = [&] { return (weight * r.array().square()).sum() + t.squaredNorm(); };
    residual();
    solution.misfit = misfitHere();
    FewSquare factored;
    double fall = std::numeric_limits<double>::infinity();
    for (int step = 0; q > 0 && step < parameterSteps && fall > worthAStep; ++step)
    {
        FewNumbers direction(q);
        for (Eigen::Index i = 0; i < q; ++i)
        {
            slope.col(i) = node.terms.col(1 + i);
            for (Eigen::Index j = 0; j < q; ++j)
            {
                slope.col(i) += ((i == j ? 2.0 : 1.0) * t(j)) * node.terms.col(parameterTerm(q, i, j));
            }
            direction(i) = (slope.col(i).array() * weight * r.array()).sum() - t(i);
        }
        solution.precision.setIdentity(q, q);
        for (Eigen::Index i = 0; i < q; ++i)
        {
            for (Eigen::Index j = 0; j <= i; ++j)
            {
                solution.precision(i, j) += (slope.col(i).array() * weight * slope.col(j).array()).sum();
                solution.precision(j, i) = solution.precision(i, j);
            }
        }
        const Eigen::LLT<FewSquare> cholesky(solution.precision);
        factored = cholesky.matrixLLT();
        FewNumbers ahead = cholesky.solve(direction);
        const FewNumbers from = t;
        const double before = solution.misfit;
        for (int halving = 0; halving < halvings; ++halving, ahead *= 0.5)
        {
            t = (from + ahead).cwiseMax(lower_).cwiseMin(upper_);
            residual();
            solution.misfit = misfitHere();
            if (solution.misfit <= before)
            {
                break;
            }
        }
        fall = before - solution.misfit;
        if (fall < 0.0)
        {
            t = from;
            residual();
            solution.misfit = before;
        }
    }
    solution.logVolume = -0.5 * (node.logDeterminant - logProduct(weight));
    for (Eigen::Index i = 0; i < q; ++i)
    {
        solution.logVolume -= std::log(factored(i, i));
    }
    return solution;
}

/// The covariance is an estimate: Sellentin & Heavens, Mon. Not. R. Astron. Soc. 456, L132 (2016).
double Evidence::logLikelihood(double misfit, double logVolume) const
{
    const double nu = layout_.noiseFreedom;
    return logVolume - 0.5 * (nu + static_cast<double>(layout_.rows)) * std::log1p(misfit / nu);
}

Evidence::Posterior Evidence::posterior(
    const Explanation& explanation, const Measured& measured, const Spread& usual) const
{
    // Misfits are all but parabolas in the amplitude, which a cubic follows from node to node however narrow the peak of the
    // likelihood is; the likelihood itself it would not.
    Eigen::MatrixXd nodes(static_cast<Eigen::Index>(explanation.nodes.size()), 2);
    for (Eigen::Index i = 0; i < nodes.rows(); ++i)
    {
        const Node& node = explanation.nodes[static_cast<std::size_t>(i)];
        const Spread spread = node.scatters ? spreadOf(node, measured) : usual;
        const Solution solution = solve(node, spread.factor, measured);
        nodes.row(i) << solution.misfit, solution.logVolume + spread.logLikelihood;
    }
    const Eigen::MatrixXd fine = explanation.interpolation * nodes;
    Eigen::VectorXd logs = explanation.logWeights;
    for (Eigen::Index i = 0; i < logs.size(); ++i)
    {
        logs(i) += logLikelihood(std::max(0.0, fine(i, 0)), fine(i, 1));
    }
    Eigen::Index best = 0;
    logs.maxCoeff(&best);
    return {logs, fine(best, 0)};
}

Evidences Evidence::operator()(const Measured& measured) const
{
    Evidences evidences;
    const Spread usual = spreadOf(null_, measured);
    const Solution null = solve(null_, usual.factor, measured);
    evidences.null = logLikelihood(null.misfit, null.logVolume) + usual.logLikelihood;
    evidences.effects.setConstant(
        static_cast<Eigen::Index>(effects_.size()), -std::numeric_limits<double>::infinity());
    evidences.misfits.setConstant(evidences.effects.size(), std::numeric_limits<double>::infinity());
    for (std::size_t e = 0; e < effects_.size(); ++e)
    {
        if (!effects_[e].nodes.empty())
        {
            const Posterior found = posterior(effects_[e], measured, usual);
            evidences.effects(static_cast<Eigen::Index>(e)) = logSumExp(found.logs);
            evidences.misfits(static_cast<Eigen::Index>(e)) = found.misfit;
        }
    }
    evidences.other = otherEvidence(measured, usual, null);
    return evidences;
}

//--- Something else -------------------------------------------------------------------------------------------------

void Evidence::prepareOther()
{
    const Eigen::Index n = layout_.rows;
    const auto q = static_cast<Eigen::Index>(study_.parameters.size());
    // What the library's effects do to each feature at full size, root mean square over effects and conditions.
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(study_.featureCount());
    Eigen::VectorXd counts = squares;
    for (const auto& block : layout_.blocks)
    {
        const ConditionEmulator& emulator = *emulator_[block.condition];
        const Eigen::VectorXd base = emulator.mean({}).col(0);
        for (std::size_t e = 0; e < study_.effects.size(); ++e)
        {
            if (emulator_.knows(e) && acts(study_.effects[e], study_.conditions[block.condition]))
            {
                const Eigen::VectorXd change = emulator.mean({{e, study_.effects[e].bounds.upper}}).col(0) - base;
                for (const auto place : block.places)
                {
                    const auto f = emulator.features[static_cast<std::size_t>(place)];
                    squares(f) += change(place) * change(place);
                    counts(f) += 1.0;
                }
            }
        }
    }
    const Eigen::VectorXd typical = squares.cwiseQuotient(counts.cwiseMax(1.0)).cwiseSqrt();
    Eigen::MatrixXd pattern(n, n);
    Eigen::MatrixXd transform = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t a = 0; a < layout_.blocks.size(); ++a)
    {
        const Layout::Block& one = layout_.blocks[a];
        transform.block(one.first, one.first, one.size(), one.size()) = null_.transform[a];
        for (const auto& other : layout_.blocks)
        {
            for (Eigen::Index i = 0; i < one.size(); ++i)
            {
                for (Eigen::Index j = 0; j < other.size(); ++j)
                {
                    const auto f = emulator_[one.condition]
                                       ->features[static_cast<std::size_t>(one.places[static_cast<std::size_t>(i)])];
                    const auto g = emulator_[other.condition]
                                       ->features[static_cast<std::size_t>(other.places[static_cast<std::size_t>(j)])];
                    pattern(one.first + i, other.first + j) =
                        typical(f) * typical(g) * (f == g ? 1.0 : alikeFeatures)
                        * (one.condition == other.condition ? 1.0 : alikeConditions);
                }
            }
        }
    }
    pattern = transform * pattern * transform.transpose();
    const Eigen::VectorXd usual = null_.extra.array() + 1.0;
    const Eigen::MatrixXd slope = null_.terms.middleCols(1, q);
    if (q > 0)
    {
        const Eigen::MatrixXd weighted = usual.cwiseInverse().asDiagonal() * slope;
        const Eigen::MatrixXd projection =
            Eigen::MatrixXd::Identity(n, n) - slope * (slope.transpose() * weighted).ldlt().solve(weighted.transpose());
        pattern = projection * pattern * projection.transpose();
    }
    const double rounding = 1e-9 * std::max(pattern.diagonal().maxCoeff(), 1e-12);
    otherRoot_ = (pattern + rounding * Eigen::MatrixXd::Identity(n, n)).llt().matrixL();
    for (const double size : sizes())
    {
        Eigen::MatrixXd covariance = size * size * pattern + slope * slope.transpose();
        covariance.diagonal() += usual;
        const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
        other_.push_back({factor.matrixL(), 2.0 * factor.matrixLLT().diagonal().array().log().sum()});
    }
}

double Evidence::otherEvidence(const Measured& measured, const Spread& usual, const Solution& null) const
{
    const auto q = static_cast<Eigen::Index>(study_.parameters.size());
    // Linear in the parameters from where the null fits.
    Eigen::VectorXd r = -(null_.terms * parameterTermsAt(Eigen::VectorXd(null.parameters)));
    for (std::size_t b = 0; b < layout_.blocks.size(); ++b)
    {
        const Layout::Block& block = layout_.blocks[b];
        r.segment(block.first, block.size()).noalias() +=
            null_.transform[b] * measured.mean.segment(block.first, block.size());
    }
    r += null_.terms.middleCols(1, q) * Eigen::VectorXd(null.parameters);
    const double nu = layout_.noiseFreedom;
    const double rows = static_cast<double>(layout_.rows);
    // A set that scatters in a way of its own has a noise of its own; the means are then known as well as its repeats say.
    Eigen::VectorXd logs(static_cast<Eigen::Index>(other_.size()));
    for (Eigen::Index i = 0; i < logs.size(); ++i)
    {
        const Discrepancy& one = other_[static_cast<std::size_t>(i)];
        const double misfit = one.root.triangularView<Eigen::Lower>().solve(r).squaredNorm() / usual.factor;
        logs(i) = -0.5 * (nu + rows) * std::log1p(misfit / nu)
                  - 0.5 * (one.logDeterminant + rows * std::log(usual.factor) + null_.logDeterminant);
    }
    const double pattern = logSumExp(logs) - std::log(static_cast<double>(other_.size()));
    const Eigen::Vector2d spread(
        std::log(1.0 - otherSpreadShare) + usual.logLikelihood, std::log(otherSpreadShare) + otherSpread(measured));
    return pattern + logSumExp(spread);
}

//--- Fits -----------------------------------------------------------------------------------------------------------

std::vector<double> Evidence::amplitudes(std::size_t effect) const
{
    std::vector<double> all;
    for (const auto& node : effects_[effect].nodes)
    {
        all.push_back(node.present.front().amplitude);
    }
    return all;
}

Fit Evidence::fitNull(const Measured& measured) const
{
    const Solution solution = solve(null_, spreadOf(null_, measured).factor, measured);
    Fit fit;
    fit.parameters = solution.parameters;
    fit.covariance = solution.parameters.size() > 0 ? Eigen::MatrixXd(solution.precision.inverse()) : Eigen::MatrixXd();
    fit.misfit = solution.misfit;
    return fit;
}

Fit Evidence::fit(std::size_t effect, const Measured& measured) const
{
    const Explanation& explanation = effects_[effect];
    Fit fit;
    if (explanation.nodes.empty())
    {
        return fit;
    }
    const Spread usual = spreadOf(null_, measured);
    const Eigen::VectorXd logs = posterior(explanation, measured, usual).logs;
    const Eigen::ArrayXd share = (logs.array() - logSumExp(logs)).exp();
    const Eigen::ArrayXd a = explanation.amplitudes.array();
    fit.amplitude = (share * a).sum();
    fit.sd = std::sqrt(std::max(0.0, (share * (a - fit.amplitude).square()).sum()));
    constexpr double tail = 0.025;
    const double half = a.size() > 1 ? (a(1) - a(0)) / 2.0 : 0.0;
    double below = 0.0;
    fit.lower = a(0) - half;
    fit.upper = a(a.size() - 1) + half;
    for (Eigen::Index i = 0; i < a.size(); ++i)
    {
        // Linear within a step of the grid.
        const double after = below + share(i);
        if (below < tail && after >= tail)
        {
            fit.lower = a(i) - half + 2.0 * half * (tail - below) / share(i);
        }
        if (below < 1.0 - tail && after >= 1.0 - tail)
        {
            fit.upper = a(i) - half + 2.0 * half * (1.0 - tail - below) / share(i);
        }
        below = after;
    }
    const Node node = nodeAt({{effect, fit.amplitude}});
    const Solution solution = solve(node, spreadOf(node, measured).factor, measured);
    fit.parameters = solution.parameters;
    fit.covariance = solution.parameters.size() > 0 ? Eigen::MatrixXd(solution.precision.inverse()) : Eigen::MatrixXd();
    fit.misfit = solution.misfit;
    return fit;
}

Evidence::Pair Evidence::pair(std::size_t one, std::size_t other, const Measured& measured) const
{
    const auto amplitudes = [&](std::size_t e) {
        const Effect& effect = study_.effects[e];
        std::vector<double> all;
        for (int i = 0; i < pairSteps; ++i)
        {
            all.push_back(effect.bounds.lower + (effect.bounds.upper - effect.bounds.lower) * (i + 0.5) / pairSteps);
        }
        return effect.isSwitch ? std::vector<double>{1.0} : all;
    };
    Pair best;
    std::vector<double> logs;
    double largest = best.logEvidence;
    for (const double a : amplitudes(one))
    {
        for (const double b : amplitudes(other))
        {
            const Node node = nodeAt({{one, a}, {other, b}});
            const Spread spread = spreadOf(node, measured);
            const Solution solution = solve(node, spread.factor, measured);
            logs.push_back(logLikelihood(solution.misfit, solution.logVolume) + spread.logLikelihood);
            if (logs.back() > largest)
            {
                largest = logs.back();
                best.first = a;
                best.second = b;
                best.parameters = solution.parameters;
            }
        }
    }
    best.logEvidence = logSumExp(Eigen::Map<const Eigen::VectorXd>(logs.data(), static_cast<Eigen::Index>(logs.size())))
                       - std::log(static_cast<double>(logs.size()));
    return best;
}

Eigen::VectorXd Evidence::drawOther(double size, std::mt19937_64& random) const
{
    std::normal_distribution<double> normal;
    Eigen::VectorXd pattern =
        size * otherRoot_ * Eigen::VectorXd::NullaryExpr(layout_.rows, [&] { return normal(random); });
    for (std::size_t b = 0; b < layout_.blocks.size(); ++b)
    {
        auto own = pattern.segment(layout_.blocks[b].first, layout_.blocks[b].size());
        own = null_.transform[b].partialPivLu().solve(Eigen::VectorXd(own)).eval();
    }
    return pattern;
}

} // namespace clepsydra::identification
