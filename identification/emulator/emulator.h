#pragma once

#include "emulator/conditionEmulator.h"
#include "emulator/library.h"

#include <array>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Emulators of all training conditions. They share the scales of the priors and the correlations of the noise.
class Emulator
{
public:
    /// \param runs  the effect library and all further runs
    /// \param features  wanted features of each condition of the study; features that too many runs lack are left out
    Emulator(const Study& study, const StudySimulator& studySimulator, const std::vector<Simulation>& runs,
        const std::vector<std::vector<Eigen::Index>>& features);

    /// The emulator of a condition of the study; empty if the condition has no features.
    const std::optional<ConditionEmulator>& operator[](std::size_t condition) const
    {
        return conditions_[condition];
    }

    /// False for an effect whose runs have all failed.
    bool knows(std::size_t effect) const
    {
        return known_[effect];
    }

    /// Whether repeated runs differ.
    bool scatters() const
    {
        return scatters_;
    }

    /// Covariance of one run over all features of the study, averaged over the conditions; zero without scatter.
    const Eigen::MatrixXd& noise() const
    {
        return noise_;
    }

    /// Degrees of freedom of the noise.
    double degreesOfFreedom() const
    {
        return degreesOfFreedom_;
    }

    const std::vector<std::string>& remarks() const
    {
        return remarks_;
    }

    /// A draw from the posterior of the coefficients and the noise.
    Emulator posteriorDraw(std::mt19937_64& random) const;

    /// The emulator that is obtained when all runs are regenerated at the same settings.
    /// \param truth  the posterior draw that the regenerated runs follow
    Emulator regenerated(const Emulator& truth, std::mt19937_64& random) const;

private:
    /// The runs of one condition, one per row.
    struct Rows
    {
        std::vector<Setting> settings; // without the effects of the measuring chain
        Eigen::MatrixXd values;        // of the emulator's features
        Eigen::MatrixXd terms;         // of the basis

        /// Whether a run has several effects.
        bool hasSeveral(Eigen::Index run) const
        {
            return terms(run, terms.cols() - 1) != 0.0;
        }
    };

    void choose(
        std::size_t condition, const std::vector<const Simulation*>& good, const std::vector<Eigen::Index>& wanted);
    std::vector<const Curve*> append(
        std::size_t condition, const StudySimulator& studySimulator, const std::vector<const Simulation*>& runs);
    double logEvidence() const;
    void chooseScales();
    void solve(std::size_t condition);
    void learnNoiseAndScatter();
    std::vector<std::vector<Eigen::Index>> repeats(std::size_t condition) const;
    void learnNoise(bool ofPlainRuns);
    void learnScatter();
    void learnChain(std::size_t effect, std::size_t condition, const StudySimulator& studySimulator,
        const std::vector<const Curve*>& curves);
    Eigen::ArrayXXd variances(std::size_t condition) const;
    Eigen::MatrixXd whitened(std::size_t condition) const;

    const Study* study_;
    std::vector<Rows> rows_;
    std::vector<std::optional<ConditionEmulator>> conditions_;
    std::vector<std::size_t> learnt_; // conditions that have an emulator
    std::vector<bool> known_;
    std::array<double, Basis::kinds> scales_{}; // prior sd of the coefficients, in units of one run's noise
    /// Standard deviation of the error of the quadratic terms in runs with several effects, in units of the noise.
    /// Without it the many runs of the design would shift the prediction at the base setting.
    double lackOfFit_ = 0.0;
    bool scatters_ = false;
    Eigen::MatrixXd noise_;
    double degreesOfFreedom_ = 0.0;
    std::vector<std::string> remarks_;
};

} // namespace clepsydra::identification
