#pragma once

#include "design/effectLibrary.h"
#include "inference/residualProblem.h"
#include "study/measurements.h"

#include <vector>

namespace clepsydra::identification
{

/// The residual problem at an anchor from measured features, simulations there and the library's columns. Features that
/// the data or the simulation do not have are left out.
/// \param data  by condition of the study; those without repeats are skipped
/// \param simulations  at the anchor, all training conditions
ResidualProblem assemble(const Study& study, const EffectLibrary& library, const std::vector<MeasuredCondition>& data,
    const std::vector<Simulation>& simulations, const Eigen::VectorXd& anchorParameters);

/// Scatter of all measured repeats, and whether every number has a declared error.
struct MeasuredScatter
{
    Scatter repeats;
    bool declared = true;
};

/// \param conditions  which of them: what is held out must not tell the noise
MeasuredScatter scatterOf(const std::vector<MeasuredCondition>& data, const std::vector<std::size_t>& conditions);

/// Features of the simulations of one condition, a row each.
Eigen::MatrixXd featureRows(const std::vector<Simulation>& simulations, std::size_t condition, Eigen::Index features);

Eigen::VectorXd inPriorSds(const Study& study, const Eigen::VectorXd& parameters);
Eigen::VectorXd physical(const Study& study, const Eigen::VectorXd& inSds);

} // namespace clepsydra::identification
