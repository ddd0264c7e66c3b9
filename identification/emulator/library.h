#pragma once

#include "runner/studySimulator.h"

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// A run of the simulator at a known setting: what the emulators learn from.
struct Run
{
    Setting setting;
    Simulation simulation;
};

/// The orders and what came of them.
std::vector<Run> makeRuns(StudySimulator& studySimulator, const std::vector<SimulationOrder>& orders);

/// Runs of one condition that have not failed.
std::vector<const Run*> goodRuns(const std::vector<Run>& runs, std::size_t condition);

/// Runs of all training conditions. Made once per simulator, used for every data set.
///
/// Where runs scatter: repeats at the base setting, and with each parameter alone at either end; switches and effects that
/// raise the scatter alone, at amplitude 1; all others, and the parameters, in a Plackett-Burman design and its foldover (Box
/// & Wilson 1951; resolution IV: no interaction of two looks like an effect). Without scatter nothing is averaged out: one
/// thing is changed at a time.
struct Library
{
    std::vector<Run> runs;
    std::vector<Eigen::MatrixXd> errorSlopes; // by condition: what the common errors do, as commonErrorSlopes gives it
};

/// All runs that makeLibrary asks for.
std::vector<SimulationOrder> libraryOrders(const StudySimulator& studySimulator);

/// \throws std::runtime_error where all runs at the base setting of a condition have failed
Library makeLibrary(StudySimulator& studySimulator);

/// The design, a row per run, followed by its mirror image.
Eigen::MatrixXd foldover(const Eigen::MatrixXd& design);

/// Effects of the study that change the simulation of a condition; those of the measuring chain do not.
std::vector<std::size_t> simulatedEffects(const Study& study, std::size_t condition);

} // namespace clepsydra::identification
