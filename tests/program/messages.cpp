/// \file
/// What limits the number of ranks: messages, bytes and memory of a rank, counted on 2, 4 and 8 ranks of one machine.
/// No time is measured here.

#include "support/testCase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <regex>

namespace clepsydra::tests
{

namespace
{

constexpr double diameter = 0.002;
constexpr double interval = 1e-4;

/// Particles that lie loosely all over a box of water: the more ranks, the fewer particles and cells has one of them.
void bedInABox(TestCase& test, const std::string& boxes, double writeInterval)
{
    test.box.upper = {0.032, 0.032, 0.064};
    test.cells = {16, 16, 32};
    test.setTimes(4 * interval, interval, writeInterval);
    // What the fluid's solvers send is not counted here: let them end early.
    for (const std::string field : {"p", "pFinal"})
    {
        test.solution().set(
            "solvers/" + field, "{ solver PCG; preconditioner DIC; tolerance 1e-3; relTol 0; maxIter 3; }");
    }
    test.coupling().set("conservationCheck/continuityTolerance", "1");
    Box particles = test.box;
    particles.upper.z() = 0.06;
    test.dem.diameter = diameter;
    test.dem.particles = simpleLattice(particles, {10, 10, 20});
    jitter(test.dem.particles, 5e-5, 1);
    test.dem.timeStep = interval / 3;
    test.file("system/decomposeParDict")
        .set("method", "simple")
        .set("simpleCoeffs", "{ n " + boxes + "; delta 0.001; }");
}

/// Of all ranks, by name of the phase.
struct Counts
{
    nlohmann::json ofRanks = nlohmann::json::array();
    int sweeps = 0;
    /// The smallest of the files of their particles.
    double particlesFile = 0;
    /// What the program says of itself.
    nlohmann::json summary;

    double largest(const std::string& phase, const std::string& quantity) const
    {
        double most = 0;
        for (const nlohmann::json& ofRank : ofRanks)
        {
            most = std::max(most, ofRank["phases"][phase][quantity].get<double>());
        }
        return most;
    }

    double largestMemory() const
    {
        double most = 0;
        for (const nlohmann::json& ofRank : ofRanks)
        {
            most = std::max(most, ofRank["peakMemory"].get<double>());
        }
        return most;
    }
};

Counts countsOn(int ranks, const std::string& boxes, double writeInterval)
{
    TestCase test;
    bedInABox(test, boxes, writeInterval);
    test.file("system/decomposeParDict").set("numberOfSubdomains", std::to_string(ranks));
    const Outcome outcome = test.runCommand(
        "blockMesh > log.blockMesh && decomposePar > log.decomposePar && MESSAGE_COUNTS=$PWD mpirun -np "
        + std::to_string(ranks) + " -x MESSAGE_COUNTS -x LD_PRELOAD=" COUNT_MESSAGES " $SOLVER -parallel");
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    Counts counts;
    counts.particlesFile = std::numeric_limits<double>::max();
    for (int rank = 0; rank < ranks; ++rank)
    {
        std::ifstream file(test.path() / (std::to_string(rank) + ".json"));
        counts.ofRanks.push_back(nlohmann::json::parse(file));
        const std::string particles = "checkpoints/0.0004/particles." + std::to_string(rank) + ".restart";
        counts.particlesFile =
            std::min(counts.particlesFile, static_cast<double>(std::filesystem::file_size(test.path() / particles)));
    }
    counts.summary = test.conservationSummary();
    std::smatch found;
    if (std::regex_search(outcome.output, found, std::regex("in ([0-9]+) sweeps")))
    {
        counts.sweeps = std::stoi(found[1]);
    }
    std::cout << ranks << " ranks, an interval of the busiest rank:\n";
    for (const auto& [phase, of] : counts.ofRanks[0]["phases"].items())
    {
        std::cout << "    " << phase;
        for (const char* quantity : {"messages", "neighbours", "bytes", "collectives", "collectiveBytes"})
        {
            std::cout << "  " << quantity << ' ' << counts.largest(phase, quantity);
        }
        std::cout << '\n';
    }
    std::cout << "    memory " << counts.largestMemory() / 1e6 << " MB, " << counts.sweeps
              << " sweeps, particles on disk " << counts.particlesFile << " bytes\n";
    return counts;
}

} // namespace

/// The same bed on 2, 4 and 8 ranks. Nothing that a rank is reported grows with their number: not the bytes of
/// collective calls, which a list of all ranks' boxes in every coupling step made grow by 96 a rank; not the messages
/// to one neighbour; not its memory. The smoothing passes the mesh twice in a coupling step, with all that the
/// particles give and with what they feel: one message to each neighbour a sweep, and two for each of the few rounds in
/// which cells near particles are found. When it took eight quantities at most, and what is given semi-implicitly by
/// itself, there were four passes.
TEST(Messages, OfARankDoNotGrowWithTheRanks)
{
    const Counts two = countsOn(2, "(2 1 1)", 4 * interval);
    const Counts four = countsOn(4, "(2 2 1)", 4 * interval);
    const Counts eight = countsOn(8, "(2 2 2)", 4 * interval);
    for (const Counts& counts : {two, four, eight})
    {
        const auto perNeighbour = [&](const char* phase) {
            return counts.largest(phase, "messages") / counts.largest(phase, "neighbours");
        };
        EXPECT_EQ(perNeighbour("exchange"), 3);
        ASSERT_GT(counts.sweeps, 10);
        EXPECT_GE(perNeighbour("smooth"), 2 * counts.sweeps);
        EXPECT_LE(perNeighbour("smooth"), 2 * counts.sweeps + 8);
    }
    for (const char* phase : {"DEM", "distribute", "exchange", "forces", "locate", "other", "output", "smooth"})
    {
        EXPECT_EQ(two.largest(phase, "collectiveBytes"), eight.largest(phase, "collectiveBytes")) << phase;
    }
    for (const char* phase : {"exchange", "smooth"})
    {
        EXPECT_LT(eight.largest(phase, "bytes"), two.largest(phase, "bytes")) << phase;
    }
    EXPECT_LT(eight.largestMemory(), two.largestMemory());
}

/// In the phases of the coupling all ranks wait for each other once, after the particles have been distributed, however many
/// ranks there are. The other reduction of a coupling step is at its end. The program itself counts these two, where there were about
/// thirty when each number was reduced by itself.
/// (OpenFOAM's reductions over so few ranks are messages, not collective calls: tests/scripts/collective_tests.py shows that
/// none of them is left in a coupling step.)
TEST(Messages, RanksWaitForEachOtherAFewTimesInACouplingStep)
{
    for (const auto& [ranks, boxes] : {std::pair(2, "(2 1 1)"), std::pair(4, "(2 2 1)")})
    {
        const Counts counts = countsOn(ranks, boxes, 4 * interval);
        double calls = 0;
        for (const char* phase : {"distribute", "exchange", "locate", "smooth"})
        {
            calls += counts.largest(phase, "collectives");
        }
        EXPECT_EQ(calls, 1);
        EXPECT_EQ(counts.summary["reductionsPerStep"], 2);
    }
}

/// With a checkpoint in every coupling step a rank hands on what lies at its border and the checksums of its files, not
/// its particles: those it writes itself. When the first rank wrote all that the others sent to it, they sent as much
/// as lies on the disk.
TEST(Messages, OfACheckpointAreNotItsParticles)
{
    const Counts counts = countsOn(2, "(2 1 1)", interval);
    EXPECT_LT(counts.largest("output", "bytes"), 0.1 * counts.particlesFile);
    EXPECT_LT(counts.largest("output", "collectiveBytes"), 0.1 * counts.particlesFile);
}

} // namespace clepsydra::tests
