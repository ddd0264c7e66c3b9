#include "emulator/settings.h"

#include "lists.h"

#include <algorithm>

namespace clepsydra::identification
{

Eigen::VectorXd inSds(const Study& study, const Eigen::VectorXd& parameters)
{
    return Eigen::VectorXd::NullaryExpr(parameters.size(),
        [&](Eigen::Index i) { return (parameters(i) - study.parameters[i].mean) / study.parameters[i].sd; });
}

Eigen::VectorXd physical(const Study& study, const Eigen::VectorXd& inSds)
{
    return Eigen::VectorXd::NullaryExpr(inSds.size(), [&](Eigen::Index i) {
        const Parameter& parameter = study.parameters[i];
        return std::clamp(parameter.mean + inSds(i) * parameter.sd, parameter.lower, parameter.upper);
    });
}

Eigen::MatrixXd featureRows(const std::vector<Simulation>& simulations, std::size_t condition, Eigen::Index features)
{
    const auto own =
        numbersWhere(simulations.size(), [&](std::size_t i) { return simulations[i].condition == condition; });
    Eigen::MatrixXd rows(own.size(), features);
    for (Eigen::Index row = 0; row < rows.rows(); ++row)
    {
        rows.row(row) = simulations[own[row]].features.transpose();
    }
    return rows;
}

} // namespace clepsydra::identification
