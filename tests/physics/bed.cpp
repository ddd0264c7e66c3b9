/// \file
/// Flow upwards through beds: shared/validation.md, section 3.

#include "bed.h"

#include "closures/ergun.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>
#include <vector>

namespace
{

using namespace clepsydra;
using namespace clepsydra::tests;

/// The column of validation.md section 3.
constexpr double diameter = 0.001;
constexpr double beadDensity = 2000;
constexpr double fluidDensity = 10;
constexpr double kinematicViscosity = 1.5e-4;
constexpr double columnVoidFraction = 0.451335;
constexpr double columnLength = 0.0156;

TestCase& columnDefaults(TestCase& test)
{
    test.setFluid(fluidDensity, kinematicViscosity);
    test.coupling().set("forceModels", "(GidaspowDrag gradPForce viscForce Archimedes)");
    test.dem.diameter = diameter;
    test.dem.density = beadDensity;
    return test;
}

/// dp [Pa] of the column's whole length, from the slope between its first and its last layer of cells.
double pressureDropOfFixedColumn(double superficialVelocity)
{
    const Eigen::Vector3i lattice(5, 5, 12);
    const double beads = 2 * lattice.prod();
    const double side = std::sqrt(beads * sphereVolume(diameter) / ((1 - columnVoidFraction) * columnLength));
    TestCase test;
    columnDefaults(test);
    test.box.upper = {side, side, columnLength};
    test.cells = lattice;
    test.setThroughFlow("uniform (0 0 " + number(superficialVelocity / columnVoidFraction) + ")");
    test.setTimes(0.02, 2e-4, 0.02);
    test.coupling().set("constDiffSmoothingProps/smoothingLength", 3 * diameter);
    test.dem.beads = bodyCentredLattice(test.box, lattice);
    test.dem.fixed = true;
    test.dem.timeStep = 2e-5;
    const Outcome outcome = test.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;

    const Eigen::VectorXd p = fluidDensity * test.layerMeans("p", "0.02");
    return (p[0] - p[p.size() - 1]) * static_cast<double>(p.size()) / static_cast<double>(p.size() - 1);
}

/// The column of validation.md, its beads fixed on a body-centred lattice that fills it from the inlet to the outlet,
/// so that its void fraction is the same everywhere, .451335: 22.99 Pa at .002 m/s and 230.5 Pa at .02 m/s by Ergun's
/// equation. At steady flow eps grad p = -(drag per volume), with model A's drag after Gidaspow.
///
/// A fluid that does not feel the beads has no pressure drop, one that gets model B's drag or the whole of grad p 2.2
/// times or .45 of it; a wrong void fraction shows with its third power.
TEST(FixedColumn, PressureDropIsErguns)
{
    for (const auto& [velocity, expected] : {std::pair(0.002, 22.99), std::pair(0.02, 230.5)})
    {
        const double ergun =
            columnLength
            * closures::ergunPressureGradient(
                {diameter, columnVoidFraction, fluidDensity, fluidDensity * kinematicViscosity}, velocity);
        EXPECT_NEAR(ergun, expected, 1e-3 * expected);
        const double measured = pressureDropOfFixedColumn(velocity);
        std::cout << "U " << velocity << " m/s: dp " << measured << " Pa, Ergun " << ergun << ", deviation "
                  << 100 * (measured / ergun - 1) << " %" << std::endl;
        EXPECT_NEAR(measured, ergun, 0.03 * ergun);
    }
}

/// The superficial velocity at which Ergun's pressure drop of a layered bed carries its buoyant weight.
double minimumFluidisation(const Eigen::VectorXd& voidFractions, double layer, double load)
{
    double low = 0;
    double high = 1;
    while (high - low > 1e-9)
    {
        const double velocity = 0.5 * (low + high);
        double drop = 0;
        for (const double voidFraction : voidFractions)
        {
            // Ergun's equation is for packed beds; what is above it is nearly clear.
            drop += voidFraction > 0.95
                        ? 0
                        : layer
                              * closures::ergunPressureGradient(
                                  {diameter, voidFraction, fluidDensity, fluidDensity * kinematicViscosity}, velocity);
        }
        (drop < load ? low : high) = velocity;
    }
    return low;
}

/// Positive root of b U + c U^2 = drop, the coefficients fitted by least squares.
double velocityOfDrop(const std::vector<std::pair<double, double>>& velocityAndDrop, double drop)
{
    const auto rows = static_cast<Eigen::Index>(velocityAndDrop.size());
    Eigen::MatrixX2d powers(rows, 2);
    Eigen::VectorXd drops(rows);
    for (Eigen::Index i = 0; i < rows; ++i)
    {
        const auto& [velocity, measured] = velocityAndDrop[static_cast<std::size_t>(i)];
        powers.row(i) << velocity, velocity * velocity;
        drops[i] = measured;
    }
    const Eigen::Vector2d fit = powers.colPivHouseholderQr().solve(drops);
    return 2 * drop / (fit[0] + std::sqrt(fit[0] * fit[0] + 4 * fit[1] * drop));
}

/// A loose bed of 1000 of the same beads, poured and at rest, then blown upon from below by a velocity that rises from
/// .65 to 1.5 of what fluidises it.
///
/// At rest its pressure drop follows Ergun's, and the velocity at which that line reaches the buoyant weight is U_mf:
/// held to 5 % against Ergun's equation with the void fraction that the bed has, layer by layer, in the program. From
/// there on the drop stays at the buoyant weight (2 %), and the bed rises.
///
/// A program without drag on the beads shows a drop that goes on rising and a bed that stays; without drag on the fluid
/// there is no drop; a missing -V_p grad p on the beads moves the plateau to 1/eps = 2.2 of the weight.
///
/// The rig: cells as wide as the column, so that every layer has one void fraction; the bed lies on the inlet itself,
/// and the smoothing is narrow (2 d), for where it spreads the edge of a bed over some diameters the beads there feel
/// less drag than their neighbours, and U_mf is that of no uniform bed. (A bed 15 d deep on a floor above the inlet,
/// smoothed over 3 d, was fluidised at a velocity 40 % too high, and its lowest layer stayed on the floor.)
/// Frictionless walls carry nothing.
///
/// What is left of the deviation, some 3 %: the bed loosens as its load goes, so that its beads move with 1-2 % of the
/// flow, and the velocity in the cells is not quite the flux over the void fraction.
TEST(FluidisedBed, IsCarriedByThePressureFromErgunsVelocityOn)
{
    TestCase test;
    columnDefaults(test);
    test.box.upper = {0.006, 0.006, 0.048};
    test.cells = {1, 1, 48};
    test.coupling().set("constDiffSmoothingProps/smoothingLength", 2 * diameter);
    test.dem.friction = 0.3;
    test.dem.wallFriction = 0;
    Box poured = test.box;
    poured.upper.z() = 0.042;
    test.dem.beads = simpleLattice(poured, {5, 5, 40});
    jitter(test.dem.beads, 4e-5, 1);
    const auto beads = static_cast<Eigen::Index>(test.dem.beads.size());
    test.dem.timeStep = 1e-5;
    test.dem.dumpEvery = 1000;
    startFromRelaxedBed(test, 0.25);
    // Interstitial, at a void fraction of about .48.
    test.setThroughFlow("table ((0 (0 0 0.02)) (0.4 (0 0 0.044)))", "uniformFixedValue");
    test.setTimes(0.4, 5e-4, 0.01);
    watchEnds(test);

    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;

    const double load = buoyantWeight(beads, diameter, beadDensity, fluidDensity) / crossSection(test);
    const auto history = test.beadHistory();
    const std::vector<EndPressures> pressures = endPressures(test, fluidDensity);

    // One row every 10 ms. The velocity in the clear water above the bed is the superficial one.
    std::vector<std::pair<double, double>> atRest;
    double lowestPlateau = 2 * load;
    double highestPlateau = 0;
    double plateau = 0;
    int plateauRows = 0;
    Eigen::VectorXd restingVoidFractions;
    for (const std::string& time : test.times())
    {
        const double now = std::stod(time);
        const auto at = std::find_if(
            pressures.begin(), pressures.end(), [&](const EndPressures& p) { return p.time > now - 1e-9; });
        ASSERT_NE(at, pressures.end());
        const double drop = at->differenceFromFace();
        const double velocity = test.layerMeans("U", time, 2)[test.cells.z() - 1];
        // The first 50 ms belong to the start of the flow.
        if (now > 0.05 && drop < 0.93 * load && plateauRows == 0)
        {
            atRest.emplace_back(velocity, drop);
            restingVoidFractions = test.layerMeans("voidFraction", time);
        }
        if (now > 0.25)
        {
            lowestPlateau = std::min(lowestPlateau, drop);
            highestPlateau = std::max(highestPlateau, drop);
            plateau += drop;
            ++plateauRows;
        }
    }
    ASSERT_GT(atRest.size(), 5u);
    plateau /= plateauRows;

    const double measured = velocityOfDrop(atRest, load);
    const double expected = minimumFluidisation(restingVoidFractions, test.box.size().z() / test.cells.z(), load);
    const double interior = restingVoidFractions.head(20).mean();
    const double ofInterior = closures::minimumFluidisationVelocity(
        {diameter, interior, fluidDensity, fluidDensity * kinematicViscosity}, beadDensity, closures::usualGravity);
    const auto top = [&](const BeadSnapshot& snapshot) { return snapshot.position.row(2).maxCoeff(); };
    const double risen = top(history.back()) - top(history[5]);
    const double finalVelocity = test.layerMeans("U", test.times().back(), 2)[test.cells.z() - 1];

    std::cout << "U_mf " << measured << " m/s, Ergun in layers " << expected << " (deviation "
              << 100 * (measured / expected - 1) << " %), Ergun at the interior's eps " << interior << ' ' << ofInterior
              << " (" << 100 * (measured / ofInterior - 1) << " %); plateau " << plateau << " Pa (" << lowestPlateau
              << " to " << highestPlateau << "), buoyant weight " << load << ", deviation "
              << 100 * (plateau / load - 1) << " %; risen by " << risen / diameter << " d at "
              << finalVelocity / measured << " U_mf; " << outcome.wallSeconds << " s" << std::endl;
    EXPECT_NEAR(measured, expected, 0.05 * expected);
    EXPECT_NEAR(plateau, load, 0.02 * load);
    EXPECT_GT(lowestPlateau, 0.97 * load);
    EXPECT_LT(highestPlateau, 1.03 * load);
    EXPECT_GT(finalVelocity, 1.2 * measured);
    EXPECT_GT(risen, 0.3 * diameter);
}

} // namespace
