/// \file
/// What the tests of beds share.
#pragma once

#include "support/testCase.h"

#include "closures/constants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

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

inline double crossSection(const TestCase& test)
{
    return test.box.size().x() * test.box.size().y();
}

/// The pressure in the middle of the lowest two layers of cells and of the highest, at one time step.
struct EndPressures
{
    double time;
    double lowest;
    double second;
    double difference; // lowest - highest

    /// From the bottom face to the top layer, for a bed that begins right at the bottom.
    double differenceFromFace() const
    {
        return difference + 0.5 * (lowest - second);
    }
};

/// Lets a case record the pressure at its ends, at every time step.
inline void watchEnds(TestCase& test)
{
    // Off the edges between cells.
    const Eigen::Vector3d middle = test.box.lower + test.box.size().cwiseProduct(Eigen::Vector3d(0.52, 0.53, 0));
    std::string points = "(";
    for (const int k : {0, 1, test.cells.z() - 1})
    {
        points += vectorText({middle.x(), middle.y(), test.layerHeight(k)});
    }
    test.control().set("functions/ends", "{ type probes; libs (\"libsampling.so\"); fields (p); probeLocations "
                                             + points + "); writeControl timeStep; writeInterval 1; }");
}

/// In Pa.
inline std::vector<EndPressures> endPressures(const TestCase& test, double fluidDensity)
{
    std::vector<EndPressures> pressures;
    for (const std::vector<double>& row : test.table("postProcessing/ends/0/p"))
    {
        pressures.push_back(
            {row.at(0), fluidDensity * row.at(1), fluidDensity * row.at(2), fluidDensity * (row.at(1) - row.at(3))});
    }
    return pressures;
}

/// Mean over the times in (from, to].
inline double meanDifference(const std::vector<EndPressures>& pressures, double from, double to)
{
    double sum = 0;
    int count = 0;
    for (const EndPressures& p : pressures)
    {
        if (p.time > from && p.time <= to)
        {
            sum += p.difference;
            ++count;
        }
    }
    return sum / count;
}

} // namespace clepsydra::tests
