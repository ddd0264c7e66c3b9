#pragma once

#include "decision/measured.h"

#include <Eigen/Core>

#include <limits>
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
    Eigen::VectorXd misfits; // of each effect at its likeliest amplitude, as in `Fit`
};

/// Where an explanation fits best, and how well that is known.
struct Fit
{
    double amplitude = 0.0; // posterior mean; of the most likely one for a switch
    double sd = 0.0;
    double lower = 0.0; // 95 % of the posterior
    double upper = 0.0;
    Eigen::VectorXd parameters; // in prior sd, from the prior's mean
    Eigen::MatrixXd covariance; // of these
    double misfit = 0.0;        // sum of squares in units of noise, the parameters' priors included
};

/// One explanation at one amplitude, with all that does not depend on the measured numbers computed beforehand: in
/// coordinates in which the noise of the means is 1 and the emulator's uncertainty is diagonal.
struct Node
{
    std::vector<Present> present;
    std::vector<Eigen::MatrixXd> transform; // by block
    std::vector<Eigen::MatrixXd> whiten;    // by block: of single measurements
    Eigen::VectorXd extra;                  // variances beside the noise
    Eigen::MatrixXd terms;                  // rows x parameterTerms
    double logDeterminant = 0.0;            // of the transform's inverse, twice
    double spreadLogDeterminant = 0.0;      // of the noise of single measurements, times their degrees of freedom
    bool scatters = false;                  // other scatter than without effects
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

    /// Takes the emulator's uncertainty of each effect at the parameters that go with it, which may be far from those
    /// without any effect.
    void refine(const Measured& measured);

    Evidences operator()(const Measured& measured) const;

    /// Most likely parameters without any effect, or with one.
    Fit fitNull(const Measured& measured) const;
    Fit fit(std::size_t effect, const Measured& measured) const;

    /// Log evidence and fit of any two effects at once; amplitudes on a grid.
    struct Pair
    {
        double logEvidence = -std::numeric_limits<double>::infinity();
        double first = 0.0;
        double second = 0.0;
        Eigen::VectorXd parameters;
    };
    Pair pair(std::size_t one, std::size_t other, const Measured& measured) const;

    /// Amplitudes at which an effect is looked at; nothing for one that is not known.
    std::vector<double> amplitudes(std::size_t effect) const;

    Node nodeAt(const std::vector<Present>& present) const;

    /// Something else: a discrepancy of a size, as a multiple of the library's effects, to be added to the means.
    Eigen::VectorXd drawOther(double size, std::mt19937_64& random) const;

    /// Sizes of "something else" that are looked at, as multiples of what the library's effects do.
    static const std::vector<double>& sizes();

private:
    struct Explanation
    {
        std::vector<Node> nodes;
        Eigen::VectorXd amplitudes;    // of a fine grid
        Eigen::MatrixXd interpolation; // from nodes to these
        Eigen::VectorXd logWeights;    // of the amplitude's prior
    };

    struct Spread
    {
        double factor = 1.0; // of the noise's variance
        double logLikelihood = 0.0;
    };

    /// Parameters are few: their vectors need no memory of their own.
    using FewNumbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 12, 1>;
    using FewSquare = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 12, 12>;

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
        double misfit = 0.0;
        double logVolume = 0.0; // of the log likelihood, what is no misfit
    };

    struct Discrepancy
    {
        Eigen::MatrixXd root; // lower triangular, of the covariance in the null's coordinates
        double logDeterminant = 0.0;
    };

    Explanation explanationOf(std::size_t effect) const;
    void prepare();
    void prepareOther();
    Spread spreadOf(const Node& node, const Measured& measured) const;
    double otherSpread(const Measured& measured) const;
    Solution solve(const Node& node, double factor, const Measured& measured) const;
    double logLikelihood(double misfit, double logVolume) const;
    /// Of the explanation's amplitudes, with their prior, and the misfit of the likeliest.
    struct Posterior
    {
        Eigen::VectorXd logs;
        double misfit = 0.0;
    };
    Posterior posterior(const Explanation& explanation, const Measured& measured, const Spread& usual) const;
    double otherEvidence(const Measured& measured, const Spread& usual, const Solution& null) const;

    const Study& study_;
    const Emulator& emulator_;
    const Layout& layout_;
    Eigen::VectorXd around_;
    std::vector<Eigen::VectorXd> aroundEffects_;
    FewNumbers lower_; // ends of the parameters' ranges
    FewNumbers upper_;
    mutable Workspace workspace_;
    Node null_;
    std::vector<Explanation> effects_;
    std::vector<Discrepancy> other_;
    Eigen::MatrixXd otherRoot_; // of a discrepancy of size 1
};

double logSumExp(const Eigen::VectorXd& values);

} // namespace clepsydra::identification
