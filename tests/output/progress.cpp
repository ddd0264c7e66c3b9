// First: OpenFOAM's `Log` is a macro, GoogleMock's a function.
#include <gmock/gmock.h>

#include "run/progress.h"

#include "Pstream.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace clepsydra::tests
{

namespace
{

/// From 1 s to 1.5 s took 60 s: 120 s per simulated second. Progress from 0 instead of from the start of the run gives 40.
TEST(Progress, TellsSpeedAndTimeToGo)
{
    EXPECT_EQ(describe({1.5, 1, 3, 60, 2931, 180}),
        "t = 1.5/3 s, 2931 particles in the hopper, 120 s per simulated s, 00:03:00 to go");
    EXPECT_EQ(describe({1, 1, 3, 0, -1, -1}), "t = 1/3 s");
}

/// In a log: nothing but one plain line per write time, without control characters, and from the master only.
TEST(Progress, WritesPlainLinesToALog)
{
    std::ostringstream log;
    {
        Progress progress(log, false);
        for (int step = 1; step <= 100; ++step)
        {
            progress.update(0.01 * step, 2, 50, -1, step % 50 == 0);
        }
    }
    const std::string text = log.str();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), Foam::Pstream::master() ? 2 : 0);
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("\r")));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("\x1b")));
    if (Foam::Pstream::master())
    {
        EXPECT_THAT(text, testing::HasSubstr("t = 0.5/2 s, 50 particles in the hopper"));
    }
}

/// On a terminal: a bar at once, but not one per call (a thousand calls take far less than a second), and a clean line
/// at the end.
TEST(Progress, DrawsABarOnATerminal)
{
    std::ostringstream terminal;
    {
        Progress progress(terminal, true);
        for (int step = 1; step <= 1000; ++step)
        {
            progress.update(0.001 * step, 2, 50, -1);
        }
    }
    if (Foam::Pstream::master())
    {
        const std::string text = terminal.str();
        EXPECT_LT(text.size(), 2000U);
        EXPECT_THAT(text, testing::HasSubstr("50 particles in the hopper"));
        EXPECT_THAT(text, testing::EndsWith("\r\x1b[K"));
    }
}

} // namespace

} // namespace clepsydra::tests
