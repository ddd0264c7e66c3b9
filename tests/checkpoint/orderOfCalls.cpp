// What is on the disk when the power fails follows from the order in which a program writes, syncs and renames. That order
// is recorded here from a run of the program: a call that is missing cannot be made to fail, so that no fault finds it.

#include "checkpoint/pilingParticles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace clepsydra::tests
{

namespace
{

namespace fs = std::filesystem;

struct Call
{
    std::string name;
    fs::path file;
    fs::path to; // of rename()
};

std::vector<Call> recorded(const fs::path& record)
{
    std::vector<Call> calls;
    std::ifstream input(record);
    for (std::string line; std::getline(input, line);)
    {
        std::istringstream words(line);
        std::string file;
        std::string to;
        Call call;
        words >> call.name >> file >> to;
        call.file = file;
        call.to = to;
        calls.push_back(call);
    }
    return calls;
}

bool isSynced(const std::vector<Call>& calls, std::size_t from, std::size_t until, const fs::path& file)
{
    return std::any_of(calls.begin() + static_cast<std::ptrdiff_t>(from),
        calls.begin() + static_cast<std::ptrdiff_t>(until),
        [&](const Call& call) { return call.name == "fsync" && call.file == file; });
}

} // namespace

// A file that takes the name of another one is on the disk before, and the folder that holds the name after it. And when the
// manifest of a checkpoint takes its name, `complete`, each file that it lists is on the disk. Without one of these calls
// a power failure leaves an empty file under the name of a whole one.
TEST(OrderOfCalls, LeavesWholeFilesOnTheDisk)
{
    TestCase test;
    pilingParticles(test, true);
    test.setTimes(0.002, interval, interval);
    const Outcome mesh = test.makeMesh();
    ASSERT_TRUE(mesh.succeeded()) << mesh.output;
    const Outcome outcome =
        test.runCommand("RECORDED_CALLS=$PWD/calls LD_PRELOAD=" RECORD_CALLS ":$LD_PRELOAD $SOLVER");
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;

    const fs::path folder = fs::canonical(test.path());
    const std::vector<Call> calls = recorded(folder / "calls");
    int complete = 0;
    for (std::size_t i = 0; i < calls.size(); ++i)
    {
        const Call& call = calls[i];
        if (call.name != "rename")
        {
            continue;
        }
        EXPECT_TRUE(isSynced(calls, 0, i, call.file)) << call.to << " takes its name before it is on the disk";
        EXPECT_TRUE(isSynced(calls, i, calls.size(), call.to.parent_path()))
            << "the name " << call.to << " is not brought to the disk";
        if (call.to.filename() != "complete")
        {
            continue;
        }
        ++complete;
        std::ifstream manifest(call.to);
        int listed = 0;
        for (std::string line; std::getline(manifest, line);)
        {
            std::istringstream words(line);
            std::string digest;
            std::string size;
            std::string name;
            if (words >> digest >> size >> name && digest.size() == 64)
            {
                ++listed;
                // The particles' files are on the disk since they took their names.
                const bool synced =
                    isSynced(calls, 0, i, folder / name) || isSynced(calls, 0, i, folder / (name + ".unfinished"));
                EXPECT_TRUE(synced) << name << " is listed in " << call.to << " before it is on the disk";
            }
        }
        EXPECT_GT(listed, 8);
    }
    EXPECT_EQ(complete, 2) << "one of each checkpoint";
}

} // namespace clepsydra::tests
