/// \file
/// Flow upwards through beds: shared/validation.md, section 3.

#include "bed.h"

#include "closures/ergun.h"

#include <cmath>
#include <iostream>

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

TEST(FluidisedBed, X)
{
    TestCase test;
    columnDefaults(test);
    const double gap = 0;
    test.box.upper = {0.006, 0.006, 0.048};
    test.cells = {1, 1, atoi(getenv("NZ"))};
    
    test.dem.wallFriction = 0;
    test.dem.friction = 0.3;
    Box poured = test.box;
    poured.lower.z() = gap;
    poured.upper.z() = gap + 0.042;
    test.dem.beads = simpleLattice(poured, {5, 5, 40});
    jitter(test.dem.beads, 4e-5, 1);
    const auto beads = static_cast<Eigen::Index>(test.dem.beads.size());
    test.dem.timeStep = 1e-5;
    test.dem.dumpEvery = 1000;
    startFromRelaxedBed(test, 0.25);
    test.setThroughFlow("table ((0 (0 0 0.02)) (0.4 (0 0 0.044)))", "uniformFixedValue");
    test.setTimes(0.4, 5e-4, 0.01);
    if (atof(getenv("SM")) > 0) test.coupling().set("constDiffSmoothingProps/smoothingLength", atof(getenv("SM"))*diameter);
    else test.coupling().set("smoothingModel", "off");
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const auto history = test.beadHistory();
    const double area = test.box.upper.x() * test.box.upper.y();
    const double weight = buoyantWeight(beads, diameter, beadDensity, fluidDensity) / area;
    std::cout << outcome.wallSeconds << " s, N " << beads << std::endl;
    int i = 0;
    for (const auto& t : test.times())
    {
        const auto& s = history[++i];
        const Eigen::VectorXd p = fluidDensity * test.layerMeans("p", t);
        const Eigen::VectorXd U = test.layerMeans("U", t, 2);
        std::cout << t << " U " << U[U.size() - 1] << " dp " << 1.5*p[0] - .5*p[1] << " of " << weight << " v "
                  << s.velocity.colwise().norm().maxCoeff() << " z " << s.position.row(2).minCoeff() << ' '
                  << s.position.row(2).maxCoeff() << std::endl;
        if (i % 20 == 0)
            std::cout << test.layerMeans("voidFraction", t).transpose() << "\n" << U.transpose() << std::endl;
    }
}

} // namespace
