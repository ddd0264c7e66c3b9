// The solid volume in the cells is compared with that of the particles. A check that added up the cells twice would
// never find an error, so volume is removed and added here on purpose, between the distribution and the void fraction,
// and must end the run.

#include "conservation/faults.h"

namespace clepsydra::tests
{

namespace
{

/// Of all particles, as the run begins: the one row that is smoothed then.
StreamSetup withSolidVolumeTimes(double factor)
{
    return faultyStream(1, 0, factor, "one");
}

} // namespace

// The same stream without a fault passes; without this test the others would show nothing.
TEST(SolidVolumeBalance, BalancesWhereNothingIsLost)
{
    EXPECT_NO_THROW(Stream(withSolidVolumeTimes(1)).advance([](fvVectorMatrix&) {}));
}

TEST(SolidVolumeBalance, FindsAShareThatIsLost)
{
    expectFound([] { const Stream stream(withSolidVolumeTimes(0)); }, "solidVolumeTolerance");
}

TEST(SolidVolumeBalance, FindsACellWhoseSolidVolumeIsDoubled)
{
    expectFound([] { const Stream stream(withSolidVolumeTimes(2)); }, "solidVolumeTolerance");
}

TEST(SolidVolumeBalance, FindsAMillionthOfACell)
{
    expectFound([] { const Stream stream(withSolidVolumeTimes(1 + 1e-6)); }, "solidVolumeTolerance");
}

} // namespace clepsydra::tests
