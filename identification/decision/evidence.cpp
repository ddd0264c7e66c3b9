#include "decision/evidence.h"

#include "emulator/distributions.h"

#include "lists.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clepsydra::identification
{

namespace
{

/// Degrees of freedom of the prior of the factor between the variances of measurements and of simulations: their
/// scatters agree within about 12 %.
constexpr double spreadFreedom = 30.0;

/// Number of amplitudes per effect in the integral: first over the full range, then over the part where the log of the
/// likelihood is above its maximum plus `unlikely`.
constexpr Eigen::Index fineSteps = 64;
constexpr double unlikely = -12.0;

/// Largest number of Gauss-Newton steps for the parameters and of halvings of one step, and the smallest decrease of
/// the chi-square that is followed by one more step. The emulator is nearly linear in the parameters.
constexpr int parameterSteps = 8;
constexpr int halvings = 6;
constexpr double smallestDecrease = 1e-3;

/// Number of iterations for the fit of an effect.
constexpr int refinements = 3;

/// Largest number of nodes that are added for one explanation, and difference between the interpolated and the evaluated
/// log likelihood that needs one more.
constexpr int mostAdded = 24;
constexpr double tolerance = 1.0;

/// Sum of the logs of positive numbers. Groups of numbers are multiplied first, since the logarithm is slow.
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

/// Log of the prior density of amplitudes within an effect's range.
Eigen::ArrayXd logDensity(const Effect& effect, const Eigen::VectorXd& amplitudes, bool usesMeasurement)
{
    const auto [lower, upper] = effect.bounds;
    if (!effect.measured || !usesMeasurement)
    {
        return Eigen::ArrayXd::Constant(amplitudes.size(), -std::log(upper - lower));
    }
    const auto [mean, sd] = *effect.measured;
    const double inRange = probabilityBeyondNormal((lower - mean) / sd) - probabilityBeyondNormal((upper - mean) / sd);
    constexpr double halfLogTwoPi = 0.9189385332046727;
    return -0.5 * ((amplitudes.array() - mean) / sd).square() - (halfLogTwoPi + std::log(sd * inRange));
}

} // namespace

double logSumExp(const Eigen::VectorXd& values)
{
    const double largest = values.maxCoeff();
    return std::isfinite(largest) ? largest + std::log((values.array() - largest).exp().sum()) : largest;
}

double logSpread(double trace, double numbers, double freedom)
{
    return std::lgamma((freedom + numbers) / 2.0) - std::lgamma(freedom / 2.0) + freedom / 2.0 * std::log(freedom / 2.0)
           - (freedom + numbers) / 2.0 * std::log((freedom + trace) / 2.0);
}

double traceOf(const Eigen::MatrixXd& w, const Eigen::MatrixXd& s)
{
    return w.lazyProduct(s).cwiseProduct(w).sum();
}

double logDeterminantOf(const Eigen::LLT<Eigen::MatrixXd>& factor)
{
    return 2.0 * factor.matrixLLT().diagonal().array().log().sum();
}

Evidence::Evidence(const Study& study, const Emulator& emulator, const Layout& layout, const Eigen::VectorXd& around,
    const Places& places)
    : study_(study),
      emulator_(emulator),
      layout_(layout),
      parts_(layout.sharesErrors ? std::vector<Part>{{0, layout.rows}}
                                 : mapped(layout.blocks,
                                     [](const Layout::Block& block) {
                                         return Part{block.first, block.size()};
                                     })),
      around_(around),
      places_(places),
      lower_(study.parameters.size()),
      upper_(study.parameters.size()),
      data_(layout.rows),
      residual_(layout.rows),
      weight_(layout.rows),
      slope_(layout.rows, study.parameters.size()),
      null_(nodeAt({})),
      effects_(study.effects.size())
{
    for (Eigen::Index i = 0; i < lower_.size(); ++i)
    {
        const auto [lower, upper] = study.parameters[i].boundsInSds();
        lower_(i) = lower;
        upper_(i) = upper;
    }
    for (std::size_t e = 0; e < effects_.size(); ++e)
    {
        if (emulator_.knows(e))
        {
            effects_[e] = explanationOf({e});
        }
    }
    prepareOther();
}

void Evidence::transformTo(const Node& node, const Eigen::VectorXd& values, Eigen::VectorXd& transformed) const
{
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
        const auto [first, size] = parts_[p];
        auto part = transformed.segment(first, size);
        part.setZero();
        for (Eigen::Index column = 0; column < size; ++column) // faster than Eigen's product of few numbers
        {
            part += values(first + column) * node.transform[p].col(column);
        }
    }
}

void Evidence::refine(const Measured& measured)
{
    for (std::size_t e = 0; e < effects_.size(); ++e)
    {
        if (!effects_[e].nodes.empty())
        {
            refine({e}, measured);
            effects_[e] = explanationOf({e});
        }
    }
}

void Evidence::refine(const std::vector<std::size_t>& effects, const Measured& measured)
{
    for (int step = 0; step < refinements; ++step)
    {
        const Fit found = fits(explanationOf(effects), measured).front();
        places_[effects] = {found.parameters, found.chiSquare, {}};
    }
    addNodes(effects, measured);
}

/// Where a feature jumps, as at a bounce that begins to reach a level, the chi-square of two neighbouring nodes may
/// differ by orders of magnitude, and the cubic through them falls far below both.
void Evidence::addNodes(const std::vector<std::size_t>& effects, const Measured& measured)
{
    for (int count = 0; count < mostAdded; ++count)
    {
        const Explanation explanation = explanationOf(effects);
        const Judgement found = judge(explanation, measured);
        std::vector<Present> present;
        auto added = places_[effects].added;
        added.resize(effects.size());
        bool isNew = false;
        for (std::size_t k = 0; k < effects.size(); ++k)
        {
            present.push_back({effects[k], found.amplitudes[k]});
            const Eigen::ArrayXd distances = (explanation.grids[k].amplitudes.array() - found.amplitudes[k]).abs();
            if (distances.minCoeff() > 1e-9 * study_.effects[effects[k]].bounds.reach())
            {
                added[k].push_back(found.amplitudes[k]);
                isNew = true;
            }
        }
        const Node node = nodeAt(present);
        const Spread spread = spreadOf(node, measured);
        const Solution there = solve(node, spread.factor, measured);
        const double evaluated = logLikelihood(there.chiSquare, there.logVolume) + spread.logLikelihood;
        if (!isNew || found.peak <= evaluated + tolerance)
        {
            return;
        }
        places_[effects].added = added;
    }
}

const Eigen::VectorXd& Evidence::placeOf(const std::vector<Present>& present) const
{
    std::vector<std::size_t> effects;
    const Place* best = nullptr;
    for (const auto& one : present)
    {
        effects.push_back(one.effect);
        const auto alone = places_.find({one.effect});
        if (alone != places_.end() && (best == nullptr || alone->second.chiSquare < best->chiSquare))
        {
            best = &alone->second;
        }
    }
    const auto together = places_.find(effects);
    return together != places_.end() ? together->second.parameters : best != nullptr ? best->parameters : around_;
}

Node Evidence::nodeAt(const std::vector<Present>& present) const
{
    const Eigen::VectorXd& here = placeOf(present);
    Node node;
    node.extra.resize(layout_.rows);
    node.terms.resize(layout_.rows, parameterTerms(study_.parameters.size()));
    Eigen::MatrixXd allNoise = Eigen::MatrixXd::Zero(layout_.rows, layout_.rows);
    Eigen::MatrixXd allExtra = allNoise;
    for (const auto& block : layout_.blocks)
    {
        const ConditionEmulator& emulator = *emulator_[block.condition];
        const auto& places = block.places;
        const Eigen::MatrixXd single = block.ofOne(emulator, present);
        allNoise.block(block.first, block.first, block.size(), block.size()) = single.cwiseProduct(block.meanShare);
        allExtra.block(block.first, block.first, block.size(), block.size()) =
            Eigen::MatrixXd(emulator.uncertainty(here, present)(places, places)) + block.declared;
        node.terms.middleRows(block.first, block.size()) = emulator.mean(present, here)(places, Eigen::all);
        const Eigen::LLT<Eigen::MatrixXd> factor(single);
        node.whiten.emplace_back(factor.matrixL().solve(Eigen::MatrixXd::Identity(single.rows(), single.rows())));
        node.spreadLogDeterminant += block.freedom > 0.0 ? block.freedom * logDeterminantOf(factor) : 0.0;
        const auto any = [&](auto has) {
            return std::any_of(present.begin(), present.end(),
                [&](const Present& one) { return one.amplitude != 0.0 && has(one.effect); });
        };
        node.scatters.push_back(any([&](std::size_t effect) { return emulator.logScatter.count(effect) > 0; }));
        node.scattersAnywhere = node.scattersAnywhere || any([&](std::size_t e) { return emulator.scatters(e); });
    }
    for (const auto& one : layout_.blocks)
    {
        for (const auto& other : layout_.blocks)
        {
            allExtra.block(one.first, other.first, one.size(), other.size()) += one.shared * other.shared.transpose();
        }
    }
    for (const auto& [first, size] : parts_)
    {
        Eigen::MatrixXd noise = allNoise.block(first, first, size, size);
        const Eigen::MatrixXd extra = allExtra.block(first, first, size, size);
        // The covariance of exact numbers would be singular.
        noise.diagonal() += 1e-9 * (noise + extra).diagonal() + Eigen::VectorXd::Constant(size, 1e-18);
        const Eigen::LLT<Eigen::MatrixXd> factor(noise);
        const Eigen::MatrixXd half = factor.matrixL().solve(Eigen::MatrixXd::Identity(size, size));
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(half * extra * half.transpose());
        node.transform.emplace_back(eigen.eigenvectors().transpose() * half);
        node.extra.segment(first, size) = eigen.eigenvalues().cwiseMax(0.0);
        node.logDeterminant += logDeterminantOf(factor);
        node.terms.middleRows(first, size) = (node.transform.back() * node.terms.middleRows(first, size)).eval();
    }
    return node;
}

Evidence::Explanation Evidence::explanationOf(const std::vector<std::size_t>& effects) const
{
    Explanation explanation{effects, {}, {}};
    std::vector<std::vector<Present>> settings(1);
    const auto place = places_.find(effects);
    const bool hasAdded = place != places_.end() && !place->second.added.empty();
    for (std::size_t k = 0; k < effects.size(); ++k)
    {
        const std::size_t e = effects[k];
        explanation.grids.emplace_back(study_.effects[e], hasAdded ? place->second.added[k] : std::vector<double>{});
        const auto before = std::exchange(settings, {});
        for (const auto& setting : before)
        {
            for (const double amplitude : explanation.grids.back().amplitudes)
            {
                settings.push_back(setting);
                settings.back().push_back({e, amplitude});
            }
        }
    }
    explanation.nodes = mapped(settings, [&](const std::vector<Present>& setting) { return nodeAt(setting); });
    return explanation;
}

Evidence::Spread Evidence::spreadOf(const Node& node, const Measured& measured) const
{
    double trace = 0.0;
    double numbers = 0.0;
    // Of the blocks whose scatter is changed by an effect
    double otherTrace = 0.0;
    double otherNumbers = 0.0;
    for (std::size_t b = 0; b < layout_.blocks.size(); ++b)
    {
        const Layout::Block& block = layout_.blocks[b];
        if (block.freedom > 0.0)
        {
            const double own = traceOf(node.whiten[b], measured.scatter[b]);
            const double ownNumbers = block.freedom * static_cast<double>(block.size());
            trace += own;
            numbers += ownNumbers;
            otherTrace += node.scatters[b] ? own : 0.0;
            otherNumbers += node.scatters[b] ? ownNumbers : 0.0;
        }
    }
    const double chiSquare =
        otherNumbers > 0.0 ? otherTrace - otherNumbers * (1.0 + std::log(std::max(otherTrace, 1e-12) / otherNumbers))
                           : 0.0;
    return {(spreadFreedom + trace) / (spreadFreedom + numbers),
        logSpread(trace, numbers, spreadFreedom) - 0.5 * node.spreadLogDeterminant, chiSquare};
}

Evidence::Solution Evidence::solve(const Node& node, double factor, const Measured& measured) const
{
    const Eigen::Index q = study_.parameters.size();
    Eigen::VectorXd& r = residual_;
    Eigen::ArrayXd& weight = weight_;
    Eigen::MatrixXd& slope = slope_;
    transformTo(node, measured.mean, data_);
    weight = (node.extra.array() + factor).inverse();
    Solution solution;
    solution.parameters.setZero(q);
    FewNumbers& t = solution.parameters;
    const auto residual = [&] {
        r = data_ - node.terms.col(0);
        for (Eigen::Index i = 0; i < q; ++i)
        {
            r -= t(i) * node.terms.col(1 + i);
            for (Eigen::Index j = i; j < q; ++j)
            {
                r -= (t(i) * t(j)) * node.terms.col(parameterTerm(q, i, j));
            }
        }
    };
    const auto chiSquareHere = [&] { return (weight * r.array().square()).sum() + t.squaredNorm(); };
    residual();
    solution.chiSquare = chiSquareHere();
    FewSquare factored;
    double fall = std::numeric_limits<double>::infinity();
    for (int step = 0; q > 0 && step < parameterSteps && fall > smallestDecrease; ++step)
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
        const double before = solution.chiSquare;
        for (int halving = 0; halving < halvings; ++halving, ahead *= 0.5)
        {
            t = inRanges(FewNumbers(from + ahead));
            residual();
            solution.chiSquare = chiSquareHere();
            if (solution.chiSquare <= before)
            {
                break;
            }
        }
        fall = before - solution.chiSquare;
        if (fall < 0.0)
        {
            t = from;
            residual();
            solution.chiSquare = before;
        }
    }
    solution.logVolume = -0.5 * (node.logDeterminant - logProduct(weight));
    for (Eigen::Index i = 0; i < q; ++i)
    {
        solution.logVolume -= std::log(factored(i, i));
    }
    return solution;
}

double Evidence::largestChiSquare(double sds) const
{
    const auto rows = static_cast<double>(layout_.rows);
    return rows * fisherValueBeyond(probabilityBeyondNormal(sds), rows, layout_.noiseFreedom);
}

std::optional<double> Evidence::chanceOfChiSquare(double chiSquare) const
{
    const auto rows = static_cast<double>(layout_.rows);
    return emulator_.scatters() ? std::nullopt
                                : std::optional(probabilityBeyondFisher(chiSquare / rows, rows, layout_.noiseFreedom));
}

/// Likelihood with an estimated covariance: Sellentin & Heavens, Mon. Not. R. Astron. Soc. 456, L132 (2016).
double Evidence::logLikelihood(double chiSquare, double logVolume) const
{
    const double nu = layout_.noiseFreedom;
    return logVolume - 0.5 * (nu + static_cast<double>(layout_.rows)) * std::log1p(chiSquare / nu);
}

Evidence::AtNodes Evidence::atNodes(const Explanation& explanation, const Measured& measured, const Spread& usual) const
{
    const Eigen::Index count = explanation.nodes.size();
    const Eigen::Index columns = explanation.grids.front().amplitudes.size();
    const Eigen::MatrixXd empty(count / columns, columns);
    AtNodes found{empty, empty, empty, Eigen::MatrixXd(study_.parameters.size(), count)};
    for (Eigen::Index i = 0; i < count; ++i)
    {
        const Node& node = explanation.nodes[i];
        const Spread spread = node.scattersAnywhere ? spreadOf(node, measured) : usual;
        const Solution solution = solve(node, spread.factor, measured);
        found.chiSquares(i) = solution.chiSquare;
        found.volumes(i) = solution.logVolume + spread.logLikelihood;
        found.scatterChiSquares(i) = spread.chiSquare;
        found.parameters.col(i) = solution.parameters;
    }
    return found;
}

Evidence::Posterior Evidence::over(
    const Explanation& explanation, const AtNodes& nodes, const std::vector<Bounds>& looked) const
{
    Posterior posterior;
    auto& [first, second] = posterior.axes;
    for (std::size_t k = 0; k < looked.size(); ++k)
    {
        const Effect& effect = study_.effects[explanation.effects[k]];
        if (!effect.isSwitch)
        {
            const auto [lower, upper] = looked[k];
            const double cell = (upper - lower) / static_cast<double>(fineSteps);
            Axis& axis = posterior.axes[k];
            axis.amplitudes = Eigen::VectorXd::LinSpaced(fineSteps, lower + cell / 2.0, upper - cell / 2.0);
            axis.weights = explanation.grids[k].weightsAt(axis.amplitudes);
            axis.logPriors = logDensity(effect, axis.amplitudes, explanation.usesMeasurements) + std::log(cell);
        }
    }
    // The chi-square is interpolated, since it is nearly a parabola in the amplitude; the likelihood may have a peak
    // that is narrower than the distance between nodes.
    const Eigen::MatrixXd chiSquare = posterior.interpolated(nodes.chiSquares);
    const Eigen::MatrixXd volume = posterior.interpolated(nodes.volumes);
    posterior.logs.resize(chiSquare.rows(), chiSquare.cols());
    for (Eigen::Index i = 0; i < chiSquare.size(); ++i)
    {
        posterior.logs(i) = logLikelihood(std::max(0.0, chiSquare(i)), volume(i));
    }
    posterior.logs.colwise() += first.logPriors;
    posterior.logs.rowwise() += second.logPriors.transpose();
    Eigen::Index row = 0;
    Eigen::Index column = 0;
    const double highest = posterior.logs.maxCoeff(&row, &column);
    posterior.judgement = {logSumExp(posterior.logs.reshaped()), chiSquare(row, column),
        posterior.interpolated(nodes.scatterChiSquares)(row, column),
        highest - first.logPriors(row) - second.logPriors(column), {first.amplitudes(row), second.amplitudes(column)}};
    return posterior;
}

Eigen::MatrixXd Evidence::Posterior::interpolated(const Eigen::MatrixXd& atNodes) const
{
    return axes[0].weights * atNodes.transpose() * axes[1].weights.transpose();
}

Evidence::Posterior Evidence::posterior(const Explanation& explanation, const AtNodes& nodes) const
{
    auto ranges = mapped(explanation.effects, [&](std::size_t e) { return study_.effects[e].bounds; });
    const Posterior whole = over(explanation, nodes, ranges);
    const double least = whole.logs.maxCoeff() + unlikely;
    for (std::size_t k = 0; k < ranges.size(); ++k)
    {
        const Eigen::VectorXd along = k == 0 ? Eigen::VectorXd(whole.logs.rowwise().maxCoeff())
                                             : Eigen::VectorXd(whole.logs.colwise().maxCoeff());
        const Eigen::VectorXd& a = whole.axes[k].amplitudes;
        const double margin = a.size() > 1 ? 1.5 * (a(1) - a(0)) : 0.0; // one step beyond the likely part
        const auto [lower, upper] = std::exchange(ranges[k], {ranges[k].upper, ranges[k].lower});
        for (Eigen::Index i = 0; i < a.size(); ++i)
        {
            if (along(i) > least)
            {
                ranges[k].lower = std::max(lower, std::min(ranges[k].lower, a(i) - margin));
                ranges[k].upper = std::min(upper, std::max(ranges[k].upper, a(i) + margin));
            }
        }
    }
    return over(explanation, nodes, ranges);
}

Evidence::Judgement Evidence::judge(const Explanation& explanation, const Measured& measured) const
{
    return posterior(explanation, atNodes(explanation, measured, spreadOf(null_, measured))).judgement;
}

Evidences Evidence::compare(const std::vector<Explanation>& explanations, const Measured& measured) const
{
    const Spread usual = spreadOf(null_, measured);
    const Solution null = solve(null_, usual.factor, measured);
    const Eigen::VectorXd infinite =
        Eigen::VectorXd::Constant(explanations.size(), std::numeric_limits<double>::infinity());
    Evidences evidences{logLikelihood(null.chiSquare, null.logVolume) + usual.logLikelihood, -infinite,
        otherEvidence(measured, usual, null), infinite, infinite, -infinite, chanceOfChiSquare(null.chiSquare)};
    for (std::size_t e = 0; e < explanations.size(); ++e)
    {
        if (!explanations[e].nodes.empty())
        {
            const Judgement found = posterior(explanations[e], atNodes(explanations[e], measured, usual)).judgement;
            evidences.effects(e) = found.logEvidence;
            evidences.chiSquares(e) = found.chiSquare;
            evidences.scatterChiSquares(e) = found.scatterChiSquare;
            evidences.peaks(e) = found.peak;
        }
    }
    return evidences;
}

} // namespace clepsydra::identification
