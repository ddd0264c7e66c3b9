#pragma once

#include "decision/measured.h"

#include <vector>

namespace clepsydra::identification
{

/// An explanation that is left, where it fits.
struct Contender
{
    std::vector<Present> present; // nothing: no effect
    Eigen::VectorXd parameters;   // in prior sd
    double weight = 0.0;          // how likely it is
};

/// A run that is wanted.
struct WantedRun
{
    std::size_t contender;
    std::size_t condition;
};

/// Runs at the fits of the contenders, one after the other, each where it decides most: where the expected divergence
/// between contenders, given what the emulator does not know, rises most by it (Box & Hill, Technometrics 9, 57 (1967);
/// Hunter & Reiner, Technometrics 7, 307 (1965)).
std::vector<WantedRun> chooseRuns(
    const Emulator& emulator, const Layout& layout, const std::vector<Contender>& contenders, int count);

/// Where runs do not scatter one at a place tells all: a run of each contender where what the emulator does not know of it is
/// not small beside the errors of what was measured, or where there is none that differs from it by less than these: what the
/// emulator says of its own errors where no run is rests on what effects do elsewhere.
std::vector<WantedRun> openRuns(const Study& study, const Emulator& emulator, const Layout& layout,
    const std::vector<Contender>& contenders, const std::vector<Run>& runs);

} // namespace clepsydra::identification
