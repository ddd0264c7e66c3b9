/// \file
/// The same case in serial and on two ranks.

#include "support/testCase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace
{

using namespace clepsydra::tests;

constexpr double diameter = 0.002;
constexpr double interval = 1e-3;
constexpr int intervals = 350;
constexpr double rankBoundary = 0.01;

/// Sixty particles in water that drift through the plane between the two ranks, x = .01 m, while they fall to the floor.
void fillIn(TestCase& test)
{
    test.box.upper = {0.02, 0.02, 0.04};
    test.cells = {8, 8, 16};
    test.setTimes(intervals * interval, interval, 0.025);
    const std::string tolerance = " tolerance 1e-13; relTol 0; }";
    for (const std::string field : {"p", "pFinal"})
    {
        test.solution().set("solvers/" + field, "{ solver PCG; preconditioner DIC;" + tolerance);
    }
    test.solution().set("solvers/\"U|UFinal\"", "{ solver smoothSolver; smoother symGaussSeidel;" + tolerance);
    Box cloud;
    cloud.lower = {0.003, 0.004, 0.026};
    cloud.upper = {0.0155, 0.016, 0.036};
    test.dem.diameter = diameter;
    test.dem.particles = simpleLattice(cloud, {5, 4, 3});
    jitter(test.dem.particles, 5e-5, 1);
    test.dem.timeStep = 4e-5;
    test.dem.dumpEvery = 25;
    test.dem.more = "velocity all set 0.1 0 0 units box";
}

/// Whether particles touch each other or a wall.
bool anyContact(const ParticleSnapshot& particles, const Box& box)
{
    const double radius = 0.5 * diameter;
    for (Eigen::Index i = 0; i < particles.position.cols(); ++i)
    {
        const Eigen::Vector3d x = particles.position.col(i);
        if ((x - box.lower).minCoeff() < radius || (box.upper - x).minCoeff() < radius)
        {
            return true;
        }
        for (Eigen::Index j = 0; j < i; ++j)
        {
            if ((x - particles.position.col(j)).norm() < diameter)
            {
                return true;
            }
        }
    }
    return false;
}

/// Largest difference, in parts of the largest value. Pressure has no absolute level: means are taken off.
double fieldDifference(const TestCase& a, const TestCase& b, const std::string& name, const std::string& time)
{
    Eigen::MatrixXd first = a.field(name, time);
    Eigen::MatrixXd second = b.field(name, time);
    if (name == "p")
    {
        first.array() -= first.mean();
        second.array() -= second.mean();
    }
    return (first - second).colwise().norm().maxCoeff() / first.colwise().norm().maxCoeff();
}

/// Particles and fields of a settling cloud are the same in serial and on two ranks, although 24 of 60 particles change rank on
/// their way. A program that did nothing would agree with itself, so particles must have fallen, crossed and touched; one
/// that lost a particle's force, volume or contact at the boundary between the ranks would differ by parts of a diameter.
///
/// For how long the comparison means something: in free fall drag damps differences, and what the order of sums and the
/// solvers' tolerance (1e-13 here) leave stays below the dump's resolution of 5e-12 d until the first contact at .156 s.
/// Contacts are chaotic: a collision multiplies a difference by some times the free path over d. Measured: a factor of
/// ten every 12 ms, so that particles agree to 1e-6 d until .25 s, and to 1e-2 d at .32 s; soon after that single particles can no
/// longer be compared. What remains are means: the mean height stays within .1 d.
TEST(SerialAndTwoRanks, SettlingCloud)
{
    TestCase serial;
    TestCase parallel;
    fillIn(serial);
    fillIn(parallel);
    const Outcome alone = serial.run();
    ASSERT_TRUE(alone.succeeded()) << alone.output;
    const Outcome together = parallel.run(2);
    ASSERT_TRUE(together.succeeded()) << together.output;
    ASSERT_EQ(parallel.conservationSummary()["ranks"], 2);

    const auto one = serial.particleHistory();
    const auto two = parallel.particleHistory();
    ASSERT_EQ(one.size(), static_cast<std::size_t>(intervals + 1));
    ASSERT_EQ(two.size(), one.size());
    double firstContact = -1;
    double largestBefore = 0;
    double largestSoonAfter = 0;
    Eigen::Index crossed = 0;
    std::cout << "time [s], largest difference of a particle's position [d]:\n";
    for (std::size_t i = 0; i < one.size(); ++i)
    {
        const double time = static_cast<double>(i) * interval;
        ASSERT_EQ(one[i].id, two[i].id);
        const double difference = (one[i].position - two[i].position).colwise().norm().maxCoeff() / diameter;
        if (firstContact < 0)
        {
            firstContact = anyContact(one[i], serial.box) ? time : -1;
            largestBefore = std::max(largestBefore, difference);
            crossed = (one[0].position.row(0).array() < rankBoundary && one[i].position.row(0).array() > rankBoundary)
                          .count();
        }
        else if (time < firstContact + 0.04)
        {
            largestSoonAfter = std::max(largestSoonAfter, difference);
        }
        if (i % 10 == 0)
        {
            std::cout << "    " << time << "  " << difference << (firstContact < 0 ? "" : "  after contacts") << '\n';
        }
    }
    std::cout << "first contact at " << firstContact << " s, " << crossed << " particles had changed rank by then\n";
    EXPECT_GT(firstContact, 0.1);
    EXPECT_LT(firstContact, intervals * interval - 0.04);
    EXPECT_GT(crossed, 10);
    EXPECT_LT(largestBefore, 1e-8);
    EXPECT_LT(largestSoonAfter, 1e-6);
    const double fallen = one.front().position.row(2).mean() - one.back().position.row(2).mean();
    EXPECT_GT(fallen, 5 * diameter);
    EXPECT_NEAR(one.back().position.row(2).mean(), two.back().position.row(2).mean(), 0.1 * diameter);

    std::cout << "time [s], largest difference of voidFraction, U, p, in parts of the largest value:\n";
    for (const std::string& time : serial.times())
    {
        std::cout << "    " << time;
        for (const char* name : {"voidFraction", "U", "p"})
        {
            const double difference = fieldDifference(serial, parallel, name, time);
            std::cout << "  " << difference;
            if (std::stod(time) < firstContact)
            {
                EXPECT_LT(difference, 1e-9) << name << " at " << time << " s";
            }
        }
        std::cout << std::endl;
    }
    std::cout << alone.wallSeconds << " s in serial, " << together.wallSeconds << " s on two ranks" << std::endl;
}

} // namespace
