#include "decision/measured.h"

#include "lists.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

/// Degrees of freedom of a declared error, which counts as known.
constexpr double asGoodAsKnown = 1e6;

/// Degrees of freedom of repeats from which the noise is estimated.
constexpr double leastFreedom = 2.0;

/// Requires that each measured feature has an error: without one, every difference from it would be a residual.
/// \param repeats  of all training conditions
void requireErrors(const Study& study, const MeasuredCondition& data, std::size_t condition,
    const std::vector<Eigen::Index>& features, const Scatter& repeats)
{
    const Eigen::VectorXd mean = meanFeatures(data.features);
    for (const auto f : features)
    {
        const auto isSpread = [&](double deviation) {
            return std::isfinite(deviation) && std::abs(deviation) > 1e-12 * std::abs(mean(f));
        };
        const bool scatters = repeats.freedom >= leastFreedom && repeats.deviations.col(f).unaryExpr(isSpread).any();
        if (std::isfinite(mean(f)) && !scatters && data.declaredError(f) == 0.0 && study.modelError(f) == 0.0)
        {
            throw std::runtime_error(study.file.string() + ": condition '" + study.conditions[condition].name + "': '"
                                     + study.features[f].name
                                     + "' would count as exact; allowed: training measurements of it whose repeats "
                                       "differ, a relativeError or standardError of its numbers, or its modelError");
        }
    }
}

/// The repeats of all conditions.
Scatter repeatsOf(const std::vector<MeasuredCondition>& data, const std::vector<std::size_t>& conditions)
{
    Scatter repeats;
    for (const auto c : conditions)
    {
        repeats.add(data[c].features);
    }
    return repeats;
}

} // namespace

Eigen::MatrixXd Layout::Block::ofOne(const ConditionEmulator& here, const std::vector<Present>& present) const
{
    return noise.size() > 0 ? noise : Eigen::MatrixXd(here.noiseOf(present)(places, places));
}

std::vector<std::vector<Eigen::Index>> measuredFeatures(const Study& study, const std::vector<MeasuredCondition>& data)
{
    std::vector<std::vector<Eigen::Index>> features(study.conditions.size());
    for (const auto c : study.conditionsOf(Role::training))
    {
        const Eigen::VectorXd mean = meanFeatures(data[c].features);
        features[c] = numbersWhere(mean.size(), [&](Eigen::Index f) { return std::isfinite(mean(f)); });
    }
    return features;
}

Eigen::VectorXd meanAt(const Emulator& emulator, const Layout& layout, const std::vector<Present>& present,
    const Eigen::VectorXd& parameters)
{
    Eigen::VectorXd mean(layout.rows);
    for (const auto& block : layout.blocks)
    {
        mean.segment(block.first, block.size()) = emulator[block.condition]->at(parameters, present)(block.places);
    }
    return mean;
}

Measured draw(const Layout& layout, const Emulator& truth, const std::vector<Present>& present,
    const Eigen::VectorXd& parameters, const Eigen::VectorXd& around, bool withUncertainty, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    const auto numbers = [&](Eigen::Index rows, Eigen::Index columns) {
        return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); }).eval();
    };
    Measured drawn;
    drawn.mean.resize(layout.rows);
    const Eigen::MatrixXd errors = numbers(layout.blocks.front().shared.cols(), 1);
    for (const auto& block : layout.blocks)
    {
        const ConditionEmulator& here = *truth[block.condition];
        const auto& places = block.places;
        const Eigen::MatrixXd single = block.ofOne(here, present);
        Eigen::MatrixXd ofMean = single.cwiseProduct(block.meanShare) + block.declared;
        if (withUncertainty)
        {
            ofMean += here.uncertainty(around, present)(places, places);
        }
        ofMean.diagonal().array() += 1e-18;
        const Eigen::VectorXd expected = here.mean(present, around) * parameterTermsAt(parameters);
        drawn.mean.segment(block.first, block.size()) =
            expected(places) + block.shared * errors + ofMean.llt().matrixL() * numbers(block.size(), 1);
        const Eigen::MatrixXd deviations =
            block.freedom > 0.0
                ? Eigen::MatrixXd(single.llt().matrixL() * numbers(block.size(), std::lround(block.freedom)))
                : Eigen::MatrixXd::Zero(block.size(), 0);
        drawn.scatter.emplace_back(deviations * deviations.transpose());
    }
    return drawn;
}

Covariance ownNoise(const Study& study, const std::vector<MeasuredCondition>& data,
    const std::vector<std::size_t>& conditions, const Emulator* learnt)
{
    std::vector<std::size_t> measured;
    std::copy_if(conditions.begin(), conditions.end(), std::back_inserter(measured),
        [&](std::size_t c) { return !data[c].isPlanned; });
    const Scatter repeats = repeatsOf(data, measured);
    if (repeats.freedom >= leastFreedom)
    {
        for (const auto c : learnt ? measured : std::vector<std::size_t>{})
        {
            requireErrors(study, data[c], c, (*learnt)[c]->features, repeats);
        }
        return pooledCovariance(repeats);
    }
    if (!std::all_of(measured.begin(), measured.end(), [&](std::size_t c) { return hasDeclaredErrors(data[c]); }))
    {
        throw std::runtime_error("noise cannot be estimated: neither the measurements nor the simulation have repeats "
                                 "(at least two more measurements than conditions are needed, or a relativeError or "
                                 "standardError of every measured value)");
    }
    return {Eigen::MatrixXd::Zero(study.featureCount(), study.featureCount()), asGoodAsKnown};
}

void requireHeldOutErrors(
    const Study& study, const std::vector<MeasuredCondition>& training, const std::vector<MeasuredCondition>& heldOut)
{
    const Scatter repeats = repeatsOf(training, study.conditionsOf(Role::training));
    const auto all = numbersWhere(study.featureCount(), [](Eigen::Index) { return true; });
    for (const auto c : study.conditionsOf(Role::heldOut))
    {
        requireErrors(study, heldOut[c], c, all, repeats);
    }
}

std::pair<Layout, Measured> arrange(const Study& study, const Emulator& emulator,
    const std::vector<MeasuredCondition>& data, const std::vector<Eigen::MatrixXd>& errorSlopes)
{
    Layout layout;
    Measured measured;
    const auto learnt = numbersWhere(data.size(), [&](std::size_t c) { return emulator[c].has_value(); });
    const Covariance noise = emulator.scatters() ? Covariance{emulator.noise(), emulator.degreesOfFreedom()}
                                                 : ownNoise(study, data, learnt, &emulator);
    layout.noiseFreedom = noise.freedom;
    layout.noise = noise.matrix;
    for (const auto c : learnt)
    {
        const auto& known = emulator[c]->features;
        const Eigen::VectorXd all = meanFeatures(data[c].features);
        Layout::Block block;
        block.condition = c;
        block.first = layout.rows;
        block.places =
            numbersWhere<Eigen::Index>(known.size(), [&](Eigen::Index k) { return std::isfinite(all(known[k])); });
        if (block.places.empty())
        {
            continue;
        }
        const auto kept = mapped(block.places, [&](Eigen::Index k) { return known[k]; });
        block.meanShare = shareOfMean(data[c].features)(kept, kept);
        block.declared = Eigen::VectorXd(data[c].declaredError(kept).cwiseAbs2()).asDiagonal();
        block.shared =
            errorSlopes.empty() ? Eigen::MatrixXd(block.size(), 0) : Eigen::MatrixXd(errorSlopes[c](kept, Eigen::all));
        layout.sharesErrors = layout.sharesErrors || block.shared.cols() > 0;
        Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(block.size(), block.size());
        if (emulator.scatters())
        {
            const Eigen::MatrixXd repeats = data[c].features(Eigen::all, kept);
            const auto complete = numbersWhere(
                repeats.rows(), [&](Eigen::Index row) { return repeats.row(row).array().isFinite().all(); });
            const Eigen::MatrixXd rows = repeats(complete, Eigen::all);
            if (rows.rows() > 1)
            {
                const Eigen::MatrixXd deviations = rows.rowwise() - Eigen::RowVectorXd(rows.colwise().mean());
                squares = deviations.transpose() * deviations;
                block.freedom = static_cast<double>(rows.rows()) - 1.0;
            }
        }
        else
        {
            block.noise = noise.matrix(kept, kept);
        }
        layout.rows += block.size();
        measured.mean.conservativeResize(layout.rows);
        measured.mean.tail(block.size()) = all(kept);
        measured.scatter.push_back(std::move(squares));
        layout.blocks.push_back(std::move(block));
    }
    if (layout.rows <= static_cast<Eigen::Index>(study.parameters.size()))
    {
        throw std::runtime_error(study.file.string() + ": measurements and the library's runs have "
                                 + std::to_string(layout.rows)
                                 + " features in common in the training conditions; allowed: more than there are "
                                   "parameters, "
                                 + std::to_string(study.parameters.size()));
    }
    return {layout, measured};
}

} // namespace clepsydra::identification
