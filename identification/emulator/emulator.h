#pragma once

#include "emulator/basis.h"
#include "emulator/grid.h"
#include "emulator/library.h"

#include <array>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Effects that are on, with their amplitudes.
struct Present
{
    std::size_t effect;
    double amplitude;
};

/// What the simulator would give in one condition, at any parameters and amplitudes, learnt from runs: Bayesian
/// regression on the terms of `Basis`, all features at once. In units of one run's noise the features are independent
/// and all coefficients of a kind have one normal prior. Parameters are counted in sd of their prior, from its mean.
class ConditionEmulator
{
public:
    /// What an effect of the measuring chain does to each feature, at amplitudes from end to end: no polynomial follows what
    /// a late trigger does to a short start. A run's noise goes through the chain, too.
    struct Chain
    {
        Grid amplitudes;
        Eigen::MatrixXd changes;             // features x amplitudes
        std::vector<Eigen::MatrixXd> slopes; // of these in each parameter
        Eigen::MatrixXd logScatter;          // log of the factor on a run's sd
    };

    Basis basis;
    std::vector<std::optional<std::size_t>> owners;    // by parameter: the effect of which it is a part
    std::vector<Eigen::Index> features;                // of the study
    Eigen::MatrixXd noise;                             // covariance of one run without effects that raise the scatter
    Eigen::MatrixXd root;                              // lower triangular; root root' = noise, as it was learnt
    double logSdError = 0.0;                           // of the noise: what is not known of the log of each sd
    Eigen::VectorXd centre;                            // mean of the runs, from which values are counted
    Eigen::MatrixXd coefficients;                      // terms x features, in units of `root`
    std::vector<Eigen::MatrixXd> covariances;          // of these, by feature
    std::map<std::size_t, Chain> chain;                // by effect
    std::map<std::size_t, Eigen::VectorXd> logScatter; // by simulated effect: log sd that amplitude 1 adds, by feature

    /// Mean of the features at some parameters.
    Eigen::VectorXd at(const Eigen::VectorXd& parameters, const std::vector<Present>& present) const;

    /// The same as a polynomial in the parameters, which holds near some: features x parameterTerms.
    Eigen::MatrixXd mean(const std::vector<Present>& present, const Eigen::VectorXd& around) const;

    /// Covariance of what the emulator does not know of that mean, at some parameters.
    Eigen::MatrixXd uncertainty(const Eigen::VectorXd& parameters, const std::vector<Present>& present) const;

    /// Whether an effect changes the scatter of runs.
    bool scatters(std::size_t effect) const
    {
        return chain.count(effect) > 0 || logScatter.count(effect) > 0;
    }

    /// Covariance of one run.
    Eigen::MatrixXd noiseOf(const std::vector<Present>& present) const;

    /// The terms at a setting. Effects that are not simulated here count as absent.
    Eigen::VectorXd terms(const Eigen::VectorXd& parameters, const std::vector<Present>& present) const;

    Eigen::VectorXd amplitudes(const std::vector<Present>& present) const; // by place in the basis

    /// By parameter: 1, or the amplitude of the effect of which it is a part.
    Eigen::VectorXd reach(const std::vector<Present>& present) const;
};

/// Emulators of all training conditions, with scales of the priors and noise that they share.
class Emulator
{
public:
    /// \param features  by condition of the study, those that are wanted; of these, what too many runs lack is left out
    Emulator(const Study& study, const Simulator& simulator, const std::vector<Run>& runs,
        const std::vector<std::vector<Eigen::Index>>& features);

    /// By condition of the study; none where nothing is wanted or left.
    const std::optional<ConditionEmulator>& operator[](std::size_t condition) const
    {
        return conditions_[condition];
    }

    /// Whether anything is known of an effect: of one whose runs have all failed nothing is.
    bool knows(std::size_t effect) const
    {
        return known_[effect];
    }

    bool scatters() const
    {
        return scatters_;
    }

    /// Covariance of one run over all features of the study, as it is in the conditions on average; zero without scatter.
    const Eigen::MatrixXd& noise() const
    {
        return noise_;
    }

    /// Degrees of freedom behind the noise.
    double degreesOfFreedom() const
    {
        return degreesOfFreedom_;
    }

    double lackOfFit() const
    {
        return lackOfFit_;
    }

    const std::vector<std::string>& remarks() const
    {
        return remarks_;
    }

    /// A world that the runs leave possible: what they do not tell is drawn.
    Emulator possibleWorld(std::mt19937_64& random) const;

    /// What would have been learnt from runs at the same settings in such a world.
    Emulator relearnt(const Emulator& world, std::mt19937_64& random) const;

private:
    /// The runs of one condition, a row each.
    struct Rows
    {
        std::vector<Setting> settings;
        Eigen::MatrixXd values; // of the features that the emulator has
        Eigen::MatrixXd terms;
        std::vector<std::vector<Present>> scattering; // effects of each run that raise its scatter

        /// Whether a run has several effects at once.
        bool hasSeveral(Eigen::Index run) const
        {
            return terms(run, terms.cols() - 1) != 0.0;
        }
    };

    void choose(std::size_t condition, const std::vector<const Run*>& good, const std::vector<Eigen::Index>& wanted);
    void append(std::size_t condition, const Simulator& simulator, const std::vector<const Run*>& runs);
    double logEvidence(const std::array<double, Basis::kinds>& scales) const;
    void chooseScales();
    void solve(std::size_t condition);
    void learnNoiseAndScatter();
    void learnNoise(bool ofPlainRuns);
    void learnScatter();
    void learnChain(
        std::size_t effect, std::size_t condition, const Simulator& simulator, const std::vector<const Run*>& runs);
    Eigen::ArrayXXd variances(std::size_t condition) const;
    Eigen::MatrixXd whitened(std::size_t condition) const;

    const Study* study_;
    std::vector<Rows> rows_;
    std::vector<std::optional<ConditionEmulator>> conditions_;
    std::vector<std::size_t> learnt_; // conditions that have an emulator
    std::vector<bool> known_;
    std::array<double, Basis::kinds> scales_{}; // sd of the coefficients' priors, in units of one run's noise
    /// Sd of what terms of second order miss where several effects are on, in units of noise: without it the design's
    /// runs, which are many, would carry the base setting with them.
    double lackOfFit_ = 0.0;
    bool scatters_ = false;
    Eigen::MatrixXd noise_;
    double degreesOfFreedom_ = 0.0;
    std::vector<std::string> remarks_;
};

} // namespace clepsydra::identification
