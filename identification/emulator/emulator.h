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

/// Emulators of all training conditions, with scales of the priors and noise that they share.
class Emulator
{
public:
    /// \param features  by condition of the study, those that are wanted; of these, what too many runs lack is left out
    Emulator(const Study& study, const StudySimulator& studySimulator, const std::vector<Run>& runs,
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
    void append(std::size_t condition, const StudySimulator& studySimulator, const std::vector<const Run*>& runs);
    double logEvidence(const std::array<double, Basis::kinds>& scales) const;
    void chooseScales();
    void solve(std::size_t condition);
    void learnNoiseAndScatter();
    void learnNoise(bool ofPlainRuns);
    void learnScatter();
    void learnChain(std::size_t effect, std::size_t condition, const StudySimulator& studySimulator,
        const std::vector<const Run*>& runs);
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
