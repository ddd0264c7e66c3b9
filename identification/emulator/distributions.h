#pragma once

namespace clepsydra::identification
{

// Boost's distributions, in one file of ours: they take 4 s to compile.

/// Which value a normal variable of mean 0 and standard deviation 1 exceeds with the probability 1 - `probability`.
double normalQuantile(double probability);

/// The probability that it exceeds `value`.
double probabilityBeyondNormal(double value);

/// The probability that a variable of Fisher's F distribution exceeds `value`.
double probabilityBeyondFisher(double value, double freedom, double freedomOfNoise);

/// Which value it exceeds with that probability.
double fisherValueBeyond(double probability, double freedom, double freedomOfNoise);

/// The derivative of the logarithm of the gamma function.
double digamma(double value);

} // namespace clepsydra::identification
