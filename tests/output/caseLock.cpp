// First: OpenFOAM's `Log` is a macro, GoogleMock's a function.
#include <gmock/gmock.h>

#include "checkpoint/caseLock.h"
#include "support/errorOf.h"
#include "support/temporaryCase.h"

#include <gtest/gtest.h>

#include <csignal>
#include <optional>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace clepsydra::tests
{

namespace
{

/// The error of trying to lock, on this rank; empty where the lock was had (and let go).
std::string errorOfLocking(const TemporaryCase& temporaryCase)
{
    return errorOf([&] { const CaseLock lock(temporaryCase.time().globalPath()); });
}

/// A second lock on the case must fail on every rank, naming the case and the holder, and must succeed once the first
/// is gone. A lock that does nothing lets the second in; one that only checks that the file exists keeps the third out.
TEST(CaseLock, KeepsASecondOneOut)
{
    TemporaryCase temporaryCase;
    std::optional<CaseLock> first(temporaryCase.time().globalPath());

    const std::string error = errorOfLocking(temporaryCase);
    EXPECT_THAT(error, testing::HasSubstr(temporaryCase.folder().string()));
    if (Foam::Pstream::master())
    {
        EXPECT_THAT(error, testing::HasSubstr("process " + std::to_string(getpid()) + " on host "));
    }

    first.reset();
    EXPECT_EQ(errorOfLocking(temporaryCase), "");
}

/// Another program, killed without a chance to tidy up, must leave the case free, with its lock file still there.
TEST(CaseLock, IsFreedWhenTheOtherProgramIsKilled)
{
    TemporaryCase temporaryCase;
    const std::string file = temporaryCase.folder() / ".pimpleDemFoam.lock";
    pid_t other = 0;
    if (Foam::Pstream::master())
    {
        std::string program = "flock";
        std::string seconds = "60";
        std::string path = file;
        std::string noFork = "--no-fork";
        std::string sleep = "sleep";
        char* arguments[] = {program.data(), noFork.data(), path.data(), sleep.data(), seconds.data(), nullptr};
        ASSERT_EQ(posix_spawnp(&other, "flock", nullptr, nullptr, arguments, environ), 0);
    }

    bool keptOut = false;
    for (int tries = 0; tries < 500 && !keptOut; ++tries)
    {
        keptOut = !errorOfLocking(temporaryCase).empty();
        usleep(10000);
    }
    EXPECT_TRUE(keptOut);

    if (Foam::Pstream::master())
    {
        kill(other, SIGKILL);
        waitpid(other, nullptr, 0);
        EXPECT_TRUE(std::filesystem::exists(file));
    }
    EXPECT_EQ(errorOfLocking(temporaryCase), "");
}

/// A case that cannot be written to must be named together with the cause.
TEST(CaseLock, TellsWhyItCannotLock)
{
    try
    {
        const CaseLock lock("/nonexistent");
        FAIL() << "no error";
    }
    catch (const Foam::error& error)
    {
        EXPECT_THAT(error.message(), testing::HasSubstr("/nonexistent/.pimpleDemFoam.lock: No such file"));
    }
}

} // namespace

} // namespace clepsydra::tests
