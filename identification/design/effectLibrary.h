#pragma once

#include "noise/noise.h"
#include "runner/simulator.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// What parameters and effects do to the features of one condition, to first order.
struct Sensitivity
{
    Eigen::VectorXd base;             // features at the priors' means, without effects
    Eigen::MatrixXd parameterColumns; // features x parameters, per prior sd
    Eigen::MatrixXd effectColumns;    // features x effects, per unit amplitude; zero where an effect cannot act
    Eigen::VectorXd columnShare;      // variance of an effect's column over that of one run
    Eigen::MatrixXd baseFeatures;     // the repeats behind `base`, one per row
};

/// Made once per rig, used for every data set.
struct EffectLibrary
{
    std::vector<Sensitivity> conditions; // of the study, by index; empty ones for candidates
    Scatter scatter;                     // of repeats of the simulator
    double seedCorrelation = 0.0;        // of runs with the same seed at neighbouring settings
    double seedCorrelationError = 0.0;
    bool commonSeeds = false; // were used for the design
    DesignKind design = DesignKind::plackettBurman;
    std::vector<std::string> remarks; // what failed runs have cost
};

/// Runs the repeats and the design for all training conditions; held-out conditions are not touched.
EffectLibrary makeLibrary(Simulator& simulator);

/// All runs that makeLibrary would ask for, as far as known beforehand; for the cost.
std::vector<SimulationOrder> libraryOrders(const Simulator& simulator);

} // namespace clepsydra::identification
