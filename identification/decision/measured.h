#pragma once

#include "emulator/covariance.h"
#include "emulator/emulator.h"
#include "study/measurements.h"

#include <Eigen/Core>

#include <random>
#include <vector>

namespace clepsydra::identification
{

/// Structure of a data set: its conditions and features, the numbers of repeats, and the errors that repeats do not
/// show. The measured values of all conditions are stacked into one vector, one block per condition.
struct Layout
{
    struct Block
    {
        std::size_t condition = 0;        // index in the study
        Eigen::Index first = 0;           // first row of the block
        std::vector<Eigen::Index> places; // indices of its features in the condition's emulator
        Eigen::MatrixXd meanShare;        // covariance of the mean divided by that of one measurement, by element
        Eigen::MatrixXd declared;         // covariance of the declared errors
        Eigen::MatrixXd shared;           // rows x shared errors: change by one standard deviation of each error
        Eigen::MatrixXd noise;            // covariance of one measurement; empty if the simulator's noise stands for it
        double freedom = 0.0; // number of repeats minus 1, if their spread can be compared with the simulator's

        Eigen::Index size() const
        {
            return places.size();
        }

        /// Covariance of one measurement. \param here  emulator of the block's condition
        Eigen::MatrixXd ofOne(const ConditionEmulator& here, const std::vector<Present>& present) const;

        /// Covariance of all errors of the mean that repeats do not show, including those that conditions share.
        Eigen::MatrixXd unshown() const
        {
            return declared + shared * shared.transpose();
        }
    };

    std::vector<Block> blocks;
    bool sharesErrors = false; // whether there are common errors or a model error
    Eigen::Index rows = 0;
    double noiseFreedom = 0.0; // degrees of freedom of the noise
    Eigen::MatrixXd noise;     // mean covariance of one measurement, over all features of the study
};

/// The measured values that belong to a layout.
struct Measured
{
    Eigen::VectorXd mean;                 // of the repeats
    std::vector<Eigen::MatrixXd> scatter; // by block: sum of squares and products of deviations from the mean
};

/// Noise of the measurements if the simulator has none: estimated from their repeats, or zero if errors are declared.
/// Planned measurements are ignored.
/// \param learnt  if given, each of its features must have an error
/// \throws std::runtime_error if there are neither repeats nor declared errors
Covariance ownNoise(const Study& study, const std::vector<MeasuredCondition>& data,
    const std::vector<std::size_t>& conditions, const Emulator* learnt = nullptr);

/// Requires that each measured feature of the held-out conditions has an error, if the simulator has no noise: their
/// noise is that of the training data. Which features are measured matters here, and not their values.
/// \throws std::runtime_error naming the condition, the feature and what is allowed
void requireHeldOutErrors(
    const Study& study, const std::vector<MeasuredCondition>& training, const std::vector<MeasuredCondition>& heldOut);

/// Stacks the measurements of all conditions that the emulator has learnt.
/// \param data  by condition of the study
/// \param errorSlopes  as in Library; empty if conditions share no errors
/// \throws std::runtime_error if the noise cannot be estimated or if there are no more features than parameters
std::pair<Layout, Measured> arrange(const Study& study, const Emulator& emulator,
    const std::vector<MeasuredCondition>& data, const std::vector<Eigen::MatrixXd>& errorSlopes = {});

/// Expected values of the measurements. \param parameters  standardised
Eigen::VectorXd meanAt(const Emulator& emulator, const Layout& layout, const std::vector<Present>& present,
    const Eigen::VectorXd& parameters);

/// Synthetic measurements at a setting.
/// \param truth  emulator whose expected features are the true ones
/// \param around  parameters near which the emulator is linearised
/// \param withUncertainty  whether the emulator's uncertainty is added to the noise
Measured draw(const Layout& layout, const Emulator& truth, const std::vector<Present>& present,
    const Eigen::VectorXd& parameters, const Eigen::VectorXd& around, bool withUncertainty, std::mt19937_64& random);

/// Features that the measurements have, by condition of the study; empty except for training conditions.
std::vector<std::vector<Eigen::Index>> measuredFeatures(const Study& study, const std::vector<MeasuredCondition>& data);

} // namespace clepsydra::identification
