/// \file
/// Whole runs with cyclic patches and a periodic DEM box. A periodic case has no beginning, so that particles which pass
/// the ends of the box move as they do in its middle, with everything that acts on them.

#include "closures/dragLaws.h"
#include "support/testCase.h"
#include "tokens/exactText.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <regex>
#include <sstream>

namespace clepsydra::tests
{

namespace
{

using Axes = std::array<bool, 3>;

constexpr double width = 0.012;
constexpr int cellsAcross = 6;
constexpr double diameter = 1.5e-3;

std::string textOf(const Axes& axes)
{
    std::string text = "along ";
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
    {
        text += axes[axis] ? std::string(1, "xyz"[axis]) : "";
    }
    return text;
}

/// Equations are solved until nothing changes, because the order of the cells changes where particles are moved.
void solveTightly(TestCase& test)
{
    test.solution()
        .set("solvers/p", "{ solver PCG; preconditioner DIC; tolerance 1e-15; relTol 0; maxIter 400; }")
        .set("solvers/pFinal", "{ solver PCG; preconditioner DIC; tolerance 1e-15; relTol 0; maxIter 400; }")
        .set("solvers/\"U|UFinal\"", "{ solver smoothSolver; smoother symGaussSeidel; tolerance 1e-15; relTol 0; }");
}

/// Ten particles about the middle of a box, some of them closer than lubrication reaches, on their way to one side.
void swarm(TestCase& test, const Axes& axes)
{
    test.box.upper = Eigen::Vector3d::Constant(width);
    test.box.periodic = axes;
    test.cells = Eigen::Vector3i::Constant(cellsAcross);
    test.dem.diameter = diameter;
    test.dem.timeStep = 2e-5;
    const Eigen::Vector3d middle = Eigen::Vector3d::Constant(width / 2);
    test.dem.particles = simpleLattice(
        Box{middle - Eigen::Vector3d(1.7e-3, 1.7e-3, 1.7e-3), middle + Eigen::Vector3d(1.7e-3, 1.7e-3, 1.7e-3)},
        {2, 2, 2});
    jitter(test.dem.particles, 5e-5, 5);
    test.dem.particles.push_back(middle + Eigen::Vector3d(2.6e-3, 1e-4, 2e-4));
    test.dem.particles.push_back(middle - Eigen::Vector3d(2.7e-3, 1e-4, -3e-4));
    // They come nearer to each other, without touching.
    test.dem.more = "velocity all set 0.06 0.04 0.03\ngroup last id 10\nvelocity last set 0.07 0.04 0.03\n";
    test.dem.dumpEvery = 50;
    test.coupling()
        .set("constDiffSmoothingProps/bandwidth", "3e-3")
        .set("forceModels",
            "(DiFeliceDrag gradPForce viscForce Archimedes virtualMassForce SaffmanLiftForce lubricationForce)")
        .set("lubricationForceProps/roughness", "1e-5")
        .set("lubricationForceProps/reach", "0.2");
    if (axes[2])
    {
        test.coupling().set("meanPressureGradient", "balanceWeight");
    }
    solveTightly(test);
    test.setTimes(0.03, 1e-3, 0.03);
}

/// Moves the particles by half the box along its periodic axes. LIGGGHTS takes positions in its box only.
void moveByHalf(TestCase& test)
{
    for (Eigen::Vector3d& particle : test.dem.particles)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            particle[axis] = std::fmod(particle[axis] + (test.box.periodic[axis] ? width / 2 : 0), width);
        }
    }
}

/// Largest distance between particles of two runs of which the second is moved by half the box, in diameters.
double distance(const ParticleSnapshot& one, const ParticleSnapshot& moved, const Axes& axes)
{
    EXPECT_EQ(one.id, moved.id);
    EXPECT_EQ(one.step, moved.step);
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        for (Eigen::Index particle = 0; particle < one.position.cols(); ++particle)
        {
            double apart = moved.position(axis, particle) - one.position(axis, particle);
            if (axes[axis])
            {
                apart = std::remainder(apart - width / 2, width);
            }
            largest = std::max(largest, std::abs(apart) / diameter);
        }
    }
    return largest;
}

/// Largest difference between a field and the same of a run moved by half the box.
double difference(const Eigen::MatrixXd& one, const Eigen::MatrixXd& moved, const Axes& axes)
{
    const auto movedBy = [&](int place, std::size_t axis) {
        return axes[axis] ? (place + cellsAcross / 2) % cellsAcross : place;
    };
    const auto cell = [](int x, int y, int z) { return x + cellsAcross * (y + cellsAcross * z); };
    double largest = 0;
    for (int z = 0; z < cellsAcross; ++z)
    {
        for (int y = 0; y < cellsAcross; ++y)
        {
            for (int x = 0; x < cellsAcross; ++x)
            {
                largest = std::max(
                    largest, (one.col(cell(x, y, z)) - moved.col(cell(movedBy(x, 0), movedBy(y, 1), movedBy(z, 2))))
                                 .cwiseAbs()
                                 .maxCoeff());
            }
        }
    }
    return largest;
}

} // namespace

class PeriodicRun : public testing::TestWithParam<std::tuple<Axes, int>>
{};

/// A swarm that passes the ends of the box, in which LIGGGHTS moves its particles to the other side one after the other,
/// moves as one in the middle: with drag, pressure, added mass, lift and lubrication between particles on either side of
/// an end, on one rank and on two that have the ends between them. Lubrication or drag that do not see across differ by
/// tenths of a diameter.
TEST_P(PeriodicRun, AcrossTheEndsAsInTheMiddle)
{
    const auto& [axes, ranks] = GetParam();
    SCOPED_TRACE(textOf(axes) + " on " + std::to_string(ranks));
    TestCase middle;
    swarm(middle, axes);
    TestCase ends;
    swarm(ends, axes);
    moveByHalf(ends);
    for (TestCase* test : {&middle, &ends})
    {
        const Outcome outcome = test->run(test == &ends ? ranks : 1);
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
        EXPECT_TRUE(outcome.says("periodic       along")) << outcome.output;
    }
    const std::vector<ParticleSnapshot> inMiddle = middle.particleHistory();
    const std::vector<ParticleSnapshot> acrossEnds = ends.particleHistory();
    ASSERT_EQ(inMiddle.size(), acrossEnds.size());
    double largest = 0;
    for (std::size_t snapshot = 0; snapshot < inMiddle.size(); ++snapshot)
    {
        largest = std::max(largest, distance(inMiddle[snapshot], acrossEnds[snapshot], axes));
    }
    const auto apart = [&, of = axes](const char* name) {
        const Eigen::MatrixXd one = middle.field(name, "0.03");
        Eigen::MatrixXd moved = ends.field(name, "0.03");
        // The level of p is that of a cell.
        moved.row(0).array() += std::string(name) == "p" ? one.mean() - moved.mean() : 0;
        return difference(one, moved, of) / (one.colwise() - one.rowwise().mean()).cwiseAbs().maxCoeff();
    };
    std::cout << textOf(axes) << " on " << ranks << ": particles " << largest << " d, voidFraction "
              << apart("voidFraction") << ", U " << apart("U") << ", p " << apart("p") << " apart" << std::endl;
    EXPECT_LT(largest, 1e-8);
    EXPECT_LT(apart("voidFraction"), 1e-7);
    EXPECT_LT(apart("U"), 1e-6);
    EXPECT_LT(apart("p"), 1e-5);

    // They have passed the ends, and each other in the reach of lubrication.
    const Eigen::Matrix3Xd travelled = inMiddle.back().position - inMiddle.front().position;
    EXPECT_GT(travelled.row(0).minCoeff(), 0.2 * diameter);
    const nlohmann::json summary = ends.conservationSummary();
    EXPECT_LT(summary["solidVolumeError"].get<double>(), 1e-12);
    EXPECT_LT(summary["momentumError"].get<double>(), 1e-12);
    EXPECT_LT(summary["pressureForceError"].get<double>(), 1e-12);
    EXPECT_EQ(summary["particlesLost"].get<int>(), 0);
}

INSTANTIATE_TEST_SUITE_P(AxesAndRanks, PeriodicRun,
    testing::Values(std::make_tuple(Axes{true, false, false}, 1), std::make_tuple(Axes{true, true, false}, 2),
        std::make_tuple(Axes{true, true, true}, 1), std::make_tuple(Axes{true, true, true}, 2)));

/// A channel through which a mean pressure gradient drives water and particles is a channel twice as long with the
/// particles twice.
TEST(PeriodicChannel, EqualsOneTwiceAsLong)
{
    TestCase once;
    TestCase twice;
    for (TestCase* test : {&once, &twice})
    {
        swarm(*test, {true, false, false});
        test->coupling().set("meanPressureGradient", "(-500 0 0)");
    }
    twice.box.upper.x() *= 2;
    twice.cells.x() *= 2;
    const std::vector<Eigen::Vector3d> particles = twice.dem.particles;
    for (const Eigen::Vector3d& particle : particles)
    {
        twice.dem.particles.push_back(particle + width * Eigen::Vector3d::UnitX());
    }
    twice.dem.more = std::regex_replace(twice.dem.more, std::regex("id 10"), "id 10 20");
    for (TestCase* test : {&once, &twice})
    {
        const Outcome outcome = test->run();
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    }
    const ParticleSnapshot short_ = once.particleHistory().back();
    const ParticleSnapshot long_ = twice.particleHistory().back();
    const Eigen::Index count = short_.position.cols();
    ASSERT_EQ(long_.position.cols(), 2 * count);
    double apart = 0;
    for (Eigen::Index particle = 0; particle < 2 * count; ++particle)
    {
        Eigen::Vector3d difference = long_.position.col(particle) - short_.position.col(particle % count);
        difference.x() = std::remainder(difference.x(), width);
        apart = std::max(apart, difference.cwiseAbs().maxCoeff() / diameter);
    }
    const Eigen::MatrixXd U = once.field("U", "0.03");
    const Eigen::MatrixXd longU = twice.field("U", "0.03");
    double apartU = 0;
    for (Eigen::Index cell = 0; cell < longU.cols(); ++cell)
    {
        const Eigen::Index x = cell % (2 * cellsAcross);
        const Eigen::Index line = cell / (2 * cellsAcross);
        apartU =
            std::max(apartU, (longU.col(cell) - U.col(line * cellsAcross + x % cellsAcross)).cwiseAbs().maxCoeff());
    }
    std::cout << "particles " << apart << " d, U " << apartU / U.cwiseAbs().maxCoeff() << " apart" << std::endl;
    EXPECT_LT(apart, 1e-8);
    EXPECT_LT(apartU / U.cwiseAbs().maxCoeff(), 1e-6);
    // The gradient drives: 500 Pa/m in water at rest give 0.5 m/s2 for 0.03 s.
    EXPECT_GT(U.row(0).maxCoeff(), 0.01);
}

/// Water alone in a box that is periodic along the gradient, between plates: Poiseuille's profile, whose mean is
/// G h2/(12 mu), less the part of a speck's drag. A gradient that did not reach the flux between the cells would leave
/// them without flow.
TEST(PeriodicChannel, IsPoiseuillesFlow)
{
    constexpr double height = 2e-3;
    constexpr double viscosity = 1e-4;
    constexpr double gradient = 100;
    TestCase test;
    test.box.upper = {2e-3, 2e-3, height};
    test.box.periodic = {true, true, false};
    test.cells = {2, 2, 20};
    test.setFluid(1000, viscosity);
    test.setTimes(0.05, 1e-3, 0.05);
    test.dem.diameter = 1e-4;
    test.dem.particles = {{1e-3, 1e-3, 1e-3}};
    test.dem.fixed = true;
    test.coupling()
        .set("DEM/maxRayleighFraction", "1000")
        .set("forceModels", "(noDrag gradPForce viscForce Archimedes)")
        .set("constDiffSmoothingProps/bandwidth", "1e-3")
        .set("meanPressureGradient", "(" + exactText(-gradient) + " 0 0)");
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const double mean = test.layerMeans("U", test.times().back()).mean();
    EXPECT_NEAR(mean / (gradient * height * height / (12 * 1000 * viscosity)), 1, 0.005);
}

/// Stopped while particles pass the ends and resumed is never stopped, to the last digit: also where LIGGGHTS has left
/// particles beyond an end when the checkpoint was written.
TEST(PeriodicRun, StoppedAndResumedEqualsNeverStopped)
{
    TestCase through;
    TestCase stopped;
    for (TestCase* test : {&through, &stopped})
    {
        swarm(*test, {true, true, true});
        moveByHalf(*test);
        // Lists are built seldom, so that particles are outside for long.
        test->dem.more += "neighbor 0.001 bin\n";
        test->setTimes(0.03, 1e-3, 0.01);
        test->control()
            .set("writeFormat", "binary")
            .set("functions/height/type", "particleHeight")
            .set("functions/height/particle", "1")
            .set("functions/height/axis", "(1 0 0)")
            .set("functions/height/executeControl", "timeStep")
            .set("functions/height/executeInterval", "1")
            .set("functions/height/writeControl", "none");
    }
    const Outcome whole = through.run();
    ASSERT_TRUE(whole.succeeded()) << whole.output;
    stopped.control().set("endTime", "0.02");
    const Outcome first = stopped.run();
    ASSERT_TRUE(first.succeeded()) << first.output;
    const Outcome second = stopped.runCommand("echo \"endTime 0.03;\" >> system/controlDict && $SOLVER");
    ASSERT_TRUE(second.succeeded()) << second.output;
    EXPECT_TRUE(second.says("Resuming from the checkpoint of time 0.02")) << second.output;
    for (const char* field : {"U", "p", "voidFraction"})
    {
        EXPECT_TRUE(through.runCommand(TestCase::sameFile("0.03/" + std::string(field), stopped)).succeeded()) << field;
    }
    const ParticleSnapshot one = through.particleHistory().back();
    const ParticleSnapshot other = stopped.particleHistory().back();
    EXPECT_EQ(one.position, other.position);
    EXPECT_EQ(one.velocity, other.velocity);

    // The height of a particle that passes the end goes on: what it travels is the sum of its velocities.
    std::vector<std::vector<double>> rows = through.table("postProcessing/height/0/height.dat");
    ASSERT_EQ(rows.size(), 31U);
    bool outside = false;
    for (std::size_t row = 1; row < rows.size(); ++row)
    {
        EXPECT_NEAR(rows[row][1] - rows[row - 1][1], 0.5e-3 * (rows[row][2] + rows[row - 1][2]), 2e-6);
        outside |= rows[row][1] > width;
    }
    EXPECT_TRUE(outside);
    const auto resumedRows = stopped.table("postProcessing/height/0.02/height.dat");
    ASSERT_FALSE(resumedRows.empty());
    EXPECT_EQ(resumedRows.back()[1], rows.back()[1]);
}

namespace
{

constexpr double settlingDiameter = 1e-3;

/// Particles on a lattice that fills a box periodic in all directions.
void settlingLattice(TestCase& test, const std::string& model)
{
    test.box.upper = Eigen::Vector3d::Constant(width);
    test.box.periodic = {true, true, true};
    test.cells = Eigen::Vector3i::Constant(cellsAcross);
    test.dem.diameter = settlingDiameter;
    test.dem.timeStep = 2e-5;
    test.dem.particles = bodyCentredLattice(test.box, {cellsAcross, cellsAcross, cellsAcross});
    test.dem.dumpEvery = 500;
    test.setFluid(1000, 1e-5);
    test.coupling()
        .set("modelType", model)
        .set("forceModels",
            model == "A" ? "(DiFeliceDrag gradPForce viscForce Archimedes)" : "(DiFeliceDrag Archimedes)")
        .set("constDiffSmoothingProps/bandwidth", "4e-3")
        .set("meanPressureGradient", "balanceWeight");
    solveTightly(test);
    test.setTimes(0.1, 1e-3, 0.1);
}

} // namespace

/// A lattice of particles that settles in a box without walls keeps the momentum of particles and water together, and
/// reaches the velocity at which the drag law carries the weight that buoyancy of the suspension leaves: eps (rho_p -
/// rho_f) V g in model A. Without the mean pressure gradient both would fall by g for 0.1 s, 0.3 m/s; with one on the
/// water only, the balance would be off by the part of the particles.
TEST(PeriodicSettling, KeepsMomentumAndReachesTheLawsVelocity)
{
    for (const std::string model : {"A", "B"})
    {
        SCOPED_TRACE(model);
        TestCase test;
        settlingLattice(test, model);
        const Outcome outcome = test.run();
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
        const ParticleSnapshot particles = test.particleHistory().back();
        const Eigen::MatrixXd U = test.field("U", "0.1");
        const Eigen::MatrixXd eps = test.field("voidFraction", "0.1");
        const double volume = std::pow(width, 3);
        const double mass = test.dem.density * M_PI / 6 * std::pow(settlingDiameter, 3);
        const auto count = static_cast<double>(particles.velocity.cols());
        const double solid = count * mass / test.dem.density / volume;
        EXPECT_NEAR(eps.mean(), 1 - solid, 1e-12);
        const double ofParticles = mass * particles.velocity.row(2).sum();
        const double ofWater =
            1000 * volume / static_cast<double>(U.cols()) * (eps.row(0).cwiseProduct(U.row(2))).sum();
        // What is between the two.
        const std::string before = "of which semi-implicit (";
        std::istringstream pending(outcome.output.substr(outcome.output.rfind(before) + before.size()));
        Eigen::Vector3d semiImplicit;
        pending >> semiImplicit.x() >> semiImplicit.y() >> semiImplicit.z();
        const double all = ofParticles + ofWater + semiImplicit.z();
        const double impulse = count * mass * (1 - 1000 / test.dem.density) * 9.81 * 0.1;
        std::cout << "model " << model << ": momentum " << all / impulse << " of the weight's impulse, particles "
                  << ofParticles / impulse << ", water " << ofWater / impulse << std::endl;
        EXPECT_LT(std::abs(all) / impulse, 1e-3);

        const double slip = U.row(2).mean() - particles.velocity.row(2).mean();
        const double voidFraction = 1 - solid;
        const closures::DiFeliceDrag law;
        const double drag = law({settlingDiameter, voidFraction, std::log(voidFraction), slip, 1000, 1e-2}) * slip;
        const double weight = mass * (1 - 1000 / test.dem.density) * 9.81;
        std::cout << "solid fraction " << solid << ", slip " << slip << " m/s, drag over weight " << drag / weight
                  << std::endl;
        EXPECT_NEAR(drag / (voidFraction * weight), 1, 2e-3);
    }
}

} // namespace clepsydra::tests
