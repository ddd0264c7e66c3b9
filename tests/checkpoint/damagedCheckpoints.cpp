// Whatever happens to the files of a checkpoint on disk, a resumed run either is the run that was never stopped, to the
// last bit, or ends with an error that names the file. It never gives another result.

#include "checkpoint/pilingParticles.h"

#include <gtest/gtest.h>

#include <utility>

namespace clepsydra::tests
{

namespace
{

/// Checkpoints at .01, .02 and .03 s.
void threeCheckpoints(TestCase& test, double endTime)
{
    pilingParticles(test, true);
    test.dem.dumpEvery = 0;
    test.setTimes(endTime, interval, 0.01);
}

struct Damage
{
    /// Done in the case's folder, between a run that ends at .02 s and one that is to end at .03 s.
    std::string command;
    std::string namedFile;
};

/// Changes one bit in the middle of a file.
std::string flipBit(const std::string& file)
{
    return "python3 -c \"import sys; b = bytearray(open(sys.argv[1], 'rb').read()); b[len(b)//2] ^= 1; "
           "open(sys.argv[1], 'wb').write(b)\" "
           + file;
}

Outcome inCopy(TestCase& test, const std::string& command)
{
    return test.runCommand("copy=$(mktemp -d) && cp -r . $copy && cd $copy && { " + command
                           + "\n}; status=$?; rm -rf $copy; exit $status");
}

std::vector<Damage> damages()
{
    std::vector<Damage> all = {
        {": > checkpoints/0.02/complete", "checkpoints/0.02/complete"},
        {"truncate -s 200 checkpoints/0.02/complete", "checkpoints/0.02/complete"},
        {"cp checkpoints/0.01/complete checkpoints/0.02", "manifest of time 0.01"},
        {flipBit("checkpoints/0.02/complete"), "checkpoints/0.02/complete is damaged"},
        {"rm -r 0.02/uniform/functionObjects", "0.02/uniform/functionObjects"},
        {": > 0.02/uniform/time", "0.02/uniform/time"},
    };
    for (const std::string part : {"base", "0"})
    {
        const std::string particles = "/particles." + part + ".restart";
        const std::string file = "checkpoints/0.02" + particles;
        all.push_back({": > " + file, file});
        all.push_back({"truncate -s -1 " + file, file});
        all.push_back({flipBit(file), file});
        all.push_back({"cp checkpoints/0.01" + particles + ' ' + file, file});
        all.push_back({"rm " + file, file});
    }
    for (const char* field : {"U", "p", "phi", "voidFraction", "semiImplicitMomentum", "deferredMomentum",
             "voidFractionInContinuity", "fluidAcceleration"})
    {
        const std::string file = "0.02/" + std::string(field);
        all.push_back({": > " + file, file});
        all.push_back({"rm " + file, file});
    }
    all.push_back({flipBit("0.02/U"), "0.02/U"});
    all.push_back({flipBit("0.02/p"), "0.02/p"});
    return all;
}

} // namespace

// The last of two checkpoints is damaged: the run names the file, goes on from the one before, and ends as the run that
// was never stopped. A program that believes its files ends with another result, or does not end.
TEST(DamagedCheckpoint, IsNamedAndTheOneBeforeIsTaken)
{
    TestCase through;
    threeCheckpoints(through, 0.03);
    const Outcome whole = through.run();
    ASSERT_TRUE(whole.succeeded()) << whole.output;
    TestCase stopped;
    threeCheckpoints(stopped, 0.02);
    const Outcome first = stopped.run();
    ASSERT_TRUE(first.succeeded()) << first.output;

    for (const Damage& damage : damages())
    {
        // The manifest of .03 s holds the checksums of all that the run has come to.
        const Outcome outcome = inCopy(stopped,
            damage.command
                + " && echo 'endTime 0.03;' >> system/controlDict && timeout 60 $SOLVER && ls -d damaged.0.02 && "
                + TestCase::sameCheckpoint("0.03", through));
        EXPECT_TRUE(outcome.succeeded()) << damage.command << '\n' << outcome.output;
        EXPECT_TRUE(outcome.says(damage.namedFile)) << damage.command << '\n' << outcome.output;
        EXPECT_TRUE(outcome.says("Resuming from the checkpoint of time 0.01")) << damage.command << '\n'
                                                                               << outcome.output;
    }
}

// Every checkpoint is damaged, or the one asked for by startTime, or the particles' half of all is gone: an error, and nothing
// is moved or written. A run that takes the fields of .02 s and the particles of 0 s goes on with status 0.
TEST(DamagedCheckpoint, IsAnErrorWhereNoneCanBeTaken)
{
    TestCase test;
    threeCheckpoints(test, 0.02);
    ASSERT_TRUE(test.run().succeeded());
    const std::string andNothingMoved = "; status=$?; [ -f 0.01/U ] && [ -f 0.02/U ] && exit $status";

    const Outcome all = inCopy(test, ": > 0.01/U; : > 0.02/p; $SOLVER" + andNothingMoved);
    EXPECT_EQ(all.status, 1) << all.output;
    EXPECT_TRUE(all.says("0.01/U") && all.says("0.02/p") && all.says("To start afresh")) << all.output;

    const Outcome asked = inCopy(test, ": > 0.02/p; echo 'startFrom startTime; startTime 0.02;' >> system/controlDict; "
                                       "$SOLVER"
                                           + andNothingMoved);
    EXPECT_EQ(asked.status, 1) << asked.output;
    EXPECT_TRUE(asked.says("0.02/p")) << asked.output;

    const Outcome half = inCopy(test, "rm -r checkpoints; $SOLVER" + andNothingMoved);
    EXPECT_EQ(half.status, 1) << half.output;
    EXPECT_TRUE(half.says("half of a checkpoint")) << half.output;

    const Outcome beginning = inCopy(test, "echo zero > checkpoints/beginning; $SOLVER" + andNothingMoved);
    EXPECT_EQ(beginning.status, 1) << beginning.output;
    EXPECT_TRUE(beginning.says("checkpoints/beginning\" holds 'zero'; allowed:")) << beginning.output;
}

// A dry run starts from where a start would that has set the unusable times aside, and leaves all files as they are. One that
// takes the latest time refuses a case that runs.
TEST(DamagedCheckpoint, IsPassedOverByADryRun)
{
    TestCase test;
    threeCheckpoints(test, 0.02);
    ASSERT_TRUE(test.run().succeeded());
    const std::string resumed = "Resuming from the checkpoint of time 0.01";
    const std::vector<std::pair<std::string, std::string>> startsAfter = {
        {"rm 0.02/phi checkpoints/0.02/complete", resumed},
        {": > 0.02/uniform/time", resumed},
        {"rm checkpoints/*/complete", "Create mesh for time = 0\n"},
    };
    for (const auto& [damage, start] : startsAfter)
    {
        const Outcome outcome = inCopy(
            test, damage
                      + "; all() { find . | sort; find . -type f -exec sha256sum {} + | sort; }; before=\"$(all)\" && "
                        "$SOLVER -dryRun && [ \"$before\" = \"$(all)\" ]");
        EXPECT_TRUE(outcome.succeeded()) << damage << '\n' << outcome.output;
        EXPECT_TRUE(outcome.says(start)) << damage << '\n' << outcome.output;
        EXPECT_TRUE(outcome.says("Case check: one coupling step took")) << damage << '\n' << outcome.output;
    }
}

// On two ranks each rank's fields are held against the manifest, too, also those that lie elsewhere behind a link. A manifest
// that names them by that place says nothing of them.
TEST(DamagedCheckpoint, IsFoundOnEachRank)
{
    TestCase test;
    threeCheckpoints(test, 0.02);
    test.divideAmong(2);
    const Outcome first = test.runCommand("blockMesh && decomposePar && mkdir elsewhere && mv processor1 elsewhere && "
                                          "ln -s elsewhere/processor1 && mpirun -np 2 $SOLVER -parallel");
    ASSERT_TRUE(first.succeeded()) << first.output;

    // Killed when one rank had its folder and the other not: each for itself would start from another time.
    const Outcome dryRun =
        inCopy(test, "rm -r processor1/0.02 checkpoints/0.02/complete && mpirun -np 2 $SOLVER -parallel -dryRun");
    EXPECT_TRUE(dryRun.succeeded()) << dryRun.output;
    EXPECT_TRUE(dryRun.says("Resuming from the checkpoint of time 0.01")) << dryRun.output;

    // The particles' files, which the ranks divide among them, in turn.
    for (const std::string part : {"base", "0", "1"})
    {
        const std::string file = "checkpoints/0.02/particles." + part + ".restart";
        const Outcome found = inCopy(test, flipBit(file)
                                               + " && echo 'endTime 0.022;' >> system/controlDict && "
                                                 "mpirun -np 2 $SOLVER -parallel");
        EXPECT_TRUE(found.succeeded()) << found.output;
        EXPECT_TRUE(found.says(file)) << found.output;
        EXPECT_TRUE(found.says("Resuming from the checkpoint of time 0.01")) << found.output;
    }

    const Outcome outcome =
        test.runCommand(": > processor1/0.02/phi && echo 'endTime 0.022;' >> system/controlDict && "
                        "mpirun -np 2 $SOLVER -parallel && ls -d processor0/damaged.0.02 processor1/damaged.0.02");
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    EXPECT_TRUE(outcome.says("processor1/0.02/phi")) << outcome.output;
    EXPECT_TRUE(outcome.says("Resuming from the checkpoint of time 0.01")) << outcome.output;
}

// From two ranks to one: the fields that reconstructPar has made can be held against no checksum, but those from which it
// made them can, and so can the particles; and all fields must be there. A program that checks nothing after a
// redistribution goes on with whatever it finds.
TEST(DamagedCheckpoint, IsFoundAfterRedistribution)
{
    TestCase test;
    threeCheckpoints(test, 0.02);
    test.divideAmong(2);
    const Outcome first = test.runCommand("blockMesh && decomposePar && mpirun -np 2 $SOLVER -parallel && "
                                          "reconstructPar && echo 'endTime 0.022;' >> system/controlDict");
    ASSERT_TRUE(first.succeeded()) << first.output;
    const Outcome undamaged = inCopy(test, "$SOLVER");
    EXPECT_TRUE(undamaged.succeeded()) << undamaged.output;
    EXPECT_TRUE(undamaged.says("Resuming from the checkpoint of time 0.02")) << undamaged.output;
    const std::vector<Damage> redistributed = {
        {flipBit("processor1/0.02/U"), "processor1/0.02/U"},
        {": > 0.02/U", "0.02/U is missing or empty"},
        {"rm 0.02/voidFractionInContinuity", "0.02/voidFractionInContinuity is missing or empty"},
        {flipBit("checkpoints/0.02/particles.1.restart"), "checkpoints/0.02/particles.1.restart"},
    };
    for (const Damage& damage : redistributed)
    {
        const Outcome outcome = inCopy(test, damage.command + " && timeout 60 $SOLVER");
        EXPECT_TRUE(outcome.succeeded()) << damage.command << '\n' << outcome.output;
        EXPECT_TRUE(outcome.says(damage.namedFile)) << damage.command << '\n' << outcome.output;
        EXPECT_TRUE(outcome.says("Resuming from the checkpoint of time 0.01")) << damage.command << '\n'
                                                                               << outcome.output;
    }
}

// The particles that a run leaves for others, in one file or in one for each rank, are damaged: the other run names the file.
// LIGGGHTS goes round in it for ever.
class FinalParticles : public testing::TestWithParam<std::pair<const char*, const char*>>
{};

TEST_P(FinalParticles, AreHeldAgainstTheirChecksum)
{
    const auto [name, file] = GetParam();
    TestCase pour;
    pilingParticles(pour, false);
    pour.coupling().set("DEM/writeRestart", '"' + std::string(name) + '"');
    pour.setTimes(0.005, interval, 1);
    ASSERT_TRUE(pour.run().succeeded());
    const std::string packing = (pour.path() / file).string();
    EXPECT_TRUE(pour.runCommand("sha256sum --check packing.*.sha256").succeeded());

    TestCase discharge;
    pilingParticles(discharge, false);
    discharge.dem.particles.clear();
    discharge.dem.readRestart = (pour.path() / name).string();
    discharge.dem.more = "fix integrate all nve/sphere\n";
    discharge.coupling().remove("DEM/groupChanges");
    discharge.setTimes(0.002, interval, 1);
    const Outcome undamaged = discharge.run();
    ASSERT_TRUE(undamaged.succeeded()) << undamaged.output;
    EXPECT_EQ(discharge.conservationSummary()["particlesEnd"], static_cast<int>(pour.dem.particles.size()));
    ASSERT_TRUE(discharge.runCommand("rm -r checkpoints 0.*").succeeded());
    for (const std::string& damage : {flipBit(""), std::string(": > ")})
    {
        ASSERT_TRUE(pour.runCommand(damage + packing).succeeded());
        const Outcome outcome = discharge.runCommand("timeout 20 $SOLVER");
        EXPECT_EQ(outcome.status, 1) << outcome.output;
        EXPECT_TRUE(outcome.says(packing)) << outcome.output;
    }
}

// A file that cannot be written keeps no checksum of an earlier one, nor does a part.
TEST_P(FinalParticles, LoseTheirOldChecksumFirst)
{
    const auto [name, file] = GetParam();
    TestCase test;
    pilingParticles(test, false);
    test.coupling().set("DEM/writeRestart", '"' + std::string(name) + '"');
    test.setTimes(0.002, interval, 1);
    ASSERT_TRUE(test.makeMesh().succeeded());
    const std::string before = "mkdir " + std::string(file) + " && echo old > " + file + ".sha256 && ";
    const Outcome outcome = test.runCommand(before + "$SOLVER");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(test.path() / (std::string(file) + ".sha256"))) << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(InOneFileAndInParts, FinalParticles,
    testing::Values(std::pair("packing.restart", "packing.restart"),
        std::pair("packing.%.restart", "packing.base.restart"), std::pair("packing.%.restart", "packing.0.restart")));

} // namespace clepsydra::tests
