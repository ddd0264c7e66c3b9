// The pressure force on the particles is compared with its reaction in the fluid's equation, eps grad p. The force is
// falsified here on purpose, which must end the run.

#include "conservation/faults.h"

namespace clepsydra::tests
{

namespace
{

/// Water in which p rises. The gradient passes the smoothing by itself, its three components together.
StreamSetup withForceTimes(double factor, const std::string& cells)
{
    StreamSetup setup = faultyStream(3, 2, factor, cells);
    setup.pressureGradient = 0.5;
    return setup;
}

} // namespace

// The same water without a fault, and with correct smoothing over finer cells, passes; without this test the others
// would show nothing.
TEST(PressureForceBalance, BalancesWhereNothingIsLost)
{
    EXPECT_NO_THROW(Stream(withForceTimes(1, "all")).advance([](fvVectorMatrix&) {}));
    StreamSetup smoothed;
    smoothed.pressureGradient = 0.5;
    EXPECT_NO_THROW(Stream(smoothed).advance([](fvVectorMatrix&) {}));
}

TEST(PressureForceBalance, FindsAForceThatIsDoubled)
{
    expectFound([] { const Stream stream(withForceTimes(2, "all")); }, "pressureForceTolerance");
}

TEST(PressureForceBalance, FindsAWrongSign)
{
    expectFound([] { const Stream stream(withForceTimes(-1, "all")); }, "pressureForceTolerance");
}

TEST(PressureForceBalance, FindsThatTheParticleOfOneCellDoesNotFeelIt)
{
    expectFound([] { const Stream stream(withForceTimes(0, "one")); }, "pressureForceTolerance");
}

} // namespace clepsydra::tests
