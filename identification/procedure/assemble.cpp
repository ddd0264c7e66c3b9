#include "procedure/assemble.h"

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

struct Rows
{
    Eigen::VectorXd difference;
    ResidualProblem::Block block;
};

Rows rowsOf(const MeasuredCondition& measured, const Eigen::MatrixXd& simulated, const Sensitivity& sensitivity)
{
    Rows rows{};
    const Eigen::VectorXd difference = meanFeatures(measured.features) - meanFeatures(simulated);
    for (Eigen::Index f = 0; f < difference.size(); ++f)
    {
        if (std::isfinite(difference(f)) && std::isfinite(sensitivity.base(f)))
        {
            rows.block.features.push_back(f);
        }
    }
    const auto& kept = rows.block.features;
    rows.difference = difference(kept);
    rows.block.dataShare = shareOfMean(measured.features)(kept, kept);
    // The fewest seeds that any feature has: failed runs have none.
    double seeds = static_cast<double>(simulated.rows());
    for (const auto f : kept)
    {
        seeds = std::min(seeds, static_cast<double>(simulated.col(f).array().isFinite().count()));
    }
    rows.block.simulationShare = 1.0 / seeds;
    rows.block.knownVariance = measured.declaredError(kept).cwiseAbs2();
    return rows;
}

} // namespace

MeasuredScatter scatterOf(const std::vector<MeasuredCondition>& data, const std::vector<std::size_t>& conditions)
{
    MeasuredScatter scatter;
    for (const auto condition : conditions)
    {
        scatter.repeats.add(data[condition].features);
        scatter.declared = scatter.declared && hasDeclaredErrors(data[condition]);
    }
    return scatter;
}

Eigen::MatrixXd featureRows(const std::vector<Simulation>& simulations, std::size_t condition, Eigen::Index features)
{
    Eigen::MatrixXd rows(std::count_if(simulations.begin(), simulations.end(),
                             [&](const Simulation& simulation) { return simulation.condition == condition; }),
        features);
    Eigen::Index row = 0;
    for (const auto& simulation : simulations)
    {
        if (simulation.condition == condition)
        {
            rows.row(row++) = simulation.features.transpose();
        }
    }
    return rows;
}

ResidualProblem assemble(const Study& study, const EffectLibrary& library, const std::vector<MeasuredCondition>& data,
    const std::vector<Simulation>& simulations, const Eigen::VectorXd& anchorParameters)
{
    std::vector<Rows> parts;
    Eigen::Index count = 0;
    for (const auto condition : study.conditionsOf(Role::training))
    {
        if (data[condition].features.rows() == 0)
        {
            continue;
        }
        Rows rows = rowsOf(
            data[condition], featureRows(simulations, condition, study.featureCount()), library.conditions[condition]);
        if (rows.block.features.empty())
        {
            continue;
        }
        rows.block.condition = condition;
        rows.block.firstRow = count;
        count += rows.difference.size();
        parts.push_back(std::move(rows));
    }
    const auto parameters = static_cast<Eigen::Index>(study.parameters.size());
    const auto effects = static_cast<Eigen::Index>(study.effects.size());
    ResidualProblem problem;
    problem.residual.resize(count);
    problem.parameterColumns.resize(count, parameters);
    problem.effectColumns.resize(count, effects);
    problem.columnShare.resize(static_cast<Eigen::Index>(parts.size()), effects);
    problem.parameterOffset = inPriorSds(study, anchorParameters);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
        const Sensitivity& sensitivity = library.conditions[parts[i].block.condition];
        const auto& kept = parts[i].block.features;
        const auto first = parts[i].block.firstRow;
        const auto size = static_cast<Eigen::Index>(kept.size());
        problem.residual.segment(first, size) = parts[i].difference;
        problem.parameterColumns.middleRows(first, size) = sensitivity.parameterColumns(kept, Eigen::all);
        problem.effectColumns.middleRows(first, size) = sensitivity.effectColumns(kept, Eigen::all);
        problem.columnShare.row(static_cast<Eigen::Index>(i)) = sensitivity.columnShare.transpose();
        problem.blocks.push_back(std::move(parts[i].block));
    }
    return problem;
}

Eigen::VectorXd inPriorSds(const Study& study, const Eigen::VectorXd& parameters)
{
    Eigen::VectorXd result(parameters.size());
    for (Eigen::Index i = 0; i < result.size(); ++i)
    {
        const Parameter& parameter = study.parameters[static_cast<std::size_t>(i)];
        result(i) = (parameters(i) - parameter.mean) / parameter.sd;
    }
    return result;
}

Eigen::VectorXd physical(const Study& study, const Eigen::VectorXd& inSds)
{
    Eigen::VectorXd result(inSds.size());
    for (Eigen::Index i = 0; i < result.size(); ++i)
    {
        const Parameter& parameter = study.parameters[static_cast<std::size_t>(i)];
        result(i) = std::clamp(parameter.mean + inSds(i) * parameter.sd, parameter.lower, parameter.upper);
    }
    return result;
}

} // namespace clepsydra::identification
