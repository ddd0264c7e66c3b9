#pragma once

#include "inference/residualProblem.h"
#include "procedure/traceInputs.h"

namespace clepsydra::identification
{

/// The simulations with effects of the measuring chain at other amplitudes; nothing is run.
std::vector<Simulation> throughChain(
    const TraceInputs& inputs, std::vector<Simulation> simulations, const Eigen::VectorXd& amplitudes);

/// The problem at simulations of a setting. Of the effects given, the columns of those of the measuring chain are taken
/// at their amplitudes, from these very curves; all others are the library's.
ResidualProblem problemAt(const TraceInputs& inputs, const std::vector<Simulation>& simulations, const Setting& setting,
    const std::vector<std::size_t>& effects);

/// Physical parameters after a shift from a problem's anchor [prior sd], within their limits.
Eigen::VectorXd shifted(const Study& study, const ResidualProblem& problem, const Eigen::VectorXd& shift);

} // namespace clepsydra::identification
