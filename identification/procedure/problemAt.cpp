#include "procedure/problemAt.h"

#include "procedure/assemble.h"

#include <algorithm>

namespace clepsydra::identification
{

namespace
{

constexpr double smallAmplitude = 0.02; // for derivatives

} // namespace

std::vector<Simulation> throughChain(
    const TraceInputs& inputs, std::vector<Simulation> simulations, const Eigen::VectorXd& amplitudes)
{
    for (auto& simulation : simulations)
    {
        if (!simulation.failed)
        {
            simulation.curve = inputs.simulator.throughChain(simulation.plain, simulation.condition, amplitudes);
            simulation.features = inputs.simulator.featuresOf(simulation.curve);
        }
    }
    return simulations;
}

ResidualProblem problemAt(const TraceInputs& inputs, const std::vector<Simulation>& simulations, const Setting& setting,
    const std::vector<std::size_t>& effects)
{
    const auto assembled = [&](const std::vector<Simulation>& at) {
        return assemble(inputs.study, inputs.library, inputs.data, at, setting.parameters);
    };
    ResidualProblem problem = assembled(simulations);
    for (const std::size_t e : effects)
    {
        if (!inputs.study.effects[e].isOfChain())
        {
            continue;
        }
        const auto column = static_cast<Eigen::Index>(e);
        const Bounds& bounds = inputs.study.effects[e].bounds;
        Eigen::VectorXd lower = setting.amplitudes;
        Eigen::VectorXd upper = setting.amplitudes;
        lower(column) = std::max(lower(column) - smallAmplitude, bounds.lower);
        upper(column) = std::min(upper(column) + smallAmplitude, bounds.upper);
        const auto below = assembled(throughChain(inputs, simulations, lower));
        const auto above = assembled(throughChain(inputs, simulations, upper));
        if (below.residual.size() == problem.residual.size() && above.residual.size() == problem.residual.size())
        {
            problem.effectColumns.col(column) = (below.residual - above.residual) / (upper(column) - lower(column));
        }
    }
    return problem;
}

Eigen::VectorXd shifted(const Study& study, const ResidualProblem& problem, const Eigen::VectorXd& shift)
{
    return physical(study, problem.parameterOffset + shift);
}

} // namespace clepsydra::identification
