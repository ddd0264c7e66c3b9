/// \file
/// At its start the program detects a LIGGGHTS library that does not match the headers that it was compiled with.
/// lyingLibrary.cpp, preloaded, imitates such libraries.

#include "support/testCase.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace clepsydra::tests
{

namespace
{

struct Lie
{
    const char* library;
    /// Words of the message; none: the library is honest.
    std::vector<std::string> words;
};

void PrintTo(const Lie& lie, std::ostream* os)
{
    *os << lie.library;
}

class LibrarySelfTest : public ::testing::TestWithParam<Lie>
{};

} // namespace

/// A library that differs from its headers is refused, whatever the difference: the message names the library's file, what
/// differs and what is allowed, the status is not that of a signal, and the script has not begun (LIGGGHTS' log is not
/// there). The library without a lie is accepted, so that what is refused is the lie and not the preloading. Without the
/// self-test all runs succeed or end by a signal.
TEST_P(LibrarySelfTest, RefusesALibraryThatIsNotTheOneOfItsHeaders)
{
    TestCase test;
    test.cells = {4, 4, 8};
    test.dem.particles = {{0.0101, 0.0099, 0.02}};
    test.dem.timeStep = 4e-5;
    test.setTimes(0.001, 1e-3, 0.001);
    const std::string library = std::string(LIBRARIES) + "/lib" + GetParam().library + ".so";
    ASSERT_TRUE(std::filesystem::exists(library)) << library;
    ASSERT_TRUE(test.makeMesh().succeeded());
    const Outcome outcome = test.runCommand("LD_PRELOAD=" + library + " $SOLVER");
    if (!outcome.says("the lying library was called"))
    {
        GTEST_SKIP() << "LIGGGHTS' library is linked with -Bsymbolic-functions: it calls no preloaded function";
    }
    if (GetParam().words.empty())
    {
        EXPECT_TRUE(outcome.succeeded()) << outcome.output;
        return;
    }
    EXPECT_NE(outcome.status, 0) << outcome.output;
    EXPECT_LT(outcome.status, 128) << "ended by a signal\n" << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(test.path() / "log.liggghts"));
    for (const std::string& word : GetParam().words)
    {
        EXPECT_TRUE(outcome.says(word)) << "not said: " << word << "\n" << outcome.output;
    }
    for (const char* word : {"libliggghts.so", "allowed: LIGGGHTS 3.8, built with the flags of the headers"})
    {
        EXPECT_TRUE(outcome.says(word)) << "not said: " << word << "\n" << outcome.output;
    }
}

INSTANTIATE_TEST_SUITE_P(Lies, LibrarySelfTest,
    ::testing::Values(Lie{"honestLibrary", {}}, Lie{"lyingVersion", {"of another version", "LIGGGHTS-PUBLIC 3.7.0"}},
        Lie{"lyingSize", {"class Atom of about", "its headers one of"}},
        Lie{"lyingMember", {"has the member 'radius'", "at another place than its headers"}},
        Lie{"lyingTag", {"the id (tag) of particle 2 as 0 instead of 2"}},
        Lie{"lyingForce", {"a component of the Hertz force of two particles (LIGGGHTS' loop) as"}}),
    [](const auto& lie) { return std::string(lie.param.library); });

} // namespace clepsydra::tests
