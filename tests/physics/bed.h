/// \file
/// What the tests of beds share.
#pragma once

#include "support/testCase.h"

#include "closures/constants.h"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

inline double sphereVolume(double diameter)
{
    return closures::pi / 6 * diameter * diameter * diameter;
}

/// Weight less buoyancy of all beads [N].
inline double buoyantWeight(Eigen::Index beads, double diameter, double beadDensity, double fluidDensity)
{
    return static_cast<double>(beads) * sphereVolume(diameter) * (beadDensity - fluidDensity) * closures::usualGravity;
}

/// Drops the beads of a case without fluid, with little rebound, and lets the case start from the bed that they make.
/// \param seconds  to fall and come to rest
inline void startFromRelaxedBed(TestCase& test, double seconds)
{
    TestCase dry;
    dry.box = test.box;
    dry.cells = {1, 1, 1};
    dry.dem = test.dem;
    dry.dem.restitution = 0.3;
    dry.dem.dumpEvery = 0;
    const double interval = 20 * test.dem.timeStep;
    const double intervals = std::ceil(seconds / interval);
    dry.setTimes(intervals * interval, interval, intervals * interval);
    dry.coupling().set("fluid", "none").set("DEM/writeRestart", "\"DEM/bed.restart\"");
    const Outcome outcome = dry.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;

    std::filesystem::create_directories(test.path() / "DEM");
    std::filesystem::copy_file(dry.path() / "DEM/bed.restart", test.path() / "DEM/bed.restart");
    test.dem.readRestart = "DEM/bed.restart";
    test.dem.beads.clear();
}

} // namespace clepsydra::tests
