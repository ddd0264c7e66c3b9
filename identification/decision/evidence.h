#pragma once

#include "decision/measured.h"

#include <Eigen/Core>

#include <limits>
#include <map>
#include <optional>
#include <random>
#include <vector>

namespace clepsydra::identification
{

/// Log evidence of every explanation: marginal over the parameters (normal prior), the amplitude (uniform in its range)
/// and what the emulator does not know.
struct Evidences
{
    double null = 0.0;
    Eigen::VectorXd effects; // by effect of the study; -infinity for those that are not known
    double other = 0.0;      // something that is not in the library
    // Of each effect at its likeliest amplitude:
    Eigen::VectorXd chiSquares;        // of the means, as in `Fit`
    Eigen::VectorXd scatterChiSquares; // of the spread between repeats, where it is not that of runs without effects
    Eigen::VectorXd peaks;             // log likelihood
    std::optional<double> chanceOfChiSquare =
        std::nullopt; // of no effect, where runs do not scatter: how often noise alone does it
};

/// Where an explanation fits best, and how well that is known.
struct Fit
{
    double amplitude = 0.0; // posterior mean; of the most likely one for a switch
    double sd = 0.0;
    double lower = 0.0; // 95 % of the posterior
    double upper = 0.0;
    Eigen::VectorXd parameters; // in prior sd, from the prior's mean
    Eigen::MatrixXd covariance; // of these, at this amplitude
    Eigen::MatrixXd marginal;   // the same over all amplitudes: what they take from each other, too
    double chiSquare = 0.0;     // sum of squares in units of noise, the parameters' priors included
};

/// One explanation at one amplitude, with all that does not depend on the measured numbers computed beforehand: in
/// coordinates in which the noise of the means is 1 and the emulator's uncertainty is diagonal.
struct Node
{
    std::vector<Present> present;
    std::vector<Eigen::MatrixXd> transform; // by part of the rows
    std::vector<Eigen::MatrixXd> whiten;    // by block: of single measurements
    Eigen::VectorXd extra;                  // variances beside the noise
    Eigen::MatrixXd terms;                  // rows x parameterTerms
    double logDeterminant = 0.0;            // of the transform's inverse, twice
    double spreadLogDeterminant = 0.0;      // of the noise of single measurements, times their degrees of freedom
    std::vector<bool> scatters;    // by block: other scatter than without effects, in the simulations themselves
    bool scattersAnywhere = false; // the same, or by the measuring chain
};

/// Evidence of explanations for data of one layout, by one emulator.
///
/// Noise: measurements scatter as simulations of the same setting do, up to a common factor near 1, whose evidence is
/// the spread between repeats. That spread is what tells effects which raise the scatter.
///
/// "Something else": a discrepancy over conditions and features of the size that the library's effects have, or
/// a fraction of it, orthogonal to what the parameters do (Plumlee, J. Am. Stat. Assoc. 112, 1274 (2017)), or repeats that
/// scatter in a way of their own.
class Evidence
{
public:
    /// \param around  parameters [prior sd] where the emulator's uncertainty is taken
    Evidence(const Study& study, const Emulator& emulator, const Layout& layout, const Eigen::VectorXd& around);

    /// The same questions to another emulator.
    Evidence(const Evidence& like, const Emulator& emulator);

    /// Asks the emulator about each effect, or about some that are on together, at the parameters that go with it, which may
    /// be far from those without any effect.
    void refine(const Measured& measured);
    void refine(const std::vector<std::size_t>& effects, const Measured& measured);

    /// Whether runs do not scatter.
    bool isExact() const
    {
        return !emulator_.scatters();
    }

    /// What the chiSquare of the truth stays below but for chance, this many standard deviations from the mean; where runs do
    /// not scatter, else infinite. No draw tells more: of what is not known, far from all runs, draws lie anywhere.
    double largestChiSquare(double sds) const;

    /// How often noise alone makes a chiSquare as large as this; where runs scatter 1, for there draws tell.
    double chanceOfChiSquare(double chiSquare) const;

    Evidences operator()(const Measured& measured) const;

    /// Log evidence of something that is not in the library.
    double otherEvidence(const Measured& measured) const;

    /// Most likely parameters without any effect, or with one.
    Fit fitNull(const Measured& measured) const;
    Fit fit(std::size_t effect, const Measured& measured) const;

    /// One effect or two at once, at amplitudes from end to end of their ranges.
    struct Explanation
    {
        std::vector<std::size_t> effects;
        std::vector<Grid> grids; // by effect
        std::vector<Node> nodes; // the last effect's amplitude goes first
    };
    Explanation explanationOf(const std::vector<std::size_t>& effects) const;

    struct Judgement
    {
        double logEvidence = 0.0;
        double chiSquare = 0.0; // at the likeliest amplitudes, as in `Evidences`
        double scatterChiSquare = 0.0;
        double peak = 0.0; // log likelihood there
    };
    Judgement judge(const Explanation& explanation, const Measured& measured) const;
    /// Fits of its effects, which share parameters.
    std::vector<Fit> fits(const Explanation& explanation, const Measured& measured) const;

    /// Amplitudes at which an effect is looked at; nothing for one that is not known.
    std::vector<double> amplitudes(std::size_t effect) const;

    Node nodeAt(const std::vector<Present>& present) const;

    /// Parameters within their ranges.
    template<typename Parameters>
    Parameters inRanges(const Parameters& parameters) const
    {
        return parameters.cwiseMax(lower_).cwiseMin(upper_);
    }

    /// Parameters near which the emulator is asked about effects: of two that were not refined the better one's fit.
    const Eigen::VectorXd& placeOf(const std::vector<Present>& present) const;

    /// Something else: a discrepancy of a size, as a multiple of the library's effects, to be added to the means.
    Eigen::VectorXd drawOther(double size, std::mt19937_64& random) const;

    /// Sizes of "something else" that are looked at, as multiples of what the library's effects do.
    static const std::vector<double>& sizes();

private:
    struct Spread
    {
        double factor = 1.0; // of the noise's variance
        double logLikelihood = 0.0;
        double chiSquare =
            0.0; // deviance, too small or too large, where the scatter is not that of runs without effects
    };

    using FewNumbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, mostParameters, 1>;
    using FewSquare = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, mostParameters, mostParameters>;

    struct Workspace
    {
        Eigen::VectorXd data;
        Eigen::VectorXd residual;
        Eigen::ArrayXd weight;
        Eigen::MatrixXd slope;
    };

    struct Solution
    {
        FewNumbers parameters;
        FewSquare precision;
        double chiSquare = 0.0;
        double logVolume = 0.0; // of the log likelihood, what is no chiSquare
    };

    /// Where an explanation fits.
    struct Place
    {
        Eigen::VectorXd parameters;
        double chiSquare = 0.0;
    };

    struct Discrepancy
    {
        Eigen::MatrixXd root; // lower triangular, of the covariance in the null's coordinates
        double logDeterminant = 0.0;
    };

    void prepare();
    void prepareOther();
    Spread spreadOf(const Node& node, const Measured& measured) const;
    double otherSpread(const Measured& measured) const;
    Solution solve(const Node& node, double factor, const Measured& measured) const;
    void fitParameters(const Node& node, const Measured& measured, Fit& fit) const;
    double logLikelihood(double chiSquare, double logVolume) const;
    /// Over amplitudes of the first effect, and of the second if there is one, where they are likely.
    struct Posterior
    {
        std::vector<Eigen::VectorXd> amplitudes; // by effect, evenly spaced
        std::vector<Eigen::MatrixXd> weights;    // of the nodes there
        Eigen::MatrixXd logs;                    // with the prior
        Judgement judgement;

        Eigen::MatrixXd interpolated(const Eigen::MatrixXd& atNodes) const;
    };

    /// What is interpolated between nodes: rows for the second effect's amplitudes, columns for the first's.
    struct AtNodes
    {
        Eigen::MatrixXd chiSquares;
        Eigen::MatrixXd volumes; // log likelihood, what is no chiSquare
        Eigen::MatrixXd scatterChiSquares;
        Eigen::MatrixXd parameters; // by column: a node's
    };
    AtNodes atNodes(const Explanation& explanation, const Measured& measured, const Spread& usual) const;
    /// \param looked  by effect: where
    Posterior over(const Explanation& explanation, const AtNodes& nodes, const std::vector<Bounds>& looked) const;
    Posterior posterior(const Explanation& explanation, const AtNodes& nodes) const;
    static std::vector<Bounds> likelyPart(const Posterior& posterior, const std::vector<Bounds>& ranges);

    double otherEvidence(const Measured& measured, const Spread& usual, const Solution& null) const;

    /// Rows that errors go across: those of a block, or all.
    struct Part
    {
        Eigen::Index first;
        Eigen::Index size;
    };

    static std::vector<Part> partsOf(const Layout& layout);
    /// Measured numbers, or what else is stacked like them, in the coordinates of a node.
    void transformTo(const Node& node, const Eigen::VectorXd& values, Eigen::VectorXd& transformed) const;

    const Study& study_;
    const Emulator& emulator_;
    const Layout& layout_;
    std::vector<Part> parts_;
    Eigen::VectorXd around_;
    std::map<std::vector<std::size_t>, Place> places_; // by effects that are on
    FewNumbers lower_;                                 // ends of the parameters' ranges
    FewNumbers upper_;
    mutable Workspace workspace_;
    Node null_;
    std::vector<Explanation> effects_;
    std::vector<Discrepancy> other_;
    Eigen::MatrixXd otherRoot_; // of a discrepancy of size 1
};

double logSumExp(const Eigen::VectorXd& values);

} // namespace clepsydra::identification
