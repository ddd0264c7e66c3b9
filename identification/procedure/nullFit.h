#pragma once

#include "procedure/traceInputs.h"
#include "inference/residualProblem.h"

namespace clepsydra::identification
{

/// The parameters fitted without any effect, and the simulator run there.
struct NullFit
{
    ResidualProblem problem;             // at the last simulation
    ResidualProblem atBase;              // at the prior's means
    std::vector<Simulation> simulations; // the last ones
    Setting setting;                     // where the fit ended
    double misfit = 0.0;
    Eigen::VectorXd parameterSd; // in prior sd

    /// The problems from which effects may be scored: at the fit, and, where that has gone so far that the library's
    /// columns, taken at the base setting, may not hold there, at the base setting. A large effect that is left out does
    /// so; with the effect the parameters are nearer to the base setting again.
    std::vector<const ResidualProblem*> anchors() const;
};

/// Linear fit on the library, simulation at the fit, fit again: the test must not see the library's curvature.
/// \throws std::runtime_error where fewer features than parameters are left
NullFit fitNull(const TraceInputs& inputs, const Noise& noise);

} // namespace clepsydra::identification
