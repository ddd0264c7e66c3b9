/// \file
/// The program with the models that are not its defaults.

#include "support/testCase.h"

#include "closures/addedMass.h"
#include "closures/constants.h"
#include "closures/ergun.h"
#include "tokens/exactText.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace clepsydra::tests
{

namespace
{

/// The momentum that particles and fluid exchanged balances (the run itself stops above 1e-9).
void expectBalance(const TestCase& test)
{
    EXPECT_LT(std::abs(test.conservationSummary().at("momentumError").get<double>()), 1e-9);
}

/// dp [Pa] along a column of fixed particles of 1 mm, void fraction .451335, and water's flow through it.
double pressureDropOfFixedBed(const std::string& modelType, const std::string& momentumModel)
{
    constexpr double diameter = 1e-3;
    constexpr double voidFraction = 0.451335;
    constexpr double length = 0.0078;
    const Eigen::Vector3i lattice(3, 3, 6);
    const double solid = 2 * lattice.prod() * closures::pi / 6 * diameter * diameter * diameter;
    const double side = std::sqrt(solid / ((1 - voidFraction) * length));
    TestCase test;
    test.setFluid(10, 1.5e-4);
    test.box.upper = {side, side, length};
    test.cells = lattice;
    test.setThroughFlow("uniform (0 0 " + exactText(0.02 / voidFraction) + ")");
    // An explicit source of momentum is stable for coupling steps up to 2 U/(dp/(rho L)), 0.06 ms here.
    const bool implicit = momentumModel == "implicitCouple";
    const double endTime = implicit ? 0.02 : 0.004;
    test.setTimes(endTime, implicit ? 2e-4 : 2e-5, endTime);
    test.coupling()
        .set("modelType", modelType)
        .set("momCoupleModels", '(' + momentumModel + ')')
        .set("forceModels",
            modelType == "A" ? "(GidaspowDrag gradPForce viscForce Archimedes)" : "(GidaspowDrag Archimedes)")
        .set("constDiffSmoothingProps/bandwidth", 3 * diameter);
    test.dem.diameter = diameter;
    test.dem.density = 2000;
    test.dem.particles = bodyCentredLattice(test.box, lattice);
    test.dem.fixed = true;
    test.dem.timeStep = 2e-5;
    const Outcome outcome = test.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    expectBalance(test);
    const Eigen::VectorXd p = 10 * test.layerMeans("p", test.times().back());
    return (p[0] - p[p.size() - 1]) * static_cast<double>(p.size()) / static_cast<double>(p.size() - 1) / length;
}

/// Ergun's gradient, 230.5/.0156 Pa/m at .02 m/s, in model A and in model B, with the drag implicit and explicit in the
/// fluid's equation. Model B's fluid with model A's drag shows .45 of it, model A's with model B's 2.2 times.
TEST(FixedBed, PressureDropIsErgunsInBothModels)
{
    const double ergun = closures::ergunPressureGradient({1e-3, 0.451335, 10, 1.5e-3}, 0.02);
    for (const std::string modelType : {"A", "B"})
    {
        for (const std::string momentum : {"implicitCouple", "explicitCouple"})
        {
            const double measured = pressureDropOfFixedBed(modelType, momentum);
            std::cout << "model " << modelType << ", " << momentum << ": " << measured << " Pa/m, Ergun " << ergun
                      << std::endl;
            EXPECT_NEAR(measured / ergun, 1, 0.03) << modelType << ' ' << momentum;
        }
    }
}

/// Water through fixed particles with Zuber's added mass, 2.4 times the mass of the water between the particles: the reaction
/// to DU/Dt of the last coupling step would multiply waves of shear by that in every step. The flow finds ways between the
/// particles of the lattice also without added mass, which only makes it slower to do so.
TEST(FixedBed, ZubersAddedMassDoesNotGrow)
{
    double acrossWithout = 0;
    for (const bool hasAddedMass : {false, true})
    {
        TestCase test;
        test.setFluid(1000, 1e-6);
        test.box.upper = {3.72126e-3, 3.72126e-3, 7.44252e-3};
        test.cells = {6, 6, 12};
        test.setThroughFlow("uniform (0 0 0.04)");
        test.setTimes(0.01, 1e-4, 0.01);
        test.coupling()
            .set("forceModels", "(GidaspowDrag gradPForce viscForce Archimedes)")
            .set("constDiffSmoothingProps/bandwidth", "1e-3");
        if (hasAddedMass)
        {
            test.coupling()
                .set("forceModels", "(GidaspowDrag gradPForce viscForce Archimedes virtualMassForce)")
                .set("virtualMassForceProps/law", "Zuber");
        }
        test.dem.diameter = 1e-3;
        test.dem.particles = bodyCentredLattice(test.box, {3, 3, 6});
        test.dem.fixed = true;
        test.dem.timeStep = 1e-5;
        const Outcome outcome = test.run();
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
        expectBalance(test);
        const Eigen::MatrixXd velocity = test.field("U", test.times().back());
        const double across = velocity.topRows(2).cwiseAbs().maxCoeff();
        EXPECT_NEAR(velocity.row(2).mean(), 0.04, 0.004);
        if (hasAddedMass)
        {
            EXPECT_LT(across, acrossWithout);
        }
        acrossWithout = across;
    }
}

struct Start
{
    double mean; // over the first 2 ms [m/s2], downwards
    double largestSpeed;
    double lastSpeed;
};

/// A particle of 2 mm released in water that the program solves, smoothed over 3 d.
Start release(double density, double seconds, const std::string& forces)
{
    TestCase test;
    test.box.upper = {0.04, 0.04, 0.06};
    test.cells = {10, 10, 15};
    test.coupling().set("forceModels", forces);
    test.setTimes(seconds, 5e-4, seconds);
    test.dem.density = density;
    test.dem.timeStep = 1.25e-5;
    test.dem.particles = {{0.0203, 0.0197, 0.03}};
    test.dem.dumpEvery = 40;
    const Outcome outcome = test.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    if (!outcome.succeeded())
    {
        return {};
    }
    expectBalance(test);
    const auto history = test.particleHistory();
    Start start{-history[4].velocity(2, 0) / 2e-3, 0, -history.back().velocity(2, 0)};
    for (const ParticleSnapshot& snapshot : history)
    {
        start.largestSpeed = std::max(start.largestSpeed, std::abs(snapshot.velocity(2, 0)));
    }
    return start;
}

/// Glass starts with 4.97 m/s2 (5.95 without added mass), less what drag takes within 2 ms, some 2 %. The water around
/// it is pushed along, so that the particle in the program gains a little on the formula.
TEST(AddedMass, SlowsTheStartOfAParticleInTheProgram)
{
    const double expected = closures::accelerationFromRest(9.81, 1000, 2540, 0.5);
    const Start with = release(2540, 0.02, "(DiFeliceDrag gradPForce viscForce Archimedes virtualMassForce)");
    const Start without = release(2540, 0.02, "(DiFeliceDrag gradPForce viscForce Archimedes)");
    std::cout << "start: " << with.mean << " m/s2, formula " << expected << "; without added mass " << without.mean
              << std::endl;
    EXPECT_NEAR(with.mean / expected, 1, 0.04);
    EXPECT_NEAR(without.mean / closures::accelerationFromRest(9.81, 1000, 2540, 0), 1, 0.04);
}

/// Particles of 1.05 and of 0.5 of the water's density settle and rise steadily, with the added mass taken implicitly on the
/// particle and given back to water that is solved: no oscillation drives them beyond their last speed.
TEST(AddedMass, IsStableNearAndBelowTheWatersDensity)
{
    for (const double density : {1050.0, 500.0})
    {
        const Start start = release(density, 0.08, "(DiFeliceDrag gradPForce viscForce Archimedes virtualMassForce)");
        std::cout << density << " kg/m3: start " << start.mean << " m/s2, speed at 80 ms " << start.lastSpeed
                  << ", largest " << start.largestSpeed << " m/s" << std::endl;
        EXPECT_EQ(start.lastSpeed > 0, density > 1000);
        EXPECT_LT(start.largestSpeed, 1.02 * std::abs(start.lastSpeed));
        EXPECT_NEAR(start.mean / closures::accelerationFromRest(9.81, 1000, density, 0.5), 1, 0.08);
    }
}

/// With all four terms left out a particle in water falls as in a vacuum, and the log says what is missing and what is
/// solved. A word that left its force in would slow it down by a third.
TEST(LeftOut, TermsActNoMore)
{
    TestCase test;
    test.cells = {8, 8, 16};
    test.coupling().set("forceModels", "(noDrag noPressureGradient noViscousStress noBuoyancy)");
    test.setTimes(0.01, 1e-3, 0.01);
    test.dem.timeStep = 2e-5;
    test.dem.particles = {{0.0103, 0.0097, 0.03}};
    test.dem.dumpEvery = 500;
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    EXPECT_NEAR(test.particleHistory().back().velocity(2, 0), -9.81 * 0.01, 1e-9);
    EXPECT_TRUE(outcome.says("rho_f eps (dU/dt + U . grad(U)) = - eps grad(p) + div(tau) - S")) << outcome.output;
    for (const std::string word : {"noDrag", "noPressureGradient", "noViscousStress", "noBuoyancy"})
    {
        EXPECT_TRUE(outcome.says(", by " + word)) << outcome.output;
    }
}

/// 105 particles that fall through water with every force that there is, spread by the Gaussian model.
void fallingCloud(TestCase& test)
{
    test.box.upper = {0.016, 0.008, 0.024};
    test.cells = {8, 4, 12};
    test.coupling()
        .set("forceModels", "(DiFeliceDrag gradPForce viscForce Archimedes virtualMassForce SaffmanLiftForce "
                            "MagnusLiftForceOesterle lubricationForce)")
        .set("virtualMassForceProps/law", "Zuber")
        .set("lubricationForceProps/roughness", "2e-6")
        .set("lubricationForceProps/walls", "( ((0 0 0) (0 0 1)) )")
        .set("voidFractionModel", "Gaussian")
        .set("GaussianProps/bandwidth", "1.5e-3");
    Box cloud = test.box;
    cloud.lower.z() = 0.002;
    cloud.upper.z() = 0.014;
    test.dem.particles = simpleLattice(cloud, {7, 3, 5});
    jitter(test.dem.particles, 1e-4, 3);
    test.dem.timeStep = 2e-5;
    test.dem.dumpEvery = 500;
}

/// All forces at once, with a Gaussian void fraction, on one rank and on two: the particles fall alike (to solver tolerance;
/// 1e-4 of a diameter after 20 ms) and the momentum balances. Forces that need the fluid's acceleration or curl, or
/// pairs across ranks, and miss them on one side of the boundary, move the particles near it by more.
TEST(AllForces, ActAlikeOnOneRankAndOnTwo)
{
    std::vector<ParticleSnapshot> last;
    for (const int ranks : {1, 2})
    {
        TestCase test;
        fallingCloud(test);
        test.setTimes(0.02, 5e-4, 0.02);
        const Outcome outcome = test.run(ranks);
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
        expectBalance(test);
        last.push_back(test.particleHistory().back());
    }
    const double moved = (last[1].position - last[0].position).colwise().norm().maxCoeff();
    std::cout << "largest distance between one rank's particles and two ranks' " << moved << " m" << std::endl;
    EXPECT_LT(moved, 1e-4 * 0.002);
    EXPECT_GT(last[0].velocity.colwise().norm().minCoeff(), 1e-3);
}

/// With every force a run that is stopped and resumed equals the one that was not: 1e-9 of a diameter after 500 DEM
/// steps from the checkpoint. Without DU/Dt in the checkpoint the added mass differs at once.
TEST(AllForces, SurviveAStop)
{
    std::vector<ParticleSnapshot> last;
    for (const bool stop : {false, true})
    {
        TestCase test;
        fallingCloud(test);
        test.control().set("writeFormat", "binary");
        test.setTimes(stop ? 0.01 : 0.02, 5e-4, 0.01);
        Outcome outcome = test.run();
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
        if (stop)
        {
            outcome = test.runCommand("echo \"endTime 0.02;\" >> system/controlDict && $SOLVER");
            ASSERT_TRUE(outcome.succeeded()) << outcome.output;
            EXPECT_TRUE(outcome.says("Resuming from the checkpoint of time 0.01")) << outcome.output;
        }
        last.push_back(test.particleHistory().back());
    }
    ASSERT_EQ(last[0].step, last[1].step);
    const double apart = (last[1].position - last[0].position).colwise().norm().maxCoeff() / 0.002;
    std::cout << apart << " d after 500 steps from the checkpoint" << std::endl;
    EXPECT_LT(apart, 1e-9);
}

} // namespace

} // namespace clepsydra::tests
