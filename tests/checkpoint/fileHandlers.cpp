// OpenFOAM's other file handlers. `collated` has the fields of all ranks in one file, and its operations on files are
// collective; `masterUncollated` reads and writes all files on the first rank.

#include "checkpoint/pilingParticles.h"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

namespace
{

void prepare(TestCase& test, double endTime)
{
    pilingParticles(test, true);
    // Included files are read collectively by these handlers.
    test.extraFiles["constant/models"] = "modelType A;\n";
    test.coupling().remove("modelType").set("#include", "\"models\"");
    test.dem.dumpEvery = 0;
    test.setTimes(endTime, interval, 0.01);
    test.control().set("functions/particleHeight/type", "particleHeight").set("functions/particleHeight/particle", "5");
    test.divideAmong(2);
}

std::string solve(const std::string& handler)
{
    return "mpirun -np 2 $SOLVER -parallel -fileHandler " + handler;
}

std::string goOnTo(const std::string& endTime)
{
    return "echo 'endTime " + endTime + ";' >> system/controlDict && ";
}

Outcome decomposeAndSolve(TestCase& test, const std::string& handler)
{
    return test.runCommand("blockMesh && decomposePar -fileHandler " + handler + " && " + solve(handler));
}

} // namespace

class FileHandler : public testing::TestWithParam<std::string>
{};

// A run on two ranks that is stopped and resumed equals the one that was never stopped, to the last bit of every file in the
// checkpoint, and its tables have each row once. A program that asks on one rank what the handler answers on all waits for
// ever or is ended by MPI; one that looks for fields in the folders of single ranks begins the resumed run with other fields.
TEST_P(FileHandler, StopsAndResumes)
{
    TestCase through;
    prepare(through, 0.02);
    const Outcome whole = decomposeAndSolve(through, GetParam());
    ASSERT_TRUE(whole.succeeded()) << whole.output;

    TestCase stopped;
    prepare(stopped, 0.01);
    const Outcome first = decomposeAndSolve(stopped, GetParam());
    ASSERT_TRUE(first.succeeded()) << first.output;
    const Outcome second = stopped.runCommand(goOnTo("0.02") + solve(GetParam()));
    ASSERT_TRUE(second.succeeded()) << second.output;
    EXPECT_TRUE(second.says("Resuming from the checkpoint of time 0.01")) << second.output;

    const std::string manifest = "checkpoints/0.02/complete";
    const auto same = [&](const std::string& filter, const std::string& file) {
        return stopped
            .runCommand("a=$(" + filter + ' ' + file + ") && b=$(" + filter + ' ' + (through.path() / file).string()
                        + ") && [ -n \"$a\" ] && [ \"$a\" = \"$b\" ]")
            .succeeded();
    };
    // The manifest has the checksums of the particles.
    EXPECT_TRUE(same("grep ' checkpoints/'", manifest));
    const std::string part = GetParam() == "collated" ? "processors2" : "processor1";
    for (const std::string field : {"U", "p", "phi", "voidFraction", "uniform/time", "uniform/checkpoint"})
    {
        // The head of a collated file has the folder of the case in it.
        if (field.find('/') == std::string::npos)
        {
            EXPECT_TRUE(
                same("checksum() { sed '/^ *location /d' \"$1\" | sha256sum; } && checksum", part + "/0.02/" + field))
                << field;
        }
        EXPECT_TRUE(stopped.runCommand("grep -q ' " + part + "/0.02/" + field + "$' " + manifest).succeeded()) << field;
    }
    EXPECT_EQ(massRows(stopped), massRows(through));
    const auto heights = through.table("postProcessing/particleHeight/0/particleHeight.dat");
    EXPECT_EQ(stopped.table("postProcessing/particleHeight/0/particleHeight.dat").size()
                  + stopped.table("postProcessing/particleHeight/0.01/particleHeight.dat").size(),
        heights.size());
    EXPECT_EQ(heights.size(), 21);
}

INSTANTIATE_TEST_SUITE_P(Handlers, FileHandler, testing::Values("collated", "masterUncollated"),
    [](const auto& handler) { return handler.param; });

// The fields of a run with `collated` equal those with one folder for each rank, bit for bit, and one rank resumes from them.
TEST(Collated, GivesTheSameFieldsAndIsResumedOnOneRank)
{
    TestCase usual;
    TestCase collated;
    for (TestCase* test : {&usual, &collated})
    {
        const std::string handler = test == &usual ? "uncollated" : "collated";
        prepare(*test, 0.01);
        const Outcome outcome = decomposeAndSolve(*test, handler);
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
        const Outcome together = test->runCommand("reconstructPar -fileHandler " + handler);
        ASSERT_TRUE(together.succeeded()) << together.output;
    }
    for (const std::string field : {"U", "p", "phi", "voidFraction", "alphaPhi"})
    {
        EXPECT_TRUE(usual.runCommand(TestCase::sameFile("0.01/" + field, collated)).succeeded()) << field;
    }
    const Outcome serial = collated.runCommand(goOnTo("0.011") + "$SOLVER");
    EXPECT_TRUE(serial.succeeded()) << serial.output;
    EXPECT_TRUE(serial.says("Resuming from the checkpoint of time 0.01")) << serial.output;
}

// A collated file of a checkpoint that was cut or changed, and a time that was never completed: both are set aside, and the
// run goes on from the checkpoint before. A manifest that holds the folders of single ranks only takes them for whole.
TEST(Collated, DamagedCheckpointsAreSetAside)
{
    TestCase test;
    prepare(test, 0.02);
    const Outcome first = decomposeAndSolve(test, "collated");
    ASSERT_TRUE(first.succeeded()) << first.output;
    for (const std::string damage : {": > processors2/0.02/phi", "truncate -s -20 processors2/0.02/p",
             "rm processors2/0.02/U", "rm checkpoints/0.02/complete"})
    {
        const std::string aside = damage.find("complete") == std::string::npos ? "damaged" : "unfinished";
        const Outcome outcome = test.runCommand("copy=$(mktemp -d) && cp -r . $copy && cd $copy && { " + damage + " && "
                                                + goOnTo("0.021") + solve("collated") + " && ls -d processors2/" + aside
                                                + ".0.02\n}; status=$?; rm -rf $copy; exit $status");
        EXPECT_TRUE(outcome.succeeded()) << damage << '\n' << outcome.output;
        EXPECT_TRUE(outcome.says("Resuming from the checkpoint of time 0.01")) << damage << '\n' << outcome.output;
    }
}

// purgeWrite takes both halves of old checkpoints. A program that leaves a folder of the time on each rank keeps all
// particles.
TEST(Collated, OldCheckpointsArePurged)
{
    TestCase test;
    prepare(test, 0.014);
    test.control().set("purgeWrite", "2").set("writeInterval", interval);
    const Outcome outcome = decomposeAndSolve(test, "collated");
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    EXPECT_EQ(test.runCommand("ls checkpoints").output, "0.013\n0.014\nbeginning\n");
    EXPECT_EQ(test.runCommand("ls processors2").output, "0\n0.013\n0.014\nconstant\n");
}

} // namespace clepsydra::tests
