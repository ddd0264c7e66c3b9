/// \file
/// constant/fvOptions and system/fvOptions: sources, porous zones and limits in the fluid's equations. Each result has a
/// closed form, in which the void fraction stands where the source is a force per mass of fluid.

#include "support/testCase.h"
#include "tokens/exactText.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace clepsydra::tests
{

namespace
{

constexpr double diameter = 1e-3;
constexpr double kinematicViscosity = 1.5e-4;

std::string options(const std::string& text)
{
    return FoamFile().text("fvOptions") + text;
}

enum class Bed
{
    none,
    lowerHalf,
    all
};

/// A column through which fluid flows up, with fixed particles in a part of it.
/// \param velocity  at the inlet, between the particles [m/s]
void column(TestCase& test, double velocity, Bed bed)
{
    test.setFluid(10, kinematicViscosity);
    test.box.upper = {0.0039, 0.0039, 0.0156};
    test.cells = {3, 3, 24};
    test.setThroughFlow("uniform (0 0 " + exactText(velocity) + ")");
    test.setTimes(0.02, 2e-4, 0.02);
    test.coupling()
        .set("forceModels", "(StokesDrag gradPForce viscForce Archimedes)")
        .set("constDiffSmoothingProps/bandwidth", diameter);
    test.dem.density = 2000;
    test.dem.fixed = true;
    test.dem.timeStep = 2e-5;
    if (bed == Bed::none)
    {
        // A speck of little drag, since a run with fluid has particles. It has no contacts.
        test.coupling().set("DEM/maxRayleighFraction", "1000");
        test.dem.diameter = diameter / 100;
        test.dem.particles = {{0.0019, 0.002, 0.0078}};
        return;
    }
    test.dem.diameter = diameter;
    Box filled = test.box;
    filled.upper.z() *= bed == Bed::lowerHalf ? 0.5 : 1;
    test.dem.particles = bodyCentredLattice(filled, {3, 3, bed == Bed::lowerHalf ? 6 : 12});
}

/// dp/dz of the layers' kinematic pressures between neighbouring layers [m/s2].
Eigen::VectorXd gradients(const TestCase& test)
{
    const Eigen::VectorXd p = test.layerMeans("p", test.times().back());
    const double spacing = test.layerHeight(1) - test.layerHeight(0);
    return (p.tail(p.size() - 1) - p.head(p.size() - 1)) / spacing;
}

void expectAll(const Eigen::VectorXd& values, double expected, double tolerance)
{
    EXPECT_LT((values.array() / expected - 1).abs().maxCoeff(), tolerance) << "expected " << expected << ", found\n"
                                                                           << values.transpose();
}

/// Gradient in the middle of a column with or without a bed and a porous zone [m/s2].
double gradientThrough(double velocity, Bed bed, bool porous, double* voidFraction = nullptr)
{
    TestCase test;
    column(test, velocity, bed);
    if (porous)
    {
        test.extraFiles["constant/fvOptions"] = options(R"(
screen
{
    type explicitPorositySource;
    explicitPorositySourceCoeffs
    {
        selectionMode cellZone;
        cellZone porous;
        type DarcyForchheimer;
        d (2e6 2e6 2e6);
        f (0 0 0);
        coordinateSystem { origin (0 0 0); e1 (1 0 0); e2 (0 1 0); }
    }
}
)");
    }
    // All cells are in the zone, so that the layers of a bed are alike.
    const Outcome mesh = test.runCommand("sed -i 's/(0 1 2 3 4 5 6 7)/& porous/' system/blockMeshDict && blockMesh");
    EXPECT_TRUE(mesh.succeeded()) << mesh.output;
    const Outcome outcome = test.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    if (voidFraction)
    {
        *voidFraction = test.layerMeans("voidFraction", test.times().back())[12];
    }
    return gradients(test)[12];
}

} // namespace

/// Fluid at rest under a uniform force per mass f, half of it in a bed: dp/dz = f everywhere. A source per volume of fluid
/// and particles would give f/eps in the bed, which is 11.1 of 5 m/s2, and no source 0. At the bed's surface, where the void
/// fraction changes by a half over two cells, the interpolation of products to faces leaves 0.14 %.
TEST(FluidSources, ForceOnFluidAtRestIsBalancedByItsPressureGradient)
{
    for (const std::string file : {"constant/fvOptions", "system/fvOptions"})
    {
        TestCase test;
        column(test, 0, Bed::lowerHalf);
        test.extraFiles[file] = options("push { type vectorSemiImplicitSource; selectionMode all; volumeMode specific; "
                                        "injectionRateSuSp { U ((0 0 5) 0); } }\n");
        const Outcome outcome = test.run();
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
        const Eigen::VectorXd voidFraction = test.layerMeans("voidFraction", test.times().back());
        EXPECT_LT(voidFraction[6], 0.6);
        EXPECT_GT(voidFraction[20], 0.99);
        expectAll(gradients(test), 5, 5e-3);
    }
}

/// Darcy's law: dp/dz = -nu d U, with U the velocity between the particles; with a bed of fixed particles it is added to the
/// bed's own gradient. Porous zones that are ignored give 0, and those that act on the mixture nu d U/eps.
TEST(FluidSources, PorousZoneHasDarcysPressureGradient)
{
    constexpr double velocity = 0.02;
    const double darcy = -kinematicViscosity * 2e6 * velocity;
    const double speck = gradientThrough(velocity, Bed::none, false);
    const double empty = gradientThrough(velocity, Bed::none, true) - speck;
    double voidFraction = 1;
    const double ofBed = gradientThrough(velocity, Bed::all, false);
    const double ofBoth = gradientThrough(velocity, Bed::all, true, &voidFraction);
    std::cout << "Darcy " << darcy << " m/s2, zone " << empty << ", bed " << ofBed << ", both " << ofBoth
              << ", void fraction " << voidFraction << std::endl;
    EXPECT_NEAR(empty / darcy, 1, 1e-4);
    EXPECT_LT(voidFraction, 0.6);
    EXPECT_NEAR((ofBoth - ofBed) / darcy, 1, 1e-3);
}

/// The limit is applied to the velocity that the pressure has corrected. Ignored, the fluid has 0.02 m/s.
TEST(FluidSources, LimitOfTheVelocity)
{
    TestCase test;
    column(test, 0.02, Bed::none);
    test.extraFiles["constant/fvOptions"] =
        options("slow { type limitVelocity; active yes; selectionMode all; max 0.015; }\n");
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const Eigen::MatrixXd U = test.field("U", test.times().back());
    EXPECT_NEAR(U.colwise().norm().maxCoeff(), 0.015, 1e-12);
}

/// A uniform concentration stays uniform in a bed that expands, and the registered flux alphaPhi is that of the fluid's
/// volume: as much leaves the column as enters it. phi, without the void fraction, differs from it at the inlet by 1/eps.
TEST(FluidSources, ScalarTransportAndAlphaPhi)
{
    TestCase test;
    column(test, 0.05, Bed::lowerHalf);
    test.coupling().set("forceModels", "(DiFeliceDrag gradPForce viscForce Archimedes)");
    test.dem.fixed = false;
    test.setTimes(0.04, 2e-4, 0.04);
    test.file("system/fvSchemes").set("divSchemes/div(phi,s)", "bounded Gauss upwind");
    test.solution().set("solvers/s", "{ solver smoothSolver; smoother symGaussSeidel; tolerance 1e-12; relTol 0; }");
    test.file("0/s") = FoamFile("volScalarField");
    test.file("0/s")
        .set("dimensions", "[0 0 0 0 0 0 0]")
        .set("internalField", "uniform 1")
        .set("boundaryField/walls/type", "zeroGradient")
        .set("boundaryField/inlet/type", "fixedValue")
        .set("boundaryField/inlet/value", "uniform 1")
        .set("boundaryField/outlet/type", "zeroGradient");
    test.control()
        .set("functions/tracer/type", "scalarTransport")
        .set("functions/tracer/libs", "(\"libsolverFunctionObjects.so\")")
        .set("functions/tracer/field", "s")
        .set("functions/tracer/D", "1e-9")
        .set("functions/tracer/resetOnStartUp", "no")
        .set("functions/tracer/writeControl", "writeTime");
    for (const std::string patch : {"inlet", "outlet"})
    {
        test.control()
            .set("functions/" + patch + "/type", "surfaceFieldValue")
            .set("functions/" + patch + "/libs", "(\"libfieldFunctionObjects.so\")")
            .set("functions/" + patch + "/regionType", "patch")
            .set("functions/" + patch + "/name", patch)
            .set("functions/" + patch + "/operation", "sum")
            .set("functions/" + patch + "/fields", "(alphaPhi phi)")
            .set("functions/" + patch + "/writeFields", "no")
            .set("functions/" + patch + "/writeControl", "timeStep");
    }
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const Eigen::MatrixXd s = test.field("s", test.times().back());
    EXPECT_LT((s.array() - 1).abs().maxCoeff(), 1e-9);
    const auto in = test.table("postProcessing/inlet/0/surfaceFieldValue.dat").back();
    const auto out = test.table("postProcessing/outlet/0/surfaceFieldValue.dat").back();
    const double area = test.box.size().x() * test.box.size().y();
    EXPECT_NEAR(in[2] / (-0.05 * area), 1, 1e-6);
    EXPECT_LT(std::abs(in[1] / in[2]), 0.8);
    // The particles' volume stays in the column.
    EXPECT_NEAR(-out[1] / in[1], 1, 1e-3);
    EXPECT_TRUE(std::filesystem::exists(test.path() / test.times().back() / "alphaPhi"));
}

} // namespace clepsydra::tests
