// A full disk ends a run with an error. Nothing that was on the disk before is lost, and when there is room again the same
// command goes on.

#include "checkpoint/pilingParticles.h"
#include "files/fileSystemProbe.h"
#include "files/timeFolders.h"
#include "files/wholeFile.h"
#include "support/smallDisk.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iostream>

namespace clepsydra::tests
{

namespace
{

class WholeFile : public testing::Test
{
protected:
    WholeFile()
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "wholeFile-XXXXXX").string();
        folder_ = mkdtemp(pattern.data());
        file_ = folder_ / "table";
        std::ofstream(file_) << "old\n";
    }

    ~WholeFile() override
    {
        std::filesystem::remove_all(folder_);
    }

    std::string text() const
    {
        std::ifstream input(file_);
        return {std::istreambuf_iterator<char>(input), {}};
    }

    std::size_t filesThere() const
    {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
    }

    std::filesystem::path folder_;
    std::filesystem::path file_;
    static constexpr rlim_t room = 1000;
};

// A folder that cannot be read is not one without tables of earlier starts: a resumed run would begin its table again. Here it
// is a link to itself, which root cannot read either.
TEST_F(WholeFile, TimesOfAFolderThatCannotBeReadAreAnError)
{
    std::filesystem::create_directory(folder_ / "0.2");
    EXPECT_EQ(timeFolders(folder_).size(), 1U);
    EXPECT_TRUE(timeFolders(folder_ / "missing").empty());
    std::filesystem::create_symlink("loop", folder_ / "loop");
    EXPECT_THROW(timeFolders(folder_ / "loop"), FileError);
}

} // namespace

// A file that has no room leaves the old one as it was, and nothing of its own.
TEST_F(WholeFile, IsTheOldOneOrTheNewOne)
{
    {
        const SmallDisk disk(room);
        EXPECT_THROW(writeWhole(file_, std::string(2 * room, 'x')), FileError);
    }
    EXPECT_EQ(text(), "old\n");
    EXPECT_EQ(filesThere(), 1u);
    writeWhole(file_, "new\n");
    EXPECT_EQ(text(), "new\n");
    EXPECT_EQ(filesThere(), 1u);
}

// A folder that has no room for a few bytes, or is not there, cannot hold a checkpoint, which is said with its name; one that can
// is left as it was.
TEST_F(WholeFile, IsTriedInAFolderBeforehand)
{
    const auto errorIn = [](const std::filesystem::path& folder) -> std::string {
        try
        {
            probeFileSystem(folder, "probe");
        }
        catch (const FileError& error)
        {
            return error.what();
        }
        return {};
    };
    EXPECT_EQ(errorIn(folder_), "");
    EXPECT_EQ(filesThere(), 1u);
    {
        const SmallDisk disk(10);
        EXPECT_NE(
            errorIn(folder_).find("The folder " + folder_.string() + " cannot hold a checkpoint: "), std::string::npos);
    }
    EXPECT_EQ(filesThere(), 1u);
    EXPECT_NE(errorIn(folder_ / "none").find("/none cannot hold a checkpoint"), std::string::npos);
}

// A writer that does not look whether its bytes are taken: those that have no room are missed all the same.
TEST_F(WholeFile, ThroughAPipeIsCheckedForItsWriter)
{
    const auto writeThrough = [&](std::size_t bytes) {
        FileThroughPipe pipe(file_);
        std::ofstream(FileThroughPipe::entrance(file_)) << std::string(bytes, 'x');
        pipe.finish();
    };
    {
        const SmallDisk disk(room);
        EXPECT_THROW(writeThrough(2 * room), FileError);
    }
    EXPECT_EQ(text(), "old\n");
    EXPECT_EQ(filesThere(), 1u);
    writeThrough(2 * room);
    EXPECT_EQ(text().size(), 2 * room);
}

// A checksum that is not the file's, and a file of no length, are refused; a file without a checksum is not.
TEST_F(WholeFile, IsHeldAgainstTheChecksumBesideIt)
{
    EXPECT_NO_THROW(requireUndamaged(file_));
    writeChecksum(file_);
    EXPECT_NO_THROW(requireUndamaged(file_));
    std::ofstream(file_) << "odd\n";
    EXPECT_THROW(requireUndamaged(file_), FileError);
    std::filesystem::remove(checksumName(file_));
    std::ofstream(file_, std::ios::trunc).close();
    EXPECT_THROW(requireUndamaged(file_), FileError);
    // NIST's example of FIPS 180-4
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

namespace
{

/// A case of its own disk, on which `commands` run; there `room N` leaves N kilobytes. What the runs have come to is copied
/// back. All in one mount namespace, so that nothing is left of the disk.
Outcome onOwnDisk(TestCase& test, const std::string& commands)
{
    return test.runCommand(R"(unshare --mount sh -c '
        set -e
        mkdir -p disk
        mount -t tmpfs -o size=100M none disk
        cp -r 0 DEM constant system disk
        cd disk
        room() { mount -o remount,size=$(($(df --output=used . | tail -n 1) + $1))k none .; }
        )" + commands + R"(
        room 100000
        $SOLVER
        cp -r checkpoints postProcessing ..')");
}

bool canMount(TestCase& test)
{
    return test.runCommand("mkdir -p try && unshare --mount mount -t tmpfs none try").succeeded();
}

void threeCheckpoints(TestCase& test)
{
    pilingParticles(test, true);
    test.dem.dumpEvery = 0;
    test.setTimes(0.03, interval, 0.01);
}

} // namespace

class FullDisk : public testing::Test
{
protected:
    void SetUp() override
    {
        threeCheckpoints(through_);
        if (!canMount(through_))
        {
            GTEST_SKIP() << "no right to mount a small disk here";
        }
        ASSERT_TRUE(through_.run().succeeded());
    }

    /// The manifest of .03 s holds the checksums of all that the run has come to.
    void expectUndisturbed(TestCase& test, const Outcome& outcome)
    {
        EXPECT_TRUE(outcome.succeeded()) << outcome.output;
        EXPECT_TRUE(test.runCommand(TestCase::sameCheckpoint("0.03", through_)).succeeded()) << outcome.output;
        EXPECT_EQ(massRows(test), massRows(through_));
    }

    TestCase through_;
};

// The disk fills while the run goes on: in fields, particles, or tables, as it comes. The run ends with an error, the
// second one ends as one that was never disturbed.
TEST_F(FullDisk, EndsTheRunAndNothingIsLost)
{
    for (const std::string kilobytes : {"60", "150", "300", "420"})
    {
        TestCase test;
        threeCheckpoints(test);
        ASSERT_TRUE(test.makeMesh().succeeded());
        const Outcome outcome =
            onOwnDisk(test, "room " + kilobytes + "; status=0; $SOLVER || status=$?; echo first run: $status");
        EXPECT_TRUE(outcome.says("first run: 1")) << kilobytes << outcome.output;
        expectUndisturbed(test, outcome);
    }
}

// A run that is resumed on a full disk cuts the rows that it will write again, and loses none before.
TEST_F(FullDisk, TakesNoRowFromTheTables)
{
    TestCase test;
    threeCheckpoints(test);
    ASSERT_TRUE(test.makeMesh().succeeded());
    const Outcome outcome = onOwnDisk(test, R"(
        echo "endTime 0.025;" >> system/controlDict
        $SOLVER
        table=postProcessing/massInHopper/0/massInHopper.dat
        grep -v "^#" $table | head -n 25 > ../before
        echo "endTime 0.03;" >> system/controlDict
        room 0
        status=0
        $SOLVER || status=$?
        echo second run: $status
        grep -v "^#" $table | head -n 25 | cmp - ../before
        echo "endTime 0.03;" >> system/controlDict)");
    EXPECT_TRUE(outcome.says("second run: 1")) << outcome.output;
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    EXPECT_EQ(massRows(test).size(), massRows(through_).size());
}

} // namespace clepsydra::tests
