// Sums and maxima over the ranks in one reduction.

#include "rankTotals.h"

#include "benchmarks/countMessages.h"

#include "Pstream.H"
#include "vector.H"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace clepsydra::tests
{

namespace
{

double ranks()
{
    return Foam::Pstream::nProcs();
}

bool isLastRank()
{
    return Foam::Pstream::myProcNo() == Foam::Pstream::nProcs() - 1;
}

} // namespace

// Three parts add sums, maxima and both; each receives its own totals, in the order in which they were added, and the ranks
// speak to each other once. A class that reduces each part by itself makes three calls.
TEST(RankTotals, GoThroughOneReduction)
{
    const double here = Foam::Pstream::myProcNo();
    std::string order;
    RankTotals totals;
    totals.add({{here + 1, 2}, {}}, [&](const RankNumbers& all) {
        order += 'a';
        EXPECT_EQ(all.sums, (std::vector<double>{ranks() * (ranks() + 1) / 2, 2 * ranks()}));
        EXPECT_TRUE(all.maxima.empty());
    });
    totals.add({{}, {here, -here}}, [&](const RankNumbers& all) {
        order += 'b';
        EXPECT_TRUE(all.sums.empty());
        EXPECT_EQ(all.maxima, (std::vector<double>{ranks() - 1, 0}));
    });
    RankNumbers force{{10}, {here * here}};
    force.addVector(Foam::vector(1, here, -1));
    totals.add(force, [&](const RankNumbers& all) {
        order += 'c';
        EXPECT_EQ(all.sums[0], 10 * ranks());
        EXPECT_EQ(all.vectorAt<Foam::vector>(1), Foam::vector(ranks(), ranks() * (ranks() - 1) / 2, -ranks()));
        EXPECT_EQ(all.maxima[0], (ranks() - 1) * (ranks() - 1));
    });
    const double callsBefore = collectiveCallsSoFar();
    const long reductionsBefore = RankTotals::reductions();
    EXPECT_TRUE(totals.reduce());
    EXPECT_EQ(order, "abc");
    EXPECT_EQ(RankTotals::reductions() - reductionsBefore, 1);
    EXPECT_EQ(collectiveCallsSoFar() - callsBefore, Foam::Pstream::parRun() ? 1 : 0);

    // It is empty now: nothing is sent, and nothing is used a second time.
    EXPECT_TRUE(totals.reduce());
    EXPECT_EQ(order, "abc");
    EXPECT_EQ(RankTotals::reductions() - reductionsBefore, 1);
}

// Numbers that no reduction may change: of one rank all of them, of several an integer of 53 bits.
TEST(RankTotals, AreExact)
{
    const double large = std::ldexp(1, 53) - 1;
    const RankNumbers ofOne =
        RankTotals::of({{Foam::Pstream::master() ? large : 0}, {Foam::Pstream::master() ? 0.1 : -1}});
    EXPECT_EQ(ofOne.sums[0], large);
    EXPECT_EQ(ofOne.maxima[0], 0.1);
    if (!Foam::Pstream::parRun())
    {
        const RankNumbers numbers{{0.1 + 0.2, 1e-310, -0.0}, {1.0 / 3}};
        const RankNumbers same = RankTotals::of(numbers);
        EXPECT_EQ(same.sums, numbers.sums);
        EXPECT_TRUE(std::signbit(same.sums[2]));
        EXPECT_EQ(same.maxima, numbers.maxima);
    }
}

// What is not a number on one rank is found on all of them. The maximum of MPI, and std::max() in one of the two orders,
// leave it out.
TEST(RankTotals, PassOnWhatIsNotANumber)
{
    constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
    for (const bool isLast : {true, false})
    {
        const bool isHere = isLast ? isLastRank() : Foam::Pstream::master();
        const RankNumbers all = RankTotals::of({{isHere ? notANumber : 1, 1}, {isHere ? notANumber : 1, 1}});
        EXPECT_TRUE(std::isnan(all.sums[0]));
        EXPECT_EQ(all.sums[1], ranks());
        EXPECT_TRUE(std::isnan(all.maxima[0]));
        EXPECT_EQ(all.maxima[1], 1);
    }
}

// The last rank alone has assumed something wrong. No rank may use a total then, although that was added first, and each
// condition is asked, because it notes what it finds. The copy, in which the condition was not added, is used.
TEST(RankTotals, AreNotUsedWhereAConditionDoesNotHold)
{
    int used = 0;
    int asked = 0;
    RankTotals before;
    before.add({{1}, {}}, [&](const RankNumbers& all) {
        ++used;
        EXPECT_EQ(all.sums[0], ranks());
    });
    RankTotals totals = before;
    totals.require({{}, {isLastRank() ? 1.0 : 0.0}}, [&](const RankNumbers& all) {
        ++asked;
        return all.maxima[0] == 0;
    });
    totals.require({{1}, {}}, [&](const RankNumbers& all) {
        ++asked;
        return all.sums[0] == ranks();
    });
    EXPECT_FALSE(totals.reduce());
    EXPECT_EQ(asked, 2);
    EXPECT_EQ(used, 0);

    before.require({{1}, {}}, [&](const RankNumbers& all) { return all.sums[0] == ranks(); });
    EXPECT_TRUE(before.reduce());
    EXPECT_EQ(used, 1);
}

// An error of a check ends the call; what was added before it is not used again by the next one.
TEST(RankTotals, AreEmptyAfterAnError)
{
    RankTotals totals;
    totals.add({{1}, {}}, [](const RankNumbers&) { throw std::runtime_error("found"); });
    EXPECT_THROW(totals.reduce(), std::runtime_error);
    bool used = false;
    totals.add({{2}, {}}, [&](const RankNumbers& all) { used = all.sums[0] == 2 * ranks(); });
    EXPECT_TRUE(totals.reduce());
    EXPECT_TRUE(used);
}

} // namespace clepsydra::tests
