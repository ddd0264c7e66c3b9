#include "design/effectLibrary.h"

#include "design/plackettBurman.h"
#include "study/measurements.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace clepsydra::identification
{

namespace
{

/// Common seeds pay where the variance of a difference falls by more than this.
constexpr double usefulCorrelation = 0.3;

/// A parameter is moved by this many prior sd, to either side in the design and up in the repeats.
constexpr double parameterStep = 1.0;

/// Index of the effects that change the simulation of a condition.
std::vector<Eigen::Index> simulatedEffects(const Study& study, std::size_t condition)
{
    std::vector<Eigen::Index> found;
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        if (!study.effects[e].isOfChain() && acts(study.effects[e], study.conditions[condition]))
        {
            found.push_back(static_cast<Eigen::Index>(e));
        }
    }
    return found;
}

DesignKind designOf(const Study& study)
{
    if (study.settings.design != DesignKind::automatic)
    {
        return study.settings.design;
    }
    // Without noise nothing is averaged out; then changing one thing at a time has no interactions in it.
    return study.rig.seedEntry.empty() ? DesignKind::oneAtATime : DesignKind::plackettBurman;
}

double moved(const Parameter& parameter, double sds)
{
    return std::clamp(parameter.mean + sds * parameter.sd, parameter.lower, parameter.upper);
}

double inPriorSds(const Parameter& parameter, double value)
{
    return (value - parameter.mean) / parameter.sd;
}

std::vector<SimulationOrder> repeatOrders(const Simulator& simulator)
{
    const Study& study = simulator.study();
    const bool scatters = !study.rig.seedEntry.empty();
    std::vector<SimulationOrder> orders;
    for (const auto condition : study.conditionsOf(Role::training))
    {
        const Setting base = simulator.plainSetting();
        for (int number = 0; number < (scatters ? study.settings.repeatsBase : 1); ++number)
        {
            orders.push_back({condition, base, "repeats", number});
            // The same seeds at a neighbouring setting: more repeats, and whether seeds have anything in common.
            if (scatters && !study.parameters.empty())
            {
                Setting neighbour = base;
                neighbour.parameters(0) = moved(study.parameters.front(), parameterStep);
                orders.push_back({condition, neighbour, "repeats", number});
            }
        }
    }
    return orders;
}

std::vector<SimulationOrder> plackettBurmanOrders(const Simulator& simulator, std::size_t condition)
{
    const Study& study = simulator.study();
    const auto effects = simulatedEffects(study, condition);
    const auto parameters = static_cast<Eigen::Index>(study.parameters.size());
    const Eigen::MatrixXd design = plackettBurman(parameters + static_cast<Eigen::Index>(effects.size()));
    std::vector<SimulationOrder> orders;
    for (Eigen::Index row = 0; row < design.rows(); ++row)
    {
        Setting setting = simulator.plainSetting();
        for (Eigen::Index p = 0; p < parameters; ++p)
        {
            setting.parameters(p) =
                moved(study.parameters[static_cast<std::size_t>(p)], parameterStep * design(row, p));
        }
        for (std::size_t k = 0; k < effects.size(); ++k)
        {
            const Effect& effect = study.effects[static_cast<std::size_t>(effects[k])];
            const bool high = design(row, parameters + static_cast<Eigen::Index>(k)) > 0.0;
            setting.amplitudes(effects[k]) = high ? effect.bounds.upper : effect.bounds.lower;
        }
        orders.push_back({condition, setting, "design", static_cast<int>(row)});
    }
    return orders;
}

std::vector<SimulationOrder> oneAtATimeOrders(const Simulator& simulator, std::size_t condition)
{
    const Study& study = simulator.study();
    std::vector<SimulationOrder> orders;
    const auto add = [&](const Setting& setting) {
        orders.push_back({condition, setting, "design", static_cast<int>(orders.size())});
    };
    for (std::size_t p = 0; p < study.parameters.size(); ++p)
    {
        for (const double side : {-1.0, 1.0})
        {
            Setting setting = simulator.plainSetting();
            setting.parameters(static_cast<Eigen::Index>(p)) = moved(study.parameters[p], side * parameterStep);
            add(setting);
        }
    }
    for (const auto e : simulatedEffects(study, condition))
    {
        const Effect& effect = study.effects[static_cast<std::size_t>(e)];
        Setting setting = simulator.plainSetting();
        for (const double amplitude : {effect.bounds.lower, effect.bounds.upper})
        {
            if (amplitude != 0.0)
            {
                setting.amplitudes(e) = amplitude;
                add(setting);
            }
        }
    }
    return orders;
}

std::vector<SimulationOrder> designOrders(const Simulator& simulator)
{
    std::vector<SimulationOrder> orders;
    for (const auto condition : simulator.study().conditionsOf(Role::training))
    {
        const auto more = designOf(simulator.study()) == DesignKind::plackettBurman
                              ? plackettBurmanOrders(simulator, condition)
                              : oneAtATimeOrders(simulator, condition);
        orders.insert(orders.end(), more.begin(), more.end());
    }
    return orders;
}

/// Runs of one condition with their settings.
struct Group
{
    std::vector<Setting> settings;
    std::vector<bool> ofDesign;
    std::vector<Simulation> simulations;
};

/// Correlation of runs with one seed at two settings, pooled over conditions and features, with its standard error.
void measureSeedCorrelation(
    EffectLibrary& library, const std::vector<Eigen::MatrixXd>& base, const std::vector<Eigen::MatrixXd>& neighbour)
{
    double products = 0.0;
    double squares = 0.0;
    double pairs = 0.0;
    for (std::size_t c = 0; c < base.size(); ++c)
    {
        for (Eigen::Index f = 0; f < base[c].cols(); ++f)
        {
            const Eigen::ArrayXd a = base[c].col(f).array() - base[c].col(f).mean();
            const Eigen::ArrayXd b = neighbour[c].col(f).array() - neighbour[c].col(f).mean();
            const double size = std::sqrt(a.square().sum() * b.square().sum());
            if (std::isfinite(size) && size > 0.0)
            {
                products += (a * b).sum() / size;
                squares += 1.0;
            }
        }
        pairs += static_cast<double>(base[c].rows()) - 1.0;
    }
    library.seedCorrelation = squares > 0.0 ? products / squares : 0.0;
    // Features of one run go together: count runs, not features.
    library.seedCorrelationError = pairs > 0.0 ? 1.0 / std::sqrt(pairs) : 1.0;
}

Eigen::MatrixXd rowsOf(const std::vector<Eigen::VectorXd>& rows, Eigen::Index columns)
{
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()), columns);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        matrix.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
    }
    return matrix;
}

/// One row per run: 1, 1 if it is of the design, parameters in prior sd, amplitudes. The second keeps the curvature
/// between the base and the middle of the design out of the columns.
Eigen::MatrixXd regressors(
    const Study& study, const Group& group, const std::vector<Eigen::Index>& effects, bool designHasBase)
{
    const auto parameters = static_cast<Eigen::Index>(study.parameters.size());
    const Eigen::Index first = designHasBase ? 1 : 2;
    Eigen::MatrixXd x = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(group.settings.size()),
        first + parameters + static_cast<Eigen::Index>(effects.size()));
    for (Eigen::Index row = 0; row < x.rows(); ++row)
    {
        const auto i = static_cast<std::size_t>(row);
        x(row, 0) = 1.0;
        if (!designHasBase)
        {
            x(row, 1) = group.ofDesign[i] ? 1.0 : 0.0;
        }
        for (Eigen::Index p = 0; p < parameters; ++p)
        {
            x(row, first + p) =
                inPriorSds(study.parameters[static_cast<std::size_t>(p)], group.settings[i].parameters(p));
        }
        for (std::size_t k = 0; k < effects.size(); ++k)
        {
            x(row, first + parameters + static_cast<Eigen::Index>(k)) = group.settings[i].amplitudes(effects[k]);
        }
    }
    return x;
}

/// With the square of every factor that was moved to both sides. Where one thing is changed at a time, curvature of one
/// factor would otherwise shift the base, and with it every effect that goes to one side only.
Eigen::MatrixXd withCurvature(const Eigen::MatrixXd& x, Eigen::Index firstFactor)
{
    Eigen::MatrixXd extended = x;
    for (Eigen::Index column = firstFactor; column < x.cols(); ++column)
    {
        if (x.col(column).minCoeff() < 0.0 && x.col(column).maxCoeff() > 0.0)
        {
            extended.conservativeResize(Eigen::NoChange, extended.cols() + 1);
            extended.rightCols<1>() = x.col(column).cwiseAbs2();
        }
    }
    return extended;
}

/// Columns that are zero in all rows: effects whose every run has failed.
std::vector<Eigen::Index> silentColumns(const Eigen::MatrixXd& x)
{
    std::vector<Eigen::Index> silent;
    for (Eigen::Index column = 0; column < x.cols(); ++column)
    {
        if (x.col(column).isZero())
        {
            silent.push_back(column);
        }
    }
    return silent;
}

/// Least squares over all runs of a condition, feature by feature, for runs that failed leave gaps.
/// \param rho  correlation of the design's runs, which share a seed or not
/// \return the effects of which no run is left
std::vector<Eigen::Index> fitColumns(const Study& study, const Group& group, const std::vector<Eigen::Index>& effects,
    bool designHasBase, double rho, Sensitivity& sensitivity)
{
    Eigen::MatrixXd x = regressors(study, group, effects, designHasBase);
    const auto parameters = static_cast<Eigen::Index>(study.parameters.size());
    const Eigen::Index first = designHasBase ? 1 : 2;
    for (Eigen::Index row = 0; row < x.rows(); ++row)
    {
        if (group.simulations[static_cast<std::size_t>(row)].failed)
        {
            x.row(row).setZero();
        }
    }
    const auto silent = silentColumns(x);
    for (Eigen::Index f = 0; f < study.featureCount(); ++f)
    {
        std::vector<Eigen::Index> rows;
        std::vector<double> values;
        for (Eigen::Index row = 0; row < x.rows(); ++row)
        {
            const double value = group.simulations[static_cast<std::size_t>(row)].features(f);
            if (std::isfinite(value))
            {
                rows.push_back(row);
                values.push_back(value);
            }
        }
        if (!std::isfinite(sensitivity.base(f)))
        {
            continue;
        }
        const Eigen::MatrixXd linear = x(rows, Eigen::all);
        const Eigen::MatrixXd xf = designHasBase ? withCurvature(linear, first) : linear;
        // Of least norm: what has no run left gets no change.
        const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(xf);
        if (decomposition.rank() + static_cast<Eigen::Index>(silent.size()) < xf.cols())
        {
            throw std::runtime_error("too many runs of the design have failed: the effects on feature '"
                                     + study.features[static_cast<std::size_t>(f)].name
                                     + "' cannot be told apart any more");
        }
        const Eigen::Map<const Eigen::VectorXd> measured(values.data(), xf.rows());
        // What changes nothing has a column of zeros, not of rounding, which any amplitude would fit.
        const double rounding = 1e-11 * measured.cwiseAbs().maxCoeff();
        const Eigen::VectorXd solution = decomposition.solve(measured).unaryExpr(
            [=](double change) { return std::abs(change) < rounding ? 0.0 : change; });
        const Eigen::MatrixXd inverse = (xf.transpose() * xf).completeOrthogonalDecomposition().pseudoInverse();
        sensitivity.parameterColumns.row(f) = solution.segment(first, parameters).transpose();
        for (std::size_t k = 0; k < effects.size(); ++k)
        {
            const Eigen::Index place = first + parameters + static_cast<Eigen::Index>(k);
            sensitivity.effectColumns(f, effects[k]) = solution(place);
            double& share = sensitivity.columnShare(effects[k]);
            share = std::max(share, (1.0 - rho) * inverse(place, place));
        }
    }
    std::vector<Eigen::Index> lost;
    for (const auto column : silent)
    {
        if (column >= first + parameters)
        {
            lost.push_back(effects[static_cast<std::size_t>(column - first - parameters)]);
        }
    }
    return lost;
}

/// Effects of the measuring chain: the base curves once more, through the chain.
void chainColumns(const Simulator& simulator, const std::vector<Simulation>& base, Sensitivity& sensitivity)
{
    const Study& study = simulator.study();
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        const Effect& effect = study.effects[e];
        if (!effect.isOfChain() || base.empty() || !acts(effect, study.conditions[base.front().condition]))
        {
            continue;
        }
        std::vector<Eigen::VectorXd> changes;
        for (const auto& simulation : base)
        {
            Eigen::VectorXd amplitudes = simulator.plainSetting().amplitudes;
            const auto at = [&](double amplitude) {
                amplitudes(static_cast<Eigen::Index>(e)) = amplitude;
                return simulator.featuresOf(simulator.throughChain(simulation.plain, simulation.condition, amplitudes));
            };
            const auto [lower, upper] = effect.bounds;
            changes.emplace_back((at(upper) - at(lower)) / (upper - lower));
        }
        const Eigen::VectorXd mean = meanFeatures(rowsOf(changes, study.featureCount()));
        sensitivity.effectColumns.col(static_cast<Eigen::Index>(e)) = mean.array().isFinite().select(mean, 0.0);
    }
}

} // namespace

std::vector<SimulationOrder> libraryOrders(const Simulator& simulator)
{
    auto orders = repeatOrders(simulator);
    const auto design = designOrders(simulator);
    orders.insert(orders.end(), design.begin(), design.end());
    return orders;
}

EffectLibrary makeLibrary(Simulator& simulator)
{
    const Study& study = simulator.study();
    const auto features = study.featureCount();
    EffectLibrary library;
    library.design = designOf(study);
    library.conditions.resize(study.conditions.size());

    const auto repeats = repeatOrders(simulator);
    const auto repeated = simulator.run(repeats);
    std::vector<Eigen::MatrixXd> bases;
    std::vector<Eigen::MatrixXd> neighbours;
    std::vector<Group> groups(study.conditions.size());
    std::vector<std::vector<Simulation>> baseRuns(study.conditions.size());
    for (const auto condition : study.conditionsOf(Role::training))
    {
        std::vector<Eigen::VectorXd> base;
        std::vector<Eigen::VectorXd> neighbour;
        for (std::size_t i = 0; i < repeats.size(); ++i)
        {
            if (repeats[i].condition != condition)
            {
                continue;
            }
            const bool isBase = repeats[i].setting.parameters == simulator.plainSetting().parameters;
            (isBase ? base : neighbour).push_back(repeated[i].features);
            if (isBase && !repeated[i].failed)
            {
                baseRuns[condition].push_back(repeated[i]);
            }
            groups[condition].settings.push_back(repeats[i].setting);
            groups[condition].simulations.push_back(repeated[i]);
            groups[condition].ofDesign.push_back(false);
        }
        bases.push_back(rowsOf(base, features));
        library.scatter.add(bases.back());
        if (!neighbour.empty())
        {
            neighbours.push_back(rowsOf(neighbour, features));
            library.scatter.add(neighbours.back());
        }
        library.conditions[condition].baseFeatures = bases.back();
        library.conditions[condition].base = meanFeatures(bases.back());
        // Before the many runs of the design.
        if (!library.conditions[condition].base.array().isFinite().any())
        {
            throw std::runtime_error("condition '" + study.conditions[condition].name
                                     + "': all runs at the base setting have failed"
                                     + (simulator.failures().empty() ? "" : ": " + simulator.failures().back().reason));
        }
    }
    if (neighbours.size() == bases.size())
    {
        measureSeedCorrelation(library, bases, neighbours);
        library.commonSeeds = library.seedCorrelation - 2.0 * library.seedCorrelationError > usefulCorrelation;
    }

    auto design = designOrders(simulator);
    for (auto& order : design)
    {
        if (library.commonSeeds)
        {
            order.seeds = "common";
            order.number = 0;
        }
    }
    const auto designed = simulator.run(design);
    for (std::size_t i = 0; i < design.size(); ++i)
    {
        Group& group = groups[design[i].condition];
        group.settings.push_back(design[i].setting);
        group.simulations.push_back(designed[i]);
        group.ofDesign.push_back(true);
    }
    for (const auto condition : study.conditionsOf(Role::training))
    {
        Sensitivity& sensitivity = library.conditions[condition];
        const auto parameters = static_cast<Eigen::Index>(study.parameters.size());
        const auto effects = static_cast<Eigen::Index>(study.effects.size());
        sensitivity.parameterColumns = Eigen::MatrixXd::Zero(features, parameters);
        sensitivity.effectColumns = Eigen::MatrixXd::Zero(features, effects);
        sensitivity.columnShare = Eigen::VectorXd::Zero(effects);
        const auto lost = fitColumns(study, groups[condition], simulatedEffects(study, condition),
            library.design == DesignKind::oneAtATime, library.commonSeeds ? library.seedCorrelation : 0.0, sensitivity);
        for (const auto e : lost)
        {
            library.remarks.push_back("effect " + study.effects[static_cast<std::size_t>(e)].name
                                      + " is not known in condition " + study.conditions[condition].name
                                      + ": all its runs have failed");
        }
        chainColumns(simulator, baseRuns[condition], sensitivity);
    }
    return library;
}

} // namespace clepsydra::identification
