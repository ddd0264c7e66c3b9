#pragma once

#include "decision/measured.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <array>
#include <map>
#include <optional>
#include <random>
#include <vector>

namespace clepsydra::identification
{

/// Log evidence of each explanation: the likelihood averaged over the parameters (normal prior), the amplitude (uniform
/// prior in its range, or its measurement cut off there) and the emulator's error.
struct Evidences
{
    double null = 0.0;
    Eigen::VectorXd effects; // by effect of the study, or by pair; -infinity if all runs of an effect have failed
    double other = 0.0;      // of an unlisted cause
    // Of each effect or pair at its most likely amplitudes:
    Eigen::VectorXd chiSquares;        // of the means, as in `Fit`
    Eigen::VectorXd scatterChiSquares; // of the spread between repeats, if the effect changes it
    Eigen::VectorXd peaks;             // log likelihood
    /// Probability that noise alone makes the null fit's chi-square as large; only if runs do not scatter.
    std::optional<double> chanceOfChiSquare = std::nullopt;
};

/// Best fit of an explanation, with its uncertainty.
struct Fit
{
    double amplitude = 0.0; // posterior mean; 1 for a switch
    double sd = 0.0;        // posterior standard deviation
    double lower = 0.0;     // limits of the central 95 % of the posterior
    double upper = 0.0;
    bool isAtEnd = false;       // whether the most likely amplitude is an end of the range
    Eigen::VectorXd parameters; // standardised with their priors
    Eigen::MatrixXd covariance; // of the parameters at this amplitude
    Eigen::MatrixXd marginal;   // of the parameters over all amplitudes
    double chiSquare = 0.0;     // sum of squares in units of the noise, including the parameters' priors
};

/// One explanation at one amplitude, with all quantities that do not depend on the measured values. They are expressed
/// in coordinates in which the noise of the means has unit variance and the other covariance is diagonal.
struct Node
{
    std::vector<Eigen::MatrixXd> transform; // into these coordinates, by part of the rows
    std::vector<Eigen::MatrixXd> whiten;    // inverse Cholesky factor of one measurement's noise, by block
    Eigen::VectorXd extra;                  // variances in addition to the noise
    Eigen::MatrixXd terms;                  // rows x parameterTerms
    double logDeterminant = 0.0;            // of the noise covariance of the means
    double spreadLogDeterminant = 0.0;      // of the noise of single measurements, times their degrees of freedom
    std::vector<bool> scatters;             // by block: whether the effects change the scatter of simulations
    bool scattersAnywhere = false;          // whether simulations or measuring chain change the scatter in any block
};

/// Evidence of explanations for data of one layout, according to one emulator.
///
/// Noise: measurements scatter like simulations of the same setting, up to a common factor near 1 that the spread
/// between repeats determines. The same spread distinguishes the effects that raise the scatter.
///
/// Unlisted cause: a Gaussian discrepancy over conditions and features whose size is a multiple of that of the
/// library's effects, orthogonal to the parameters (Plumlee, J. Am. Stat. Assoc. 112, 1274 (2017)), or repeats with a
/// scatter of their own.
class Evidence
{
public:
    /// \param around  parameters [prior standard deviations] at which the emulator's uncertainty is taken
    Evidence(const Study& study, const Emulator& emulator, const Layout& layout, const Eigen::VectorXd& around)
        : Evidence(study, emulator, layout, around, {})
    {}

    /// The same explanations according to another emulator.
    Evidence(const Evidence& like, const Emulator& emulator)
        : Evidence(like.study_, emulator, like.layout_, like.around_, like.places_)
    {}

    /// Evaluates the emulator for each effect (or for several at once) near the parameters that fit best with it, which
    /// may be far from those of the null fit. Where the chi-square that is interpolated between the nodes has a minimum
    /// that is not there when it is evaluated, nodes are added.
    void refine(const Measured& measured);
    void refine(const std::vector<std::size_t>& effects, const Measured& measured);

    /// Upper limit of the chi-square of the true explanation, at the tail probability of a number of standard
    /// deviations of a normal distribution.
    double largestChiSquare(double sds) const;

    /// Probability that noise alone makes the chi-square as large; empty if runs scatter, because then synthetic data
    /// give it.
    std::optional<double> chanceOfChiSquare(double chiSquare) const;

    Evidences operator()(const Measured& measured) const
    {
        return compare(effects_, measured);
    }

    /// Best fit without effects, and with one effect.
    Fit fitNull(const Measured& measured) const;
    Fit fit(std::size_t effect, const Measured& measured) const;
    /// The same without the independent measurement of the amplitude.
    Fit fitAlone(std::size_t effect, const Measured& measured) const;

    /// One or two effects, with nodes at amplitudes over their ranges.
    struct Explanation
    {
        std::vector<std::size_t> effects;
        std::vector<Grid> grids;      // by effect
        std::vector<Node> nodes;      // the last effect's amplitude varies fastest
        bool usesMeasurements = true; // of amplitudes, as their priors
    };
    Explanation explanationOf(const std::vector<std::size_t>& effects) const;
    /// As for the library's effects, but of other explanations.
    Evidences compare(const std::vector<Explanation>& explanations, const Measured& measured) const;

    struct Judgement
    {
        double logEvidence = 0.0;
        double chiSquare = 0.0; // at the most likely amplitudes, as in `Evidences`
        double scatterChiSquare = 0.0;
        double peak = 0.0;                  // log likelihood at the most likely amplitudes
        std::array<double, 2> amplitudes{}; // the most likely ones, by effect
    };
    Judgement judge(const Explanation& explanation, const Measured& measured) const;
    /// Fits of the explanation's effects, by effect. Their parameters are equal.
    std::vector<Fit> fits(const Explanation& explanation, const Measured& measured) const;

    /// Equidistant amplitudes over the range of an effect; empty if all its runs have failed.
    std::vector<double> amplitudes(std::size_t effect) const;

    Node nodeAt(const std::vector<Present>& present) const;

    /// Parameters clipped to their ranges.
    template<typename Parameters>
    Parameters inRanges(const Parameters& parameters) const
    {
        return parameters.cwiseMax(lower_).cwiseMin(upper_);
    }

    /// Parameters near which the emulator is evaluated for effects. For a pair that was not refined these are the
    /// parameters of the effect that fits better.
    const Eigen::VectorXd& placeOf(const std::vector<Present>& present) const;

    /// Draws the discrepancy of an unlisted cause, to be added to the means. \param size  multiple of the library's
    /// effects
    Eigen::VectorXd drawOther(double size, std::mt19937_64& random) const;

    /// Sizes of the unlisted cause, as multiples of the library's effects.
    static constexpr std::array<double, 4> sizes = {0.15, 0.3, 0.6, 1.2};

private:
    struct Spread
    {
        double factor = 1.0; // on the noise's variance
        double logLikelihood = 0.0;
        double chiSquare = 0.0; // deviance of the scatter in the blocks where effects change it
    };

    using FewNumbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, mostParameters, 1>;
    using FewSquare = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, mostParameters, mostParameters>;

    struct Solution
    {
        FewNumbers parameters;
        FewSquare precision;
        double chiSquare = 0.0;
        double logVolume = 0.0; // the part of the log likelihood that does not depend on the chi-square
    };

    /// Parameters that fit an explanation.
    struct Place
    {
        Eigen::VectorXd parameters;
        double chiSquare = 0.0;
        std::vector<std::vector<double>> added; // amplitudes of nodes beside the equidistant ones, by effect
    };

    using Places = std::map<std::vector<std::size_t>, Place>; // by the effects that are switched on

    Evidence(const Study& study, const Emulator& emulator, const Layout& layout, const Eigen::VectorXd& around,
        const Places& places);

    void prepareOther();
    void addNodes(const std::vector<std::size_t>& effects, const Measured& measured);
    Spread spreadOf(const Node& node, const Measured& measured) const;
    double otherSpread(const Measured& measured) const;
    Solution solve(const Node& node, double factor, const Measured& measured) const;
    void fitParameters(const Node& node, const Measured& measured, Fit& fit) const;
    double logLikelihood(double chiSquare, double logVolume) const;

    /// Amplitudes of one effect; a single one for a switch and for the second effect where there is only one.
    struct Axis
    {
        Eigen::VectorXd amplitudes = Eigen::VectorXd::Ones(1); // equidistant
        Eigen::MatrixXd weights = Eigen::MatrixXd::Ones(1, 1); // interpolation weights of the nodes
        Eigen::VectorXd logPriors = Eigen::VectorXd::Zero(1);  // log probability of each amplitude's cell
    };

    /// Posterior over the likely amplitudes of the first and of the second effect.
    struct Posterior
    {
        std::array<Axis, 2> axes;
        Eigen::MatrixXd logs; // log of the posterior, not normalised
        Judgement judgement;

        Eigen::MatrixXd interpolated(const Eigen::MatrixXd& atNodes) const;
    };

    /// Values at the nodes, which are interpolated: rows by amplitude of the second effect, columns by that of the
    /// first.
    struct AtNodes
    {
        Eigen::MatrixXd chiSquares;
        Eigen::MatrixXd volumes; // the part of the log likelihood that does not depend on the chi-square
        Eigen::MatrixXd scatterChiSquares;
        Eigen::MatrixXd parameters; // one node per column
    };
    AtNodes atNodes(const Explanation& explanation, const Measured& measured, const Spread& usual) const;
    /// \param looked  range of amplitudes of each effect
    Posterior over(const Explanation& explanation, const AtNodes& nodes, const std::vector<Bounds>& looked) const;
    Posterior posterior(const Explanation& explanation, const AtNodes& nodes) const;
    double otherEvidence(const Measured& measured, const Spread& usual, const Solution& null) const;

    /// Rows with correlated errors: those of one block, or all rows if common errors connect the blocks.
    struct Part
    {
        Eigen::Index first;
        Eigen::Index size;
    };

    /// Transforms measured values, or values arranged like them, into the coordinates of a node.
    void transformTo(const Node& node, const Eigen::VectorXd& values, Eigen::VectorXd& transformed) const;

    const Study& study_;
    const Emulator& emulator_;
    const Layout& layout_;
    std::vector<Part> parts_;
    Eigen::VectorXd around_;
    Places places_;
    FewNumbers lower_; // limits of the parameters' ranges
    FewNumbers upper_;
    // Memory for `solve`, which is called a million times for one data set.
    mutable Eigen::VectorXd data_;
    mutable Eigen::VectorXd residual_;
    mutable Eigen::ArrayXd weight_;
    mutable Eigen::MatrixXd slope_;
    Node null_;
    std::vector<Explanation> effects_;
    std::vector<Eigen::LLT<Eigen::MatrixXd>> other_; // covariance of the discrepancy of each size, for the null
    Eigen::MatrixXd otherRoot_;                      // of a discrepancy of size 1
};

/// Log of the sum of exponentials, without overflow.
double logSumExp(const Eigen::VectorXd& values);

/// Log density of a sum of squares, averaged over a common factor on the variance with an inverse gamma prior. Terms
/// that are equal for all explanations are left out.
double logSpread(double trace, double numbers, double freedom);

/// Trace of w s w'.
double traceOf(const Eigen::MatrixXd& w, const Eigen::MatrixXd& s);

double logDeterminantOf(const Eigen::LLT<Eigen::MatrixXd>& factor);

} // namespace clepsydra::identification
