#pragma once

#include "runner/studySimulator.h"

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// Runs of one condition that have not failed.
std::vector<const Simulation*> goodRuns(const std::vector<Simulation>& runs, std::size_t condition);

/// The effect library: runs in all training conditions, made once per simulator and used for every data set.
///
/// If runs scatter, the library holds repeats at the base setting and with each parameter alone at both ends; runs with
/// each switch and each effect that raises the scatter alone, at amplitude 1; and, for all other effects and the
/// parameters, a Plackett-Burman design with its foldover (Box & Wilson 1951; of resolution IV: no interaction of two
/// effects is confounded with an effect). If runs do not scatter, there is nothing to average, and one effect or
/// parameter is changed at a time.
struct Library
{
    std::vector<Simulation> runs;
    std::vector<Eigen::MatrixXd> errorSlopes; // result of sharedErrorSlopes for each condition
};

/// All runs that makeLibrary makes.
std::vector<SimulationOrder> libraryOrders(const StudySimulator& studySimulator);

/// Makes the effect library. \throws std::runtime_error if all runs of a condition at the base setting fail
Library makeLibrary(StudySimulator& studySimulator);

/// Step of the finite differences of runs, in standard deviations of what is changed: large if runs scatter, for a better
/// ratio of signal to noise.
double differenceStep(const Study& study);

/// Runs with each common error of the entries at a positive and a negative value, for the slopes of the features.
std::vector<SimulationOrder> commonErrorOrders(const StudySimulator& studySimulator, std::size_t condition);

/// Change of each feature per standard deviation of each error that conditions share, to first order: features x
/// errors. Common errors come first (by one-sided differences where the feature is missing on the other side; 0 where it
/// is missing on both), then, if there is any, the model error of each feature: a coarse mesh errs alike in all
/// conditions.
/// \param plain  runs without effects; errors of the measuring chain are applied to their curves
/// \throws std::runtime_error if all runs with an error fail
Eigen::MatrixXd sharedErrorSlopes(
    StudySimulator& studySimulator, std::size_t condition, const std::vector<Simulation>& plain);

/// Two-level design with orthogonal columns: entries -1 and +1, one row per run, one column per factor. Plackett &
/// Burman, Biometrika 33, 305 (1946); powers of two by Sylvester's doubling. The smallest of 4, 8, 12, 16, 20, 24 and
/// 32 runs that has enough columns is taken. More than 31 factors are split over several designs, in each of which the
/// factors of the others are at -1.
Eigen::MatrixXd plackettBurman(Eigen::Index factors);

/// The design, one run per row, followed by its mirror image.
Eigen::MatrixXd foldover(const Eigen::MatrixXd& design);

/// Effects of the study that change the simulation of a condition. Those of the measuring chain are not among them.
std::vector<std::size_t> simulatedEffects(const Study& study, std::size_t condition);

} // namespace clepsydra::identification
