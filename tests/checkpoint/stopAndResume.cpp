// A run that is stopped and resumed is the run that was never stopped: to the last digit, whoever stops it and when.

#include "checkpoint/pilingParticles.h"
#include "files/wholeFile.h"
#include "support/stlText.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iostream>
#include <random>
#include <thread>

namespace clepsydra::tests
{

namespace
{

/// Largest distance between the same particles, in particle diameters.
double distance(const ParticleSnapshot& a, const ParticleSnapshot& b, double diameter)
{
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.id, b.id);
    return (a.position - b.position).cwiseAbs().maxCoeff() / diameter;
}

void adjustInterval(TestCase& test)
{
    test.coupling()
        .set("adjustableCouplingTimeStep", "yes")
        .set("maxCo", "0.05")
        .set("minCouplingTimeStep", "4e-5")
        .set("maxCouplingTimeStep", "4e-3");
    // A scheme that needs the length of the step before, too.
    test.file("system/fvSchemes").set("ddtSchemes/default", "backward");
    // Shorter than the coupling step that a checkpoint is written in, and no mistake for that.
    test.control().set("functions/massInHopper/sampleInterval", interval);
}

/// Stops at a time by `endTime`, and goes on from there to the case's own end.
Outcome runInTwo(TestCase& test, const std::string& stopAt)
{
    Outcome mesh = test.makeMesh();
    return mesh.succeeded()
               ? test.runCommand("cp system/controlDict asked && echo \"endTime " + stopAt
                                 + ";\" >> system/controlDict && $SOLVER && cp asked system/controlDict && $SOLVER")
               : mesh;
}

/// Four walls of strips, each of two triangles, that are closer to each other below.
std::vector<Triangle> chute(double width, double height, double inset, int strips)
{
    const auto corner = [&](int wall, int level) {
        const double z = height * level / strips;
        const double low = inset * (1 - z / height);
        const bool right = wall % 4 == 1 || wall % 4 == 2;
        const bool back = wall % 4 > 1;
        return Eigen::Vector3d(right ? width - low : low, back ? width - low : low, z);
    };
    std::vector<Triangle> triangles;
    for (int wall = 0; wall < 4; ++wall)
    {
        for (int strip = 0; strip < strips; ++strip)
        {
            triangles.push_back({corner(wall, strip), corner(wall + 1, strip), corner(wall, strip + 1)});
            triangles.push_back({corner(wall + 1, strip), corner(wall + 1, strip + 1), corner(wall, strip + 1)});
        }
    }
    return triangles;
}

} // namespace

class StopAndResume : public testing::TestWithParam<bool>
{};

// Run A+B equals run A, stop, B over 2 x 1000 DEM steps, both writing the same checkpoint in the middle. A restart that
// loses the contacts' or the motion's history, the old void fraction, the momentum outstanding, half a step's force or
// the length of the next or the last coupling step differs by more than 1e-9 particle diameters at once; a program that
// ignores the checkpoint begins again and differs by the box. (That of constant coupling steps is Killed's matter.)
TEST_P(StopAndResume, EqualsNeverStopped)
{
    const bool fluid = GetParam();
    TestCase through;
    pilingParticles(through, fluid);
    adjustInterval(through);
    through.setTimes(0.16, interval, 0.04);
    const Outcome whole = through.run();
    ASSERT_TRUE(whole.succeeded()) << whole.output;

    TestCase stopped;
    pilingParticles(stopped, fluid);
    adjustInterval(stopped);
    stopped.setTimes(0.12, interval, 0.04);
    const Outcome first = stopped.run();
    ASSERT_TRUE(first.succeeded()) << first.output;
    if (fluid)
    {
        // Another than the first: otherwise it would make no difference whether the checkpoint holds it.
        EXPECT_TRUE(stopped.runCommand("grep -q steps 0.12/uniform/couplingTimeStep").succeeded());
        EXPECT_FALSE(stopped.runCommand("grep -q 'steps *25;' 0.12/uniform/couplingTimeStep").succeeded());
    }
    const Outcome second = stopped.runCommand("echo \"endTime 0.16;\" >> system/controlDict && $SOLVER");
    ASSERT_TRUE(second.succeeded()) << second.output;
    EXPECT_TRUE(second.says("Resuming from the checkpoint of time 0.12")) << second.output;

    const auto resting = through.particleHistory().back().velocity.colwise().squaredNorm().array() == 0;
    EXPECT_GT(resting.count(), 5);
    EXPECT_LT(resting.count(), resting.size());

    const double apart =
        distance(through.particleHistory().back(), stopped.particleHistory().back(), through.dem.diameter);
    std::cout << (fluid ? "with fluid: " : "dry: ") << apart << " d after 1000 steps from the checkpoint" << std::endl;
    EXPECT_LT(apart, 1e-9);
    if (fluid)
    {
        for (const char* field : {"U", "p", "voidFraction"})
        {
            EXPECT_TRUE(through.runCommand(TestCase::sameFile("0.16/" + std::string(field), stopped)).succeeded())
                << field;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(DryAndWet, StopAndResume, testing::Bool(),
    [](const testing::TestParamInfo<bool>& fluid) { return fluid.param ? "WithFluid" : "Dry"; });

// Stopped on one rank, resumed on two, after decomposing the fields as OpenFOAM's users do; and the other way round.
// Rounding differs then, and contacts make it grow: so 125 steps only. A checkpoint that holds one rank's particles, or
// particles in the order of their ranks, fails.
TEST(OtherRanks, ResumesOnAnotherNumberOfRanks)
{
    const std::string parallel = "decomposePar -force -latestTime && mpirun -np 2 $SOLVER -parallel";
    TestCase serial;
    TestCase changed;
    for (TestCase* test : {&serial, &changed})
    {
        pilingParticles(*test, true);
        adjustInterval(*test);
        test->setTimes(0.12, interval, 0.04);
        test->dem.dumpEvery = 125;
        test->divideAmong(2);
        const Outcome first = test->run();
        ASSERT_TRUE(first.succeeded()) << first.output;
        ASSERT_TRUE(test->runCommand("echo \"endTime 0.125; writeInterval 0.005;\" >> system/controlDict").succeeded());
    }
    const Outcome same = serial.runCommand("$SOLVER");
    ASSERT_TRUE(same.succeeded()) << same.output;
    const Outcome other = changed.runCommand(parallel);
    ASSERT_TRUE(other.succeeded()) << other.output;
    EXPECT_TRUE(other.says("Resuming from the checkpoint of time 0.12")) << other.output;
    const double apart =
        distance(serial.particleHistory().back(), changed.particleHistory().back(), serial.dem.diameter);
    std::cout << apart << " d apart after 125 steps on two ranks" << std::endl;
    EXPECT_LT(apart, 1e-6);

    const Outcome back =
        changed.runCommand("reconstructPar -latestTime && echo \"endTime 0.13;\" >> system/controlDict && $SOLVER");
    ASSERT_TRUE(back.succeeded()) << back.output;
    EXPECT_TRUE(back.says("Resuming from the checkpoint of time 0.125")) << back.output;
    EXPECT_EQ(changed.conservationSummary("0.125")["particlesEnd"], static_cast<int>(changed.dem.particles.size()));
}

// Written at time 1 on two ranks, resumed on one and on three. A program that looks for the time in `processor1/1/U` finds
// it in the rank's name; one that holds the three ranks' new files against those of the two finds them damaged.
TEST(OtherRanks, TakeTheCheckpointOfTimeOneFromTwoRanks)
{
    for (const std::string resume :
        {"$SOLVER", "echo 'numberOfSubdomains 3; simpleCoeffs { n (3 1 1); }' >> system/decomposeParDict && "
                    "decomposePar -force -latestTime && mpirun -np 3 $SOLVER -parallel"})
    {
        TestCase test;
        test.dem.particles = {{0.0101, 0.0099, 0.02}};
        test.setTimes(1, interval, 1);
        ASSERT_TRUE(test.runCommand("mv 0 0.998").succeeded());
        const Outcome first = test.run(2);
        ASSERT_TRUE(first.succeeded()) << first.output;
        const Outcome resumed = test.runCommand("echo 'endTime 1.001;' >> system/controlDict && " + resume);
        EXPECT_TRUE(resumed.succeeded()) << resumed.output;
        EXPECT_TRUE(resumed.says("Resuming from the checkpoint of time 1\n")) << resumed.output;
    }
}

// purgeWrite takes both halves of old checkpoints; the user's own times, the beginning's and one before, stay when the run
// is resumed. A program that takes every time without particles for one of its own sets 0 aside as unfinished.
TEST(PurgeWrite, TakesWholeCheckpointsAndNoTimeOfTheUser)
{
    TestCase test;
    pilingParticles(test, false);
    test.setTimes(0.014, interval, interval);
    test.control().set("purgeWrite", "2");
    ASSERT_TRUE(test.runCommand("cp -r 0 0.01").succeeded());
    const Outcome first = test.run();
    ASSERT_TRUE(first.succeeded()) << first.output;
    EXPECT_EQ(test.times(), (std::vector<std::string>{"0.01", "0.013", "0.014"}));
    EXPECT_EQ(test.runCommand("ls checkpoints").output, "0.013\n0.014\nbeginning\n");

    const Outcome second = test.runCommand("echo 'endTime 0.015;' >> system/controlDict && $SOLVER && ls 0/U 0.01/U");
    EXPECT_TRUE(second.succeeded()) << second.output;
    EXPECT_TRUE(second.says("Resuming from the checkpoint of time 0.014")) << second.output;
}

// Each of two ranks writes a file of its own particles, and a resumed run reads them, bit for bit the run that was never stopped.
// The files are together as large as one that holds the particles of both: a rank that was handed the other's has more.
TEST(TwoRanks, WriteTheirOwnParticlesAndGoOn)
{
    TestCase through;
    TestCase stopped;
    stopped.coupling().set("DEM/writeRestart", "\"all.restart\"");
    for (TestCase* test : {&through, &stopped})
    {
        pilingParticles(*test, true);
        test->dem.dumpEvery = 0;
        test->setTimes(test == &stopped ? 0.01 : 0.02, interval, 0.01);
        const Outcome outcome = test->run(2);
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    }
    const auto size = [&](const std::string& file) { return std::filesystem::file_size(stopped.path() / file); };
    const std::string particles = "checkpoints/0.01/particles.";
    EXPECT_EQ(size(particles + "base.restart") + size(particles + "0.restart") + size(particles + "1.restart"),
        size("all.restart"));
    EXPECT_GT(size(particles + "1.restart"), size("all.restart") / 4);

    const Outcome resumed =
        stopped.runCommand("echo \"endTime 0.02;\" >> system/controlDict && mpirun -np 2 $SOLVER -parallel");
    ASSERT_TRUE(resumed.succeeded()) << resumed.output;
    EXPECT_TRUE(resumed.says("Resuming from the checkpoint of time 0.01")) << resumed.output;
    EXPECT_TRUE(stopped.runCommand(TestCase::sameCheckpoint("0.02", through)).succeeded());
}

// Three ranks one above the other move their boxes as the particles fall in a chute of triangles: `fix balance`. The run that is
// resumed begins with the boxes of the checkpoint and is bit for bit the run that was never stopped. One that begins with equal
// boxes is not.
TEST(ThreeRanks, GoOnWithTheBoxesOfTheCheckpoint)
{
    TestCase through;
    TestCase stopped;
    for (TestCase* test : {&through, &stopped})
    {
        pilingParticles(*test, false);
        test->dem.dumpEvery = 0;
        std::ofstream(test->path() / "chute.stl") << stlText(chute(0.012, 0.024, 2.5e-4, 24));
        test->dem.more += "fix balance all balance 20 1.05\nfix chute all mesh/surface file chute.stl type 1\n"
                          "fix inChute all wall/gran model hertz tangential history mesh n_meshes 1 meshes chute\n";
        test->setTimes(test == &stopped ? 0.06 : 0.09, interval, 0.03);
        const Outcome outcome = test->run(3);
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    }
    const std::string boxes = "checkpoints/0.06/particles.subdomains.restart";
    EXPECT_NE(textOf(stopped.path() / boxes), textOf(through.path() / "checkpoints/0.09/particles.subdomains.restart"))
        << "the boxes have not moved since";

    const Outcome resumed =
        stopped.runCommand("echo \"endTime 0.09;\" >> system/controlDict && mpirun -np 3 $SOLVER -parallel");
    ASSERT_TRUE(resumed.succeeded()) << resumed.output;
    EXPECT_TRUE(resumed.says("Resuming from the checkpoint of time 0.06")) << resumed.output;
    // The base has the triangles, one rank after the other, each in the order in which they came.
    for (const char* const part : {"0", "1", "2", "subdomains"})
    {
        const std::string file = std::string("checkpoints/0.09/particles.") + part + ".restart";
        EXPECT_EQ(contentsOf(stopped.path() / file), contentsOf(through.path() / file)) << file;
    }

    // On one rank there is nothing to cut. Without fields reconstructPar needs the folder.
    const Outcome onOne = stopped.runCommand(
        "mkdir 0.09 && reconstructPar -latestTime && echo \"endTime 0.1;\" >> system/controlDict && $SOLVER");
    ASSERT_TRUE(onOne.succeeded()) << onOne.output;
    EXPECT_TRUE(onOne.says("Resuming from the checkpoint of time 0.09")) << onOne.output;
}

// A checkpoint of the time when one file held the particles of all ranks, and no run had an identifier: it is resumed from, with
// the warning that nothing is known of its inputs. A program that looks for a file of each rank only does not find it.
TEST(OneFileOfAllParticles, IsResumedFrom)
{
    TestCase test;
    pilingParticles(test, true);
    test.setTimes(0.01, interval, 0.01);
    test.coupling().set("DEM/writeRestart", "\"all.restart\"");
    ASSERT_TRUE(test.run().succeeded());
    const Outcome resumed = test.runCommand(R"(python3 - <<'end'
import hashlib, os
folder = 'checkpoints/0.01/'
checksum = lambda bytes: hashlib.sha256(bytes).hexdigest()
new = ('run ', 'mesh ', 'input ', 'output ')
lines = [line for line in open(folder + 'complete').read().splitlines()[:-1]
         if 'particles.' not in line and not line.startswith(new)]
open('checkpoints/beginning', 'w').write('0\n')
for name in ('base', '0'):
    os.remove(folder + 'particles.' + name + '.restart')
os.rename('all.restart', folder + 'particles.restart')
particles = open(folder + 'particles.restart', 'rb').read()
text = '\n'.join(lines + [checksum(particles) + ' ' + str(len(particles)) + ' ' + folder + 'particles.restart', ''])
open(folder + 'complete', 'w').write(text + 'end ' + checksum(text.encode()) + '\n')
end
echo "endTime 0.02;" >> system/controlDict && $SOLVER)");
    EXPECT_TRUE(resumed.succeeded()) << resumed.output;
    EXPECT_TRUE(resumed.says("Resuming from the checkpoint of time 0.01")) << resumed.output;
    EXPECT_TRUE(resumed.says("written by an earlier version")) << resumed.output;
    EXPECT_TRUE(test.runCommand("grep -q '^run [0-9a-f]' checkpoints/beginning").succeeded());
    EXPECT_EQ(test.conservationSummary("0.01")["particlesEnd"], static_cast<int>(test.dem.particles.size()));
}

// Killed by SIGKILL at eight random moments, in the middle of steps and of checkpoints, the run goes on each time, and in
// the end all is as in a run that was never disturbed, to the last bit, and every row of m(t) and of the means in bins is
// there once. Checkpoints that are not whole, sums of means that are not in them, or rows written again, fail.
TEST(Killed, EndsAsIfNeverDisturbed)
{
    TestCase undisturbed;
    TestCase test;
    for (TestCase* each : {&undisturbed, &test})
    {
        pilingParticles(*each, true);
        each->setTimes(0.15, interval, 0.01);
        each->control()
            .set("functions/means/type", "particleMeans")
            .set("functions/means/binSize", "(0.004 0.004 0.004)")
            .set("functions/means/executeInterval", "7")
            .set("functions/means/writePrecision", "16");
        ASSERT_TRUE(each->makeMesh().succeeded());
    }
    const Outcome whole = undisturbed.runCommand("$SOLVER");
    ASSERT_TRUE(whole.succeeded()) << whole.output;

    // Moments of the whole run's own time: on a slow machine later ones.
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(0.1, 0.4);
    int killed = 0;
    for (int attempt = 0; attempt < 8; ++attempt)
    {
        const Outcome outcome =
            test.runCommand("timeout --signal=KILL " + std::to_string(part(random) * whole.wallSeconds) + " $SOLVER");
        killed += outcome.status == 137;
        ASSERT_TRUE(outcome.status == 137 || outcome.succeeded()) << outcome.output;
    }
    const Outcome last = test.runCommand("$SOLVER");
    ASSERT_TRUE(last.succeeded()) << last.output;
    std::cout << killed << " times killed" << std::endl;
    EXPECT_GE(killed, 3);

    // The manifest holds the checksums of fields, particles, and the state of function objects.
    EXPECT_TRUE(test.runCommand(TestCase::sameCheckpoint("0.15", undisturbed)).succeeded());
    EXPECT_EQ(massRows(test), massRows(undisturbed));
    EXPECT_EQ(massRows(test).size(), 151u);
    EXPECT_EQ(rowsOfTable(test, "means"), rowsOfTable(undisturbed, "means"));
    EXPECT_GT(rowsOfTable(test, "means").size(), 150u);
}

// SIGTERM, SIGINT (Ctrl-C) and the end of the wall time write a checkpoint and end cleanly, with status 0, without the
// particles of the end, for which other runs wait. A program that just dies of the signal has another status and no
// checkpoint of its last time.
TEST(AskedToStop, WritesACheckpointAndEnds)
{
    // on a busy machine it may take long to the first step
    const auto signalled = [](const std::string& signal) {
        // A shell starts what is in its background with SIGINT ignored.
        return "python3 -c \"import os, signal; signal.signal(signal.SIGINT, signal.SIG_DFL); "
               "os.execvp(os.environ['SOLVER'], ['pimpleDemFoam'])\" > log & solver=$!; "
               "until grep -q \"^Time = \" log || ! kill -0 $solver; do sleep 0.1; done; "
               "kill -"
               + signal + " $solver; wait $solver; status=$?; cat log; exit $status";
    };
    for (const std::string& how :
        {signalled("TERM"), signalled("INT"), std::string("echo \"maxClockTime 1;\" >> system/controlDict && $SOLVER")})
    {
        TestCase test;
        pilingParticles(test, true);
        test.setTimes(1000, interval, 500);
        test.coupling().set("DEM/writeRestart", "\"packing.restart\"");
        ASSERT_TRUE(test.makeMesh().succeeded());
        const Outcome asked = test.runCommand(how);
        EXPECT_EQ(asked.status, 0) << how << asked.output;
        EXPECT_TRUE(asked.says("writing a checkpoint")) << how << asked.output;
        const std::vector<std::string> times = test.times();
        ASSERT_EQ(times.size(), 1u) << how;
        EXPECT_TRUE(std::filesystem::exists(test.path() / "checkpoints" / times.back() / "complete")) << how;
        EXPECT_FALSE(std::filesystem::exists(test.path() / "packing.restart")) << how;
    }
}

// A function object asks in every step for the end, as `particleHeight` does once its particle is low enough. The run writes the
// next step and ends; a program that takes each request for a new one never does.
TEST(EndedByAFunctionObject, WritesTheNextStepAndEnds)
{
    TestCase test;
    pilingParticles(test, false);
    test.setTimes(0.05, interval, 0.05);
    test.control()
        .set("functions/height/type", "particleHeight")
        .set("functions/height/particle", "1")
        .set("functions/height/stopBelow", "1");
    ASSERT_TRUE(test.makeMesh().succeeded());
    const Outcome outcome = test.runCommand("timeout 60 $SOLVER");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(test.times(), std::vector<std::string>{"0.001"});
    EXPECT_TRUE(std::filesystem::exists(test.path() / "checkpoints/0.001/complete"));
}

// A checkpoint in every coupling step, or only at the end: the same run but for rounding, which the order of the
// neighbours changes at a checkpoint, and contacts make grow: so 1000 steps only. Where the first half of the step
// after a checkpoint is made with forces made again in place of those of the last step, the particles are 3e-4 d apart.
TEST(WrittenOften, IsTheSameRun)
{
    TestCase seldom;
    TestCase often;
    for (TestCase* test : {&seldom, &often})
    {
        pilingParticles(*test, true);
        test->coupling().set("selfInducedVelocityCorrection", "Oseen");
        test->setTimes(0.04, interval, test == &often ? interval : 0.04);
        const Outcome outcome = test->run();
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    }
    const double apart = distance(seldom.particleHistory().back(), often.particleHistory().back(), seldom.dem.diameter);
    std::cout << apart << " d apart after 1000 steps with 40 checkpoints" << std::endl;
    EXPECT_LT(apart, 1e-9);
}

// Stopped between two write times: the run goes on to the same write times, has a row of m(t) at the same times, the
// rate over the same window, and its end is a checkpoint although it is no write time. Counted from where it was resumed,
// the write times would be .034 and .054 s, and the first rate 0.
TEST(StoppedBetweenWriteTimes, KeepsTimesAndWindows)
{
    TestCase through;
    TestCase stopped;
    for (TestCase* test : {&through, &stopped})
    {
        pilingParticles(*test, false);
        // particles leave what counts as the hopper
        test->dem.floor = -0.0015;
        test->control()
            .set("functions/massInHopper/rateWindow", "0.02")
            .set("functions/massInHopper/sampleInterval", "0.003");
        test->setTimes(0.055, interval, 0.02);
    }
    const Outcome whole = through.run();
    ASSERT_TRUE(whole.succeeded()) << whole.output;

    const Outcome resumed = runInTwo(stopped, "0.034");
    ASSERT_TRUE(resumed.succeeded()) << resumed.output;

    EXPECT_EQ(through.times(), (std::vector<std::string>{"0.02", "0.04", "0.055"}));
    EXPECT_EQ(stopped.times(), (std::vector<std::string>{"0.02", "0.034", "0.04", "0.055"}));
    EXPECT_TRUE(std::filesystem::exists(stopped.path() / "checkpoints/0.055/complete"));
    // Not to the last bit: the checkpoint at .034 s rebuilt neighbour lists, and the run through had none there.
    const auto rows = massRows(stopped);
    const auto expected = massRows(through);
    ASSERT_EQ(rows.size(), expected.size());
    for (std::size_t row = 0; row < rows.size(); ++row)
    {
        for (std::size_t column = 0; column < rows[row].size(); ++column)
        {
            EXPECT_NEAR(rows[row][column], expected[row][column], 1e-9) << "row " << row << ", column " << column;
        }
    }
}

// Stopped one coupling step before a write time: the next step is written. A run that counts this write time as passed has
// none before the end.
TEST(StoppedBetweenWriteTimes, ByOneCouplingStep)
{
    TestCase test;
    test.coupling().set("fluid", "none");
    test.dem.particles = {{0.0101, 0.0099, 0.02}};
    test.setTimes(0.006, interval, 0.002);
    const Outcome outcome = runInTwo(test, "0.003");
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    EXPECT_TRUE(outcome.says("Resuming from the checkpoint of time 0.003")) << outcome.output;
    EXPECT_EQ(test.times(), (std::vector<std::string>{"0.002", "0.003", "0.004", "0.006"}));
}

// Coupling steps have become shorter than controlDict's deltaT, 1 ms: stopped .4 ms before a write time and again
// before the end, the run writes both. One that takes half of deltaT for near enough ends without.
TEST(StoppedBetweenWriteTimes, ByLessThanTheFirstInterval)
{
    TestCase test;
    pilingParticles(test, true);
    adjustInterval(test);
    test.coupling().set("maxCo", "0.003");
    test.setTimes(0.03, interval, 0.02);
    const Outcome first = runInTwo(test, "0.0196");
    ASSERT_TRUE(first.succeeded()) << first.output;
    EXPECT_EQ(test.times(), (std::vector<std::string>{"0.0196", "0.02", "0.03"}));

    const Outcome second = test.runCommand("echo 'endTime 0.0396;' >> system/controlDict && $SOLVER && "
                                           "echo 'endTime 0.04; writeInterval 1;' >> system/controlDict && $SOLVER");
    ASSERT_TRUE(second.succeeded()) << second.output;
    EXPECT_EQ(test.times().back(), "0.04");
}

// Write times by processor time are counted again by each process. One that takes the simulated time, 10 s, for processor
// time writes nothing before it has worked as long.
TEST(StoppedBetweenWriteTimes, CountedByProcessorTime)
{
    TestCase test;
    test.coupling().set("fluid", "none").set("DEM/maxRayleighFraction", "1e9");
    test.dem.particles = {{0.0101, 0.0099, 0.02}};
    test.dem.gravity = 0;
    test.dem.timeStep = 1;
    test.setTimes(10, 1, 0.01);
    test.control().set("writeControl", "cpuTime");
    ASSERT_TRUE(test.run().succeeded());
    const Outcome resumed = test.runCommand("echo 'endTime 20;' >> system/controlDict && $SOLVER && ls -d 11");
    EXPECT_TRUE(resumed.succeeded()) << resumed.output;
}

// A dry run's deltaT is edited while it goes on: clock and particles keep the coupling step that they began with. A
// clock that takes the new step runs twice as fast as the particles, and has fewer rows.
TEST(EditedTimeStep, DoesNotPartClockAndParticles)
{
    TestCase test;
    pilingParticles(test, false);
    test.setTimes(0.5, interval, 0.5);
    test.control().set("runTimeModifiable", "yes");
    ASSERT_TRUE(test.makeMesh().succeeded());
    // OpenFOAM heeds a file that is younger by ten seconds.
    const Outcome outcome = test.runCommand(
        "$SOLVER > log & solver=$!; until [ -s postProcessing/massInHopper/0/massInHopper.dat ] || ! kill -0 $solver; "
        "do sleep 0.01; done; kill -STOP $solver; echo 'deltaT 0.002;' >> system/controlDict; "
        "touch -d '1 minute' system/controlDict; kill -CONT $solver; wait $solver; status=$?; cat log; exit $status");
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    EXPECT_TRUE(outcome.says("Re-reading object controlDict")) << outcome.output;
    EXPECT_EQ(massRows(test).size(), 501u);
}

namespace
{

/// A particle that falls in water, for a few steps.
void fallingParticle(TestCase& test, double endTime)
{
    test.cells = {4, 4, 8};
    test.dem.particles = {{0.0101, 0.0099, 0.02}};
    test.setTimes(endTime, interval, 0.005);
    test.control().set("startFrom", "latestTime");
}

} // namespace

// A case without dumps has no file that its resumed run must continue but LIGGGHTS' log, of which it keeps all. It began
// the log again.
TEST(Log, IsContinued)
{
    TestCase test;
    fallingParticle(test, 0.005);
    ASSERT_TRUE(test.run().succeeded());
    const Outcome second = test.runCommand("cp log.liggghts first && echo 'endTime 0.01;' >> system/controlDict && "
                                           "$SOLVER && head -c $(stat -c %s first) log.liggghts | cmp - first && "
                                           "[ $(stat -c %s log.liggghts) -gt $(stat -c %s first) ]");
    EXPECT_TRUE(second.succeeded()) << second.output;
}

// A later time that is no whole checkpoint is set aside under a name that is free. It replaced what had that name.
TEST(SetAside, ReplacesNothing)
{
    TestCase test;
    fallingParticle(test, 0.005);
    ASSERT_TRUE(test.run().succeeded());
    const Outcome second =
        test.runCommand("mkdir 0.007 unfinished.0.007 && touch 0.007/later unfinished.0.007/earlier && "
                        "echo 'endTime 0.01;' >> system/controlDict && $SOLVER && "
                        "ls unfinished.0.007/earlier unfinished.0.007-2/later");
    EXPECT_TRUE(second.succeeded()) << second.output;
    EXPECT_TRUE(second.says("Setting aside time 0.007")) << second.output;
}

// A checkpoint without the memory of a force that the resumed run would have ends it with the names of the entries.
// LIGGGHTS' own message names neither.
TEST(OtherForces, AreAnErrorOfAResumedRun)
{
    TestCase test;
    fallingParticle(test, 0.005);
    ASSERT_TRUE(test.run().succeeded());
    test.coupling().set("forceModels", "(DiFeliceDrag gradPForce viscForce Archimedes virtualMassForce historyForce)");
    test.control().set("endTime", "0.01");
    test.write();
    const Outcome outcome = test.runCommand("$SOLVER");
    EXPECT_NE(outcome.status, 0);
    EXPECT_TRUE(outcome.says("'historyForce' or 'turbulentDispersion' was added or removed")) << outcome.output;
    EXPECT_TRUE(outcome.says("allowed:")) << outcome.output;
}

// Another case takes the particles of a coupled run at rest, without gravity: nothing moves the fluid. The impulse that
// the fluid of the first case was still to receive would, and would come from nowhere.
TEST(ParticlesOfAnotherRun, BringNoMomentum)
{
    TestCase first;
    fallingParticle(first, 0.01);
    first.coupling().set("DEM/writeRestart", "\"particle.restart\"");
    ASSERT_TRUE(first.run().succeeded());

    TestCase second;
    fallingParticle(second, 0.005);
    second.dem.particles.clear();
    second.dem.readRestart = (first.path() / "particle.restart").string();
    second.dem.gravity = 0;
    second.file("constant/g").set("value", "(0 0 0)");
    second.dem.more = "velocity all set 0 0 0\n";
    const Outcome outcome = second.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    EXPECT_EQ(second.conservationSummary()["particlesEnd"], 1);
    EXPECT_LT(second.field("U", "0.005").cwiseAbs().maxCoeff(), 1e-12);
}

// A run that is stopped after it has inserted all its particles goes on as if never stopped. LIGGGHTS takes the finished
// insertion for one that is late, and ends the run at its next checkpoint.
TEST(Inserted, ParticlesAreNotInsertedAgain)
{
    TestCase through;
    TestCase stopped;
    for (TestCase* test : {&through, &stopped})
    {
        pilingParticles(*test, false);
        test->dem.more +=
            "region upper block 0.002 0.01 0.002 0.01 0.02 0.023 units box\n"
            "fix sphere all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius "
            "constant 0.001\n"
            "fix spheres all particledistribution/discrete 32452843 1 sphere 1.0\n"
            "fix pour moving insert/rate/region seed 86028121 distributiontemplate spheres nparticles 6 "
            "particlerate 2000 insert_every 25 overlapcheck yes all_in yes vel constant 0. 0. -0.4 region "
            "upper\n";
        test->setTimes(0.03, interval, 0.01);
    }
    const Outcome whole = through.run();
    ASSERT_TRUE(whole.succeeded()) << whole.output;
    EXPECT_EQ(through.conservationSummary()["particlesEnd"], static_cast<int>(through.dem.particles.size()) + 6);

    const Outcome resumed = runInTwo(stopped, "0.02");
    ASSERT_TRUE(resumed.succeeded()) << resumed.output;
    EXPECT_TRUE(stopped.runCommand(TestCase::sameCheckpoint("0.03", through)).succeeded());
}

} // namespace clepsydra::tests
