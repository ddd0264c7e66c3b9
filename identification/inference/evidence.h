#pragma once

#include "inference/significance.h"

#include <random>

namespace clepsydra::identification
{

/// What the data say for one effect, or a pair of them.
struct Score
{
    double amplitude = 0.0; // of the effect, not the step from the anchor
    double sd = 0.0;
    double misfit = 0.0;
    double logEvidence = 0.0;       // marginal over amplitude and parameters, without prior odds
    Eigen::VectorXd parameterShift; // from the anchor, in prior sd
};

/// Log-likelihood of a misfit where the covariance has been estimated: a multivariate t (Sellentin & Heavens, Mon. Not.
/// R. Astron. Soc. 456, L132 (2016), with the scale uncertain to nu degrees of freedom); -misfit/2 for many.
double logLikelihood(double misfit, double nu, Eigen::Index rows);

/// Degrees of freedom that stand behind the covariance of a residual.
double effectiveDegreesOfFreedom(const Noise& noise);

/// How many standard errors a 95 % interval reaches to either side: Student's t for the degrees of freedom.
double intervalSds(const Noise& noise);

/// Log evidence of no effect.
double nullEvidence(const ResidualProblem& problem, const Noise& noise);

/// Score of one effect. The prior of its amplitude is uniform within its bounds: what it could have explained and does
/// not need counts against it (Occam factor). The uncertainty of the effect's column widens the noise.
/// \param anchorAmplitude  the effect's amplitude in the simulation that the residual is taken from
/// \param fixed  an effect that is on or off: amplitude 1
Score score(const ResidualProblem& problem, const Noise& noise, Eigen::Index effect, const Bounds& bounds,
    double anchorAmplitude = 0.0, bool fixed = false);

/// Log evidence of "something else": any pattern over features and conditions of the size that the library's effects
/// have.
double otherEvidence(const ResidualProblem& problem, const Noise& noise);

/// Two effects at once.
struct PairScore
{
    Eigen::Index first = 0;
    Eigen::Index second = 0;
    double firstAmplitude = 0.0;
    double secondAmplitude = 0.0;
    double misfit = 0.0;
    double logEvidence = 0.0;
    Eigen::VectorXd parameterShift;
};

/// All pairs, the one with the largest evidence first. The uncertainty of their columns widens the noise.
/// \param anchor  amplitudes in the simulation of the residual
std::vector<PairScore> pairScores(const ResidualProblem& problem, const Noise& noise, const std::vector<Bounds>& bounds,
    const std::vector<bool>& fixed, const Eigen::VectorXd& anchor);

} // namespace clepsydra::identification
