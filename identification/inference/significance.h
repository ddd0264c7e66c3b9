#pragma once

#include "inference/residualProblem.h"

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace clepsydra::identification
{

/// Range of an effect's amplitude.
struct Bounds
{
    double lower = 0.0;
    double upper = 1.0;

    /// The largest size, to either side.
    double reach() const
    {
        return std::max(upper, -lower);
    }
};

/// Whether the residual exceeds noise.
struct Significance
{
    double omnibus = 0.0;       // T0: sum of squares that the parameters leave
    double omnibusPValue = 1.0; // share of draws without any effect that leave as much
    double bestGain = 0.0;      // D: what the best single effect takes off T0
    double bestGainPValue = 1.0;
    double pValue = 1.0;             // of both together: share of draws in which the smaller p-value is as small
    double bestGainCritical = 0.0;   // D above which the p-value falls below .05
    std::vector<double> misfitLimit; // per effect: its misfit is below this in 99 % of the cases that it explains
    double nullMisfitLimit = 0.0;    // the same for none
    double noticed = 0.0; // what a pattern of any shape takes off the misfit if that is to be above its limit
                          // in 80 % of the cases
};

/// Omnibus and max-T test. Both distributions by Monte Carlo: in each draw the residual is noise, the covariance is
/// estimated anew from as many repeats, and every fit is repeated.
///
/// The p-value of the pair is calibrated itself (minimum of two p-values against its own distribution), so that the
/// test has its nominal level; two tests at .025 each would have less, for they go together.
Significance significance(const ResidualProblem& problem, const Noise& noise, const std::vector<Bounds>& bounds,
    int draws, std::mt19937_64& random);

/// The same problem with a residual that is noise and nothing else.
ResidualProblem noiseOnly(const ResidualProblem& problem, const Noise& noise, std::mt19937_64& random);

/// T0 and D of a problem.
std::pair<double, double> testStatistics(const Fits& fits, const std::vector<Bounds>& bounds);

} // namespace clepsydra::identification
