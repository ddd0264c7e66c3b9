#pragma once

#include "decision/replicas.h"

#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace clepsydra::identification
{

/// Posterior odds and probabilities, before any threshold is applied.
struct Odds
{
    double logOdds = 0.0; // of any cause against no effect
    /// The test statistic: as `logOdds`, but with each effect at its most likely amplitude. The average over the
    /// amplitude's range depends on how far an effect is from collinear with the parameters; errors of the learnt
    /// effect increase that distance, and they enter the draws twice.
    double statistic = 0.0;
    Eigen::VectorXd effects;    // log probability of each effect, given that there is a cause
    double other = 0.0;         // log probability of an unlisted cause
    Eigen::VectorXd chiSquares; // of each effect at its most likely amplitude, as in `Evidences`
    Eigen::VectorXd scatterChiSquares;
    std::optional<double> chanceOfChiSquare; // as in `Evidences`
    Eigen::VectorXd gains; // log likelihood of each effect at its most likely amplitude over that of no effect
};

/// Thresholds of the decision. They come from synthetic data with the numbers of repeats of this data set (`Replicas`),
/// which need no runs of the simulator.
struct Calibration
{
    std::vector<double> nullStatistics; // of draws without effects, ascending
    double critical = 0.0;              // critical value of the statistic at the study's level
    /// Smallest gain (as in `Odds`) of an effect in the set: one more free number gains as much by chance at the study's
    /// level.
    double leastGain = 0.0;
    // By effect:
    Eigen::VectorXd membership; // log probability that the share `coverage` of its detected draws reaches
    Eigen::VectorXd widths;     // factors on the fit's intervals that give them their nominal coverage
    Eigen::VectorXd chiSquares; // largest chi-square at which the effect still explains the data
    Eigen::VectorXd scatterChiSquares;
    Eigen::VectorXd naming;       // smallest log odds (as in marginOf) at which the effect may be named
    double otherMembership = 0.0; // as `membership`, for an unlisted cause
    /// Share of detected decoys that get a name, counted on draws that did not set the thresholds.
    double wrongNames = 0.0;

    /// Probability, without any effect, of a residual at least as large as that of the data; `leastPValue` at least.
    double pValue(const Odds& odds) const;

    /// A fit of an effect with its interval widened to its nominal coverage.
    Fit widened(std::size_t effect, Fit fit, const Bounds& bounds) const;
};

/// An effect explains data if their means and their scatter fit it as well as its own draws do, within these numbers of
/// standard deviations. The limit for the scatter is tighter, because the scatter of few repeats has a long tail.
constexpr double meansStillFit = 3.0;
constexpr double scatterStillFits = 2.0;

/// An explanation whose log odds are below those of the best by more than this gets no runs near its fit. It is in no
/// set either: its draws, far from all runs, would make any probability look usual.
constexpr double negligibleLogOdds = 8.0;

/// Parameters drawn from a fit [prior standard deviations].
Eigen::VectorXd around(const Fit& fit, std::mt19937_64& random);

/// Parameters drawn from their priors [prior standard deviations], as the draws without an effect have them: data that
/// move them far from there are a residual too (Box, J. R. Stat. Soc. A 143, 383 (1980)).
Eigen::VectorXd fromPrior(const Study& study, std::mt19937_64& random);

/// Amplitude drawn from a distribution and clipped to the effect's range; 1 for a switch.
double drawnAmplitude(const Effect& effect, const Normal& distribution, std::mt19937_64& random);

/// Effects with amplitudes drawn in this way from their fits. \param fits  by effect
std::vector<Present> drawnAmplitudes(
    const Study& study, const std::vector<std::size_t>& effects, const std::vector<Fit>& fits, std::mt19937_64& random);

/// Finds the thresholds from synthetic data without effects, with each effect, and with an unlisted cause.
Calibration calibrate(const Study& study, const Evidence& evidence, Replicas& replicas, const Measured& measured,
    std::mt19937_64& random);

/// Largest chi-square at which an explanation fits as well as the draws that contain it, within a number of standard
/// deviations.
double largestChiSquare(const Evidence& evidence, const std::vector<Odds>& draws, std::size_t explanation, double sds);

/// Sets the membership and the largest chi-squares of an effect or a pair from draws that contain it.
void setLimits(Calibration& calibration, std::size_t explanation, const std::vector<Odds>& draws, const Study& study,
    const Evidence& evidence);

/// Whether the data have a residual beyond noise.
bool isDetected(const Study& study, const Calibration& calibration, const Odds& odds);

/// Log prior weight of an effect. The variants of a family share the weight of one effect.
double logPrior(const Study& study, std::size_t e);

/// Whether two effects are equal or variants of one family.
bool shareName(const Study& study, std::size_t one, std::size_t other);

/// Log odds of an effect with all its variants against all other causes.
double marginOf(const Study& study, const Odds& odds, std::size_t effect);

/// Smallest gain in log likelihood of an explanation that fits better than no effect, at the study's level: that of one
/// more free number (Wilks, Ann. Math. Stat. 9, 60 (1938)).
double leastGain(const Study& study);

/// Why an effect does not belong to the set, whatever its probability is; empty if nothing but its probability decides.
std::string exclusionOf(const Calibration& calibration, const Odds& odds, std::size_t effect);

/// Whether an effect or a pair belongs to the set.
bool isMember(const Calibration& calibration, const Odds& odds, std::size_t explanation);

/// Effects that belong to the set, most probable first.
std::vector<std::size_t> membersOf(const Calibration& calibration, const Odds& odds);

/// The only member of the set, or the most probable one if all members belong to one family; empty if an unlisted cause
/// belongs to the set too.
std::optional<std::size_t> soleMember(const Study& study, const Calibration& calibration, const Odds& odds);

/// Odds of explanations with these log prior weights, and of an unlisted cause.
Odds oddsOf(const Evidences& evidences, const Eigen::VectorXd& logPriors);

/// Odds of all effects. \param without  an effect that is left out of the library
Odds oddsOf(const Study& study, const Evidences& evidences, std::size_t without = static_cast<std::size_t>(-1));

/// Which effects data with these numbers of repeats can show, from synthetic data whose parameters follow their priors.
struct Visibility
{
    // By effect:
    Eigen::VectorXd detected;   // amplitude that is detected in 80 % of the cases; infinite if it is beyond the range
    Eigen::VectorXd named;      // amplitude that is named correctly in 80 % of the cases; infinite if beyond the range
    Eigen::VectorXd atFullSize; // share of correct names at the largest amplitude
    /// Pairs of effects that look alike: at its largest amplitude, most sets of the first effect contain the second.
    std::vector<std::pair<std::size_t, std::size_t>> alike;
};

Visibility visibility(const Study& study, const Evidence& evidence, Replicas& replicas, const Calibration& calibration,
    std::mt19937_64& random);

} // namespace clepsydra::identification
