#include "emulator/settings.h"

#include <algorithm>

namespace clepsydra::identification
{

Eigen::VectorXd inSds(const Study& study, const Eigen::VectorXd& parameters)
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

} // namespace clepsydra::identification
