#pragma once

#include "decision/replicas.h"

#include <optional>
#include <random>
#include <vector>

namespace clepsydra::identification
{

/// What evidences amount to, before any threshold.
struct Odds
{
    double logOdds = 0.0; // of anything against no effect
    /// Of the test: the same with each effect at its likeliest amplitude. What an amplitude's range costs hangs on how far an
    /// effect is from what the parameters do, which errors of its learnt columns enlarge: in draws, whose columns are learnt
    /// from what was learnt, twice.
    double statistic = 0.0;
    Eigen::VectorXd effects;    // log probability of each, given that there is something
    double other = 0.0;         // the same of something else
    Eigen::VectorXd chiSquares; // of each effect where it is likeliest, as in `Evidences`
    Eigen::VectorXd scatterChiSquares;
    std::optional<double> chanceOfChiSquare; // as in `Evidences`
};

/// Thresholds of the decision, from trials in known worlds with this data set's own numbers of repeats: no runs.
struct Calibration
{
    std::vector<double> nullStatistics; // of draws without any effect, ascending
    double critical = 0.0;              // of the statistic, at the study's level
    // By effect:
    Eigen::VectorXd membership; // the share `coverage` of its detected draws has this log probability or more
    Eigen::VectorXd widths;     // of intervals that hold the amplitude as often as they say, over those of the fit
    Eigen::VectorXd chiSquares; // what fits worse than this is not explained by it
    Eigen::VectorXd scatterChiSquares;
    Eigen::VectorXd naming;       // log odds, as of marginOf, above which it may be a name
    double otherMembership = 0.0; // as membership, for what is not in the library
    double wrongNames = 0.0;      // of detected decoys, at these thresholds

    double pValue(const Odds& odds) const;

    /// A fit of an effect with the interval that holds its amplitude as often as it says.
    Fit widened(std::size_t effect, Fit fit, const Bounds& bounds) const;
};

/// What chiSquares, sums of squares, stay below but for chance: standard deviations above the mean of the draws' cube roots,
/// which are all but normal (Wilson & Hilferty, PNAS 17, 684 (1931)).
double chiSquareLimit(const std::vector<double>& draws, double sds);

/// An effect explains data whose means, and whose scatter, fit it as well as its own draws do, within these [sd]. The scatter
/// of few repeats has a long tail, behind which an effect that does not raise it would hide.
constexpr double meansStillFit = 3.0;
constexpr double scatterStillFits = 2.0;

/// What is less likely than the best by more than this (log odds) gets no runs near its fit. Where runs do not scatter it is in
/// no set either: draws of it, from where no run was made, would make any probability seem usual.
constexpr double hopeless = 8.0;

/// Parameters that a fit leaves possible [prior sd].
Eigen::VectorXd around(const Fit& fit, std::mt19937_64& random);

/// The value that a share of the draws stays below; the observed set counts as one more draw.
double upperQuantile(std::vector<double> values, double share);

class Calibrator
{
public:
    Calibrator(const Study& study, const Evidence& evidence, Replicas& replicas, const Measured& measured,
        std::mt19937_64& random);

    Calibration calibrate();

private:
    struct Draw
    {
        std::size_t truth; // effect; their number: something else
        Odds odds;
        Odds without; // the same, with the truth not in the library
    };

    void drawNull();
    void drawEffects();
    void drawOther();
    void setMembership();
    void setNaming();

    const Study& study_;
    const Evidence& evidence_;
    Replicas& replicas_;
    const Measured& measured_;
    std::mt19937_64& random_;
    std::vector<Draw> detected_;
    Calibration calibration_;
};

/// Whether there is anything beyond noise.
bool isDetected(const Study& study, const Calibration& calibration, const Odds& odds);

/// Log weight of an effect: variants of one thing share it.
double logPrior(const Study& study, std::size_t e);

/// Whether two effects are variants of one thing.
bool areVariants(const Study& study, std::size_t one, std::size_t other);

/// Log odds of an effect, in all its variants together, against all else.
double marginOf(const Study& study, const Odds& odds, std::size_t effect);

/// Effects that a set holds, most likely first.
std::vector<std::size_t> membersOf(const Calibration& calibration, const Odds& odds);

/// The only member, or the most likely one of a family that all members belong to; none where something else may be it.
std::optional<std::size_t> soleMember(const Study& study, const Calibration& calibration, const Odds& odds);

/// \param without  an effect that the library is to lack
Odds oddsOf(const Study& study, const Evidences& evidences, std::size_t without = static_cast<std::size_t>(-1));

} // namespace clepsydra::identification
