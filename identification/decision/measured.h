#pragma once

#include "emulator/covariance.h"
#include "emulator/emulator.h"
#include "study/measurements.h"

#include <Eigen/Core>

#include <random>
#include <vector>

namespace clepsydra::identification
{

/// What a data set is made of: conditions, features, how often each was measured, and what repeats do not show.
struct Layout
{
    struct Block
    {
        std::size_t condition = 0;        // of the study
        Eigen::Index first = 0;           // row among those of all blocks
        std::vector<Eigen::Index> places; // of its features among those of the condition's emulator
        Eigen::MatrixXd meanShare;        // covariance of the mean over that of one measurement, by element
        Eigen::MatrixXd
            common; // covariance of the mean that repeats do not show: declared errors, the simulation's own
        Eigen::MatrixXd shared; // rows x common errors of the study: by one sd of each
        Eigen::MatrixXd noise;  // of one measurement, where the simulator's noise does not stand for it; else empty
        double freedom = 0.0;   // repeats - 1, where their spread can be compared with the simulator's

        Eigen::Index size() const
        {
            return places.size();
        }

        /// Covariance of one measurement. \param here  emulator of its condition
        Eigen::MatrixXd ofOne(const ConditionEmulator& here, const std::vector<Present>& present) const;

        /// Covariance of the mean that repeats do not show, common errors included.
        Eigen::MatrixXd unshown() const
        {
            return common + shared * shared.transpose();
        }
    };

    std::vector<Block> blocks;
    bool sharesErrors = false; // between blocks, or features of one
    Eigen::Index rows = 0;
    double noiseFreedom = 0.0; // degrees of freedom behind the noise
    Eigen::MatrixXd noise;     // of one measurement, over all features of the study, as it is on average
};

/// The numbers that go with a layout.
struct Measured
{
    Eigen::VectorXd mean;                 // of the repeats
    std::vector<Eigen::MatrixXd> scatter; // by block: sum of squares and products of deviations from the mean
};

/// Noise of measurements where the simulator has none: from their own repeats, or what was declared. Planned ones have none.
/// \param learnt  where there is one, the numbers that it has must have errors, too
/// \throws std::runtime_error where there is neither
Covariance ownNoise(const Study& study, const std::vector<MeasuredCondition>& data,
    const std::vector<std::size_t>& conditions, const Emulator* learnt = nullptr);

/// \param data  by condition of the study; only those that the emulator has are looked at
/// \param errorSlopes  as in Library; empty: there are no common errors
/// \throws std::runtime_error where there is no noise to be had, or fewer features than parameters
std::pair<Layout, Measured> arrange(const Study& study, const Emulator& emulator,
    const std::vector<MeasuredCondition>& data, const std::vector<Eigen::MatrixXd>& errorSlopes = {});

/// Measurements at a setting, in a world that is as an emulator says on average, as it looks from some parameters.
/// \param doubted  whether the world is only as likely as the emulator says, there
Measured draw(const Layout& layout, const Emulator& world, const std::vector<Present>& present,
    const Eigen::VectorXd& parameters, const Eigen::VectorXd& seenFrom, bool doubted, std::mt19937_64& random);

/// Features of the training conditions that measurements have, by condition of the study.
std::vector<std::vector<Eigen::Index>> measuredFeatures(const Study& study, const std::vector<MeasuredCondition>& data);

} // namespace clepsydra::identification
