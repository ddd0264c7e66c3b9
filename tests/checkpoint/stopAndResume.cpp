// A run that is stopped and resumed is the run that was never stopped: to the last digit, whoever stops it and when.

#include "support/testCase.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <iostream>
#include <random>
#include <thread>

namespace clepsydra::tests
{

namespace
{

constexpr double interval = 1e-3;

/// 72 beads that fall and pile up on a floor: contacts with beads and walls, friction and its history. The
/// lowest come to rest for good. With fluid each has the history of its motion.
void pilingBeads(TestCase& test, bool fluid)
{
    test.box.upper = {0.012, 0.012, 0.024};
    test.cells = {6, 6, 12};
    test.dem.beads = simpleLattice(Box{{0, 0, 0}, {0.012, 0.012, 0.02}}, {4, 4, 5});
    jitter(test.dem.beads, 2e-4, 11);
    test.dem.timeStep = 4e-5;
    test.dem.dumpEvery = 250;
    test.dem.fixed = true;
    test.dem.more = "group moving union all\ngroup resting initialize\nneigh_modify exclude group resting resting\n"
                    "fix integrate moving nve/sphere\n";
    test.coupling()
        .set("DEM/groupChanges/atRest/from", "moving")
        .set("DEM/groupChanges/atRest/to", "resting")
        .set("DEM/groupChanges/atRest/below", "5e-3")
        .set("DEM/groupChanges/atRest/slowerThan", "2e-2")
        .set("DEM/groupChanges/atRest/during", "0.01");
    test.setFluid(1000, 1e-6);
    test.coupling().set("forceModels", "(DiFeliceDrag gradPForce viscForce Archimedes virtualMassForce historyForce)");
    test.control()
        .set("startFrom", "latestTime")
        .set("writeFormat", "binary")
        .set("functions/massInHopper/type", "massInHopper")
        .set("functions/massInHopper/patch", "walls");
    if (!fluid)
    {
        test.coupling().set("fluid", "none");
    }
}

/// Largest distance between the same beads, in bead diameters.
double distance(const BeadSnapshot& a, const BeadSnapshot& b, double diameter)
{
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.id, b.id);
    return (a.position - b.position).cwiseAbs().maxCoeff() / diameter;
}

/// All rows of m(t), the parts of a resumed run joined in the order of their start times.
std::vector<std::vector<double>> massRows(const TestCase& test)
{
    std::map<double, std::filesystem::path> parts;
    for (const auto& part : std::filesystem::directory_iterator(test.path() / "postProcessing/massInHopper"))
    {
        parts[std::stod(part.path().filename())] = part.path();
    }
    std::vector<std::vector<double>> rows;
    for (const auto& [start, folder] : parts)
    {
        const std::string file = "postProcessing/massInHopper/" + folder.filename().string() + "/massInHopper.dat";
        const auto part = test.table(file);
        rows.insert(rows.end(), part.begin(), part.end());
    }
    return rows;
}

} // namespace

class StopAndResume : public testing::TestWithParam<bool>
{};

// Run A+B equals run A, stop, B over 2 x 1000 DEM steps, both writing the same checkpoint in the middle. A restart that
// loses the contacts' or the motion's history, the old void fraction, the momentum outstanding or half a step's force
// differs by more than 1e-9 bead diameters at once; a program that ignores the checkpoint begins again and differs by the box.
TEST_P(StopAndResume, EqualsNeverStopped)
{
    const bool fluid = GetParam();
    TestCase through;
    pilingBeads(through, fluid);
    through.setTimes(0.16, interval, 0.04);
    const Outcome whole = through.run();
    ASSERT_TRUE(whole.succeeded()) << whole.output;

    TestCase stopped;
    pilingBeads(stopped, fluid);
    stopped.setTimes(0.12, interval, 0.04);
    const Outcome first = stopped.run();
    ASSERT_TRUE(first.succeeded()) << first.output;
    const Outcome second = stopped.runCommand("echo \"endTime 0.16;\" >> system/controlDict && $SOLVER");
    ASSERT_TRUE(second.succeeded()) << second.output;
    EXPECT_TRUE(second.says("Resuming from the checkpoint of time 0.12")) << second.output;

    const auto resting = through.beadHistory().back().velocity.colwise().squaredNorm().array() == 0;
    EXPECT_GT(resting.count(), 5);
    EXPECT_LT(resting.count(), resting.size());

    const double apart = distance(through.beadHistory().back(), stopped.beadHistory().back(), through.dem.diameter);
    std::cout << (fluid ? "with fluid: " : "dry: ") << apart << " d after 1000 steps from the checkpoint" << std::endl;
    EXPECT_LT(apart, 1e-9);
    if (fluid)
    {
        for (const char* field : {"U", "p", "voidFraction"})
        {
            EXPECT_TRUE(
                through.runCommand("cmp 0.16/" + std::string(field) + ' ' + (stopped.path() / "0.16" / field).string())
                    .succeeded())
                << field;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(DryAndWet, StopAndResume, testing::Bool(),
    [](const testing::TestParamInfo<bool>& fluid) { return fluid.param ? "WithFluid" : "Dry"; });

// Stopped on one rank, resumed on two, after decomposing the fields as OpenFOAM's users do; and the other way round.
// Rounding differs then, and contacts make it grow: so 125 steps only. A checkpoint that holds one rank's beads, or
// beads in the order of their ranks, fails.
TEST(OtherRanks, ResumesOnAnotherNumberOfRanks)
{
    const std::string parallel = "decomposePar -force -latestTime && mpirun -np 2 $SOLVER -parallel";
    TestCase serial;
    TestCase changed;
    for (TestCase* test : {&serial, &changed})
    {
        pilingBeads(*test, true);
        test->setTimes(0.12, interval, 0.04);
        test->dem.dumpEvery = 125;
        test->file("system/decomposeParDict")
            .set("numberOfSubdomains", "2")
            .set("method", "simple")
            .set("simpleCoeffs", "{ n (2 1 1); delta 0.001; }");
        const Outcome first = test->run();
        ASSERT_TRUE(first.succeeded()) << first.output;
        ASSERT_TRUE(test->runCommand("echo \"endTime 0.125; writeInterval 0.005;\" >> system/controlDict").succeeded());
    }
    const Outcome same = serial.runCommand("$SOLVER");
    ASSERT_TRUE(same.succeeded()) << same.output;
    const Outcome other = changed.runCommand(parallel);
    ASSERT_TRUE(other.succeeded()) << other.output;
    EXPECT_TRUE(other.says("Resuming from the checkpoint of time 0.12")) << other.output;
    const double apart = distance(serial.beadHistory().back(), changed.beadHistory().back(), serial.dem.diameter);
    std::cout << apart << " d apart after 125 steps on two ranks" << std::endl;
    EXPECT_LT(apart, 1e-6);

    const Outcome back =
        changed.runCommand("reconstructPar -latestTime && echo \"endTime 0.13;\" >> system/controlDict && $SOLVER");
    ASSERT_TRUE(back.succeeded()) << back.output;
    EXPECT_TRUE(back.says("Resuming from the checkpoint of time 0.125")) << back.output;
    EXPECT_EQ(changed.ledgerSummary("0.125")["beadsEnd"], static_cast<int>(changed.dem.beads.size()));
}

// Killed by SIGKILL at ten random moments, in the middle of steps and of checkpoints, the run goes on each time, and in
// the end every bead is there and every row of m(t) is there once. Checkpoints that are not whole, or rows written again,
// fail.
TEST(Killed, GoesOnEveryTimeWithNothingLostOrDoubled)
{
    TestCase test;
    pilingBeads(test, true);
    test.setTimes(0.3, interval, 0.01);
    ASSERT_TRUE(test.makeMesh().succeeded());

    std::mt19937 random(3);
    std::uniform_real_distribution<double> seconds(0.15, 0.8);
    int killed = 0;
    for (int attempt = 0; attempt < 10; ++attempt)
    {
        const Outcome outcome =
            test.runCommand("timeout --signal=KILL " + std::to_string(seconds(random)) + " $SOLVER");
        killed += outcome.status == 137;
        ASSERT_TRUE(outcome.status == 137 || outcome.succeeded()) << outcome.output;
    }
    const Outcome last = test.runCommand("$SOLVER");
    ASSERT_TRUE(last.succeeded()) << last.output;
    std::cout << killed << " times killed" << std::endl;
    EXPECT_GE(killed, 5);

    const BeadSnapshot beads = test.beadHistory().back();
    EXPECT_EQ(beads.id.size(), test.dem.beads.size());
    const auto rows = massRows(test);
    ASSERT_EQ(rows.size(), 301u);
    for (std::size_t row = 0; row < rows.size(); ++row)
    {
        EXPECT_NEAR(rows[row][0], static_cast<double>(row) * interval, 1e-9) << "row " << row;
        EXPECT_EQ(rows[row][2], static_cast<double>(test.dem.beads.size()));
    }
}

// SIGTERM and the end of the wall time both write a checkpoint and end cleanly, with status 0. A program that just dies
// of the signal has another status and no checkpoint of its last time.
TEST(AskedToStop, WritesACheckpointAndEnds)
{
    // on a busy machine it may take long to the first step
    const std::string signalled = "$SOLVER > log & solver=$!; "
                                  "until grep -q \"^Time = \" log || ! kill -0 $solver; do sleep 0.1; done; "
                                  "kill -TERM $solver; wait $solver; status=$?; cat log; exit $status";
    for (const std::string& how : {signalled, std::string("echo \"maxClockTime 1;\" >> system/controlDict && $SOLVER")})
    {
        TestCase test;
        pilingBeads(test, true);
        test.setTimes(1000, interval, 500);
        ASSERT_TRUE(test.makeMesh().succeeded());
        const Outcome asked = test.runCommand(how);
        EXPECT_EQ(asked.status, 0) << how << asked.output;
        EXPECT_TRUE(asked.says("writing a checkpoint")) << how << asked.output;
        const std::vector<std::string> times = test.times();
        ASSERT_EQ(times.size(), 1u) << how;
        EXPECT_TRUE(std::filesystem::exists(test.path() / "checkpoints" / times.back() / "complete")) << how;
    }
}

} // namespace clepsydra::tests
