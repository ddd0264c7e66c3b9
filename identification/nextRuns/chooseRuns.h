#pragma once

#include "decision/measured.h"

#include <vector>

namespace clepsydra::identification
{

/// An explanation that competes with others, at its fit.
struct Contender
{
    std::vector<Present> present; // empty: no effect
    Eigen::VectorXd parameters;   // in prior standard deviations
    double weight = 0.0;          // relative probability
};

/// Choice of one run, by indices of the contender and of the study's condition.
struct WantedRun
{
    std::size_t contender;
    std::size_t condition;
};

/// Chooses runs at the fits of the contenders, one after the other. Each run is the one that increases the expected
/// divergence between the contenders most, given the emulator's uncertainty (Box & Hill, Technometrics 9, 57 (1967);
/// Hunter & Reiner, Technometrics 7, 307 (1965)).
std::vector<WantedRun> chooseRuns(
    const Emulator& emulator, const Layout& layout, const std::vector<Contender>& contenders, int count);

/// Chooses runs if runs do not scatter, when one run at a setting is enough. A contender gets a run in each condition
/// where the emulator's uncertainty is not small beside the errors of the measurements, or where no run lies within
/// these errors of its prediction: far from all runs, the emulator's own uncertainty is not reliable.
std::vector<WantedRun> openRuns(const Study& study, const Emulator& emulator, const Layout& layout,
    const std::vector<Contender>& contenders, const std::vector<Simulation>& runs);

} // namespace clepsydra::identification
