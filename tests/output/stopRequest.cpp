/// \file
/// A run is asked to stop by a signal to any of its ranks, or by the clock, and all ranks stop together.

#include "checkpoint/stopRequest.h"
#include "support/temporaryCase.h"

#include <gtest/gtest.h>

#include <csignal>

namespace clepsydra::tests
{

namespace
{

/// A batch system may signal one process of a job only, and not the first. A rank that would ask itself alone would write its
/// checkpoint and end while the others wait for it in the next coupling step. (The request is never taken back, so this
/// is the only test of a signal in this program.)
TEST(StopRequest, OfTheLastRankStopsAll)
{
    const TemporaryCase folder;
    StopRequest stop(folder.time());
    const auto asked = [&] {
        RankTotals totals;
        stop.addTo(totals);
        totals.reduce();
        return stop.asked();
    };
    EXPECT_FALSE(asked());
    if (Foam::Pstream::myProcNo() == Foam::Pstream::nProcs() - 1)
    {
        std::raise(SIGTERM);
    }
    EXPECT_TRUE(asked()) << "on rank " << Foam::Pstream::myProcNo();
}

} // namespace

} // namespace clepsydra::tests
