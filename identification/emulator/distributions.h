#pragma once

namespace clepsydra::identification
{

// Boost's distributions are used in one file only, because their headers take 4 s to compile.

/// Quantile of the standard normal distribution: a variable is below the result with this probability.
double normalQuantile(double probability);

/// Probability that a standard normal variable exceeds `value`.
double probabilityBeyondNormal(double value);

/// Probability that a variable of Fisher's F distribution exceeds `value`.
/// \param freedom, freedomOfNoise  degrees of freedom of numerator and denominator
double probabilityBeyondFisher(double value, double freedom, double freedomOfNoise);

/// The value that a variable of Fisher's F distribution exceeds with this probability.
double fisherValueBeyond(double probability, double freedom, double freedomOfNoise);

/// Smallest p-value that is given. Errors are not normal so far from their mean, and a smaller number would say more
/// than is known.
constexpr double leastPValue = 1e-6;

/// Derivative of the logarithm of the gamma function.
double digamma(double value);

} // namespace clepsydra::identification
