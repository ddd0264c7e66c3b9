/// \file
/// Particles that overlap the subdomains of three or more ranks at once, with decompositions of all kinds.

#include "support/testCase.h"
#include "tokens/exactText.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <set>

namespace clepsydra::tests
{

namespace
{

constexpr double diameter = 0.002;
constexpr double interval = 1e-3;
constexpr double stopped = 0.012;
constexpr double end = 0.024;
const char* const endName = "0.024";

struct Decomposition
{
    const char* name;
    int ranks;
    const char* method;
    /// "", or what the sub-dictionary of the method says
    const char* coefficients;
    /// Cells count by the particles in them.
    bool weighedByParticles;
};

/// 75 particles about the middle of a box of water, where the corners of the ranks meet; they fall and drift.
void cloudAmongRanks(TestCase& test)
{
    test.box.upper = {0.02, 0.02, 0.04};
    test.cells = {8, 8, 16};
    test.setTimes(end, interval, stopped);
    const std::string tolerance = " tolerance 1e-13; relTol 0; }";
    for (const std::string field : {"p", "pFinal"})
    {
        test.solution().set("solvers/" + field, "{ solver PCG; preconditioner DIC;" + tolerance);
    }
    test.solution().set("solvers/\"U|UFinal\"", "{ solver smoothSolver; smoother symGaussSeidel;" + tolerance);
    test.dem.diameter = diameter;
    test.dem.particles = simpleLattice(Box{{0.004, 0.004, 0.015}, {0.016, 0.016, 0.026}}, {5, 5, 3});
    jitter(test.dem.particles, 5e-5, 1);
    test.dem.timeStep = 4e-5;
    test.dem.dumpEvery = 25;
    test.dem.more = "velocity all set 0.05 0.03 0 units box";
}

Eigen::Vector3i cellOf(const TestCase& test, const Eigen::Vector3d& position)
{
    const Eigen::Array3d part = (position - test.box.lower).array() / test.box.size().array();
    return (part * test.cells.cast<double>().array()).floor().cast<int>();
}

Eigen::Index cellIndex(const TestCase& test, const Eigen::Vector3i& cell)
{
    return cell.x() + test.cells.x() * (cell.y() + Eigen::Index(test.cells.y()) * cell.z());
}

/// One for the cell, ten for each particle whose centre is in it at the start.
std::string particleWeights(const TestCase& test)
{
    std::vector<int> weights(static_cast<std::size_t>(test.cells.prod()), 1);
    for (const Eigen::Vector3d& particle : test.dem.particles)
    {
        weights[static_cast<std::size_t>(cellIndex(test, cellOf(test, particle)))] += 10;
    }
    std::string text = "nonuniform List<scalar> " + std::to_string(weights.size()) + '(';
    for (const int weight : weights)
    {
        text += std::to_string(weight) + ' ';
    }
    return text + ')';
}

void decompose(TestCase& test, const Decomposition& decomposition)
{
    FoamFile& dict = test.file("system/decomposeParDict");
    dict.set("numberOfSubdomains", exactText(decomposition.ranks)).set("method", decomposition.method);
    if (*decomposition.coefficients)
    {
        dict.set(decomposition.method + std::string("Coeffs"), decomposition.coefficients);
    }
    if (decomposition.weighedByParticles)
    {
        dict.set("weightField", "particleWeight");
        test.file("0/particleWeight") = FoamFile("volScalarField");
        test.file("0/particleWeight")
            .set("dimensions", "[0 0 0 0 0 0 0]")
            .set("internalField", particleWeights(test))
            .set("boundaryField/walls/type", "zeroGradient");
    }
}

/// How many ranks' cells a particle's sphere touches, for the particle that touches most, and how many particles touch three or more.
std::pair<std::size_t, int> ranksTouched(
    const TestCase& test, const ParticleSnapshot& particles, const Eigen::MatrixXd& rankOf)
{
    const Eigen::Array3d cellSize = test.box.size().array() / test.cells.cast<double>().array();
    const double radius = 0.5 * diameter;
    std::size_t most = 0;
    int threeOrMore = 0;
    for (Eigen::Index particle = 0; particle < particles.position.cols(); ++particle)
    {
        const Eigen::Vector3d centre = particles.position.col(particle);
        std::set<double> ranks;
        for (Eigen::Index cell = 0; cell < rankOf.cols(); ++cell)
        {
            const Eigen::Index across = test.cells.x();
            const Eigen::Array3d index(static_cast<double>(cell % across),
                static_cast<double>(cell / across % test.cells.y()),
                static_cast<double>(cell / (across * test.cells.y())));
            const Eigen::Vector3d low = test.box.lower + (index * cellSize).matrix();
            const Eigen::Vector3d nearest = centre.cwiseMax(low).cwiseMin(low + cellSize.matrix());
            if ((nearest - centre).norm() < 0.999 * radius)
            {
                ranks.insert(rankOf(0, cell));
            }
        }
        most = std::max(most, ranks.size());
        threeOrMore += ranks.size() >= 3;
    }
    return {most, threeOrMore};
}

double largestDifference(const ParticleSnapshot& a, const ParticleSnapshot& b)
{
    EXPECT_EQ(a.id, b.id);
    return (a.position - b.position).colwise().norm().maxCoeff() / diameter;
}

} // namespace

class ManyRanks : public testing::TestWithParam<Decomposition>
{};

// The same on one rank and on many, where particles touch cells of three ranks and more: particles and fields until the end, to the
// bounds of serialAndTwoRanks.cpp before contacts; the cells hold the particles' volume to rounding; and a run that is stopped
// on the same ranks, and resumed, ends as the one that was not. An exchange that knows of two hosts for a particle, or adds up
// its shares over some ranks only, puts parts of such a particle elsewhere. One that sent a particle to the ranks that its sphere
// touches, and not to those that its shares reach, beyond the edge where four ranks meet, was 5e-6 d off.
TEST_P(ManyRanks, EqualOne)
{
    const Decomposition& decomposition = GetParam();
    TestCase serial;
    TestCase parallel;
    for (TestCase* test : {&serial, &parallel})
    {
        cloudAmongRanks(*test);
    }
    decompose(parallel, decomposition);
    const std::string onRanks = "mpirun -np " + std::to_string(decomposition.ranks) + " $SOLVER -parallel";
    const Outcome alone = serial.run();
    ASSERT_TRUE(alone.succeeded()) << alone.output;
    Outcome together = parallel.runCommand("blockMesh && decomposePar -cellDist && " + onRanks + " && reconstructPar");
    ASSERT_TRUE(together.succeeded()) << together.output;

    const auto one = serial.particleHistory();
    const auto many = parallel.particleHistory();
    ASSERT_EQ(one.size(), static_cast<std::size_t>(std::lround(end / interval)) + 1);
    ASSERT_EQ(many.size(), one.size());
    const Eigen::MatrixXd rankOf = parallel.field("cellDist", "0");
    EXPECT_EQ(rankOf.maxCoeff(), decomposition.ranks - 1);
    std::size_t mostRanks = 0;
    int threeOrMore = 0;
    double apart = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
    {
        const auto [most, particles] = ranksTouched(parallel, many[i], rankOf);
        mostRanks = std::max(mostRanks, most);
        threeOrMore = std::max(threeOrMore, particles);
        apart = std::max(apart, largestDifference(one[i], many[i]));
    }
    std::cout << decomposition.name << ": " << threeOrMore << " particles on three ranks or more, at most on "
              << mostRanks << "; " << apart << " d apart from one rank" << std::endl;
    EXPECT_GE(threeOrMore, 3);
    EXPECT_LT(apart, 1e-8);
    EXPECT_GT((one.back().position - one.front().position).colwise().norm().minCoeff(), 0.5 * diameter);

    const double particleVolume = static_cast<double>(serial.dem.particles.size()) * M_PI / 6 * std::pow(diameter, 3);
    const double cellVolume = serial.box.size().prod() / serial.cells.prod();
    EXPECT_NEAR((1 - parallel.field("voidFraction", endName).array()).sum() * cellVolume / particleVolume, 1, 1e-12);
    EXPECT_LT(parallel.conservationSummary()["solidVolumeError"], 1e-13);
    EXPECT_EQ(parallel.conservationSummary()["ranks"], decomposition.ranks);
    for (const char* name : {"voidFraction", "U"})
    {
        const Eigen::MatrixXd expected = serial.field(name, endName);
        const double largest = expected.colwise().norm().maxCoeff();
        EXPECT_LT((parallel.field(name, endName) - expected).colwise().norm().maxCoeff() / largest, 1e-9) << name;
    }

    TestCase resumed;
    cloudAmongRanks(resumed);
    decompose(resumed, decomposition);
    const std::string asked = "cp system/controlDict asked && echo 'endTime 0.012;' >> system/controlDict && ";
    together = resumed.runCommand(
        asked + "blockMesh && decomposePar && " + onRanks + " && cp asked system/controlDict && " + onRanks);
    ASSERT_TRUE(together.succeeded()) << together.output;
    EXPECT_TRUE(together.says("Resuming from the checkpoint of time 0.012")) << together.output;
    const double apartResumed = largestDifference(resumed.particleHistory().back(), many.back());
    std::cout << "resumed: " << apartResumed << " d apart from never stopped" << std::endl;
    EXPECT_LT(apartResumed, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Decompositions, ManyRanks,
    testing::Values(Decomposition{"Box", 4, "simple", "{ n (2 1 2); delta 0.001; }", false},
        Decomposition{"Scotch", 5, "scotch", "", false}, Decomposition{"WeighedByParticles", 4, "scotch", "", true}),
    [](const testing::TestParamInfo<Decomposition>& decomposition) { return decomposition.param.name; });

} // namespace clepsydra::tests
