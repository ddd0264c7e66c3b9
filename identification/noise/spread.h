#pragma once

#include "noise/noise.h"

#include <random>

namespace clepsydra::identification
{

/// Whether measurements scatter more or less than simulations: a feature of its own, for some effects (cohesion,
/// clogging) change the spread and not the mean.
struct Spread
{
    double ratio = 1.0;  // mean over features of the variance of the data over that of the simulation
    double pValue = 1.0; // two-sided; 1 where one of them has no repeats
};

/// Mean variance ratio tr(S_sim^-1 S_data)/p against its distribution by Monte Carlo, both covariances being drawn anew
/// from one and the same truth.
Spread compareSpread(const Scatter& data, const Scatter& simulation, int draws, std::mt19937_64& random);

} // namespace clepsydra::identification
