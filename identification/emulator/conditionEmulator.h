#pragma once

#include "emulator/basis.h"
#include "emulator/grid.h"
#include "runner/studySimulator.h"

#include <map>
#include <optional>
#include <vector>

namespace clepsydra::identification
{

/// An effect that is switched on, and its amplitude.
struct Present
{
    std::size_t effect;
    double amplitude;
};

/// Emulator of the simulator in one condition: predicts the features at any parameters and amplitudes by Bayesian
/// linear regression on the terms of `Basis`. The features are scaled by the noise of one run, which makes them
/// independent; all coefficients of one kind share a normal prior. Parameters are standardised: deviation from the
/// prior's mean in units of its standard deviation.
class ConditionEmulator
{
public:
    /// Change of each feature by an effect of the measuring chain, tabulated over the effect's amplitudes, because a
    /// late trigger changes a short start in a way that no polynomial describes. The chain changes the noise too.
    struct Chain
    {
        Grid grid;
        Eigen::MatrixXd changes;             // features x amplitudes
        std::vector<Eigen::MatrixXd> slopes; // derivative of `changes` with respect to each parameter
        Eigen::MatrixXd logScatter;          // log of the factor on the standard deviation of a run
    };

    Basis basis;
    std::vector<std::optional<std::size_t>> owners; // for each parameter, the effect that it belongs to
    std::vector<Eigen::Index> features;             // indices in the study
    Eigen::MatrixXd noise;                          // covariance of one run without effects that raise the scatter
    Eigen::MatrixXd root;                           // lower Cholesky factor of the estimated noise
    double logSdError = 0.0;                        // standard error of the log of each standard deviation in `noise`
    Eigen::VectorXd centre;                         // mean of the runs, which is subtracted from all values
    Eigen::MatrixXd coefficients;                   // terms x features, in units of `root`
    std::vector<Eigen::MatrixXd> covariances;       // posterior covariance of the coefficients of each feature
    std::map<std::size_t, Chain> chain;             // by effect
    /// For each simulated effect that raises the scatter: log of the factor on the standard deviations at amplitude 1.
    std::map<std::size_t, Eigen::VectorXd> logScatter;

    /// Expected features.
    Eigen::VectorXd at(const Eigen::VectorXd& parameters, const std::vector<Present>& present) const;

    /// Expected features as a quadratic polynomial in the parameters, valid near `around`: features x parameterTerms.
    Eigen::MatrixXd mean(const std::vector<Present>& present, const Eigen::VectorXd& around) const;

    /// Covariance of the emulator's error in the expected features.
    Eigen::MatrixXd uncertainty(const Eigen::VectorXd& parameters, const std::vector<Present>& present) const;

    /// Whether an effect changes the scatter of runs.
    bool scatters(std::size_t effect) const
    {
        return chain.count(effect) > 0 || logScatter.count(effect) > 0;
    }

    /// The simulated effects of a setting that raise the scatter.
    std::vector<Present> scatteringIn(const Setting& setting) const;

    /// Covariance of one run with these effects.
    Eigen::MatrixXd noiseOf(const std::vector<Present>& present) const;

    /// Values of the basis' terms. Effects that are not simulated in this condition are ignored.
    Eigen::VectorXd terms(const Eigen::VectorXd& parameters, const std::vector<Present>& present) const;

    Eigen::VectorXd amplitudes(const std::vector<Present>& present) const; // in the sequence of the basis' effects

    /// Factor on each parameter: the amplitude of the effect that it belongs to, or 1 if it belongs to none.
    Eigen::VectorXd reach(const std::vector<Present>& present) const;
};

} // namespace clepsydra::identification
