#pragma once

#include "emulator/basis.h"
#include "emulator/grid.h"
#include "runner/studySimulator.h"

#include <map>
#include <optional>
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

    /// Effects of a run that raise its scatter by simulation.
    std::vector<Present> scatteringIn(const Setting& setting) const;

    /// Covariance of one run.
    Eigen::MatrixXd noiseOf(const std::vector<Present>& present) const;

    /// The terms at a setting. Effects that are not simulated here count as absent.
    Eigen::VectorXd terms(const Eigen::VectorXd& parameters, const std::vector<Present>& present) const;

    Eigen::VectorXd amplitudes(const std::vector<Present>& present) const; // by place in the basis

    /// By parameter: 1, or the amplitude of the effect of which it is a part.
    Eigen::VectorXd reach(const std::vector<Present>& present) const;
};

} // namespace clepsydra::identification
