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
    expectFound([] { Stream(withForceTimes(2, "all")).advance([](fvVectorMatrix&) {}); }, "pressureForceTolerance");
}

TEST(PressureForceBalance, FindsAWrongSign)
{
    expectFound([] { Stream(withForceTimes(-1, "all")).advance([](fvVectorMatrix&) {}); }, "pressureForceTolerance");
}

TEST(PressureForceBalance, FindsThatTheParticleOfOneCellDoesNotFeelIt)
{
    expectFound([] { Stream(withForceTimes(0, "one")).advance([](fvVectorMatrix&) {}); }, "pressureForceTolerance");
}

// The gradient that was sampled balances; the force that a particle then received does not. A check of the sampled gradient
// finds neither this nor the next fault.
TEST(PressureForceBalance, FindsAParticleThatDoesNotFeelWhatWasSampledAtIt)
{
    Stream stream(withForceTimes(1, "all"));
    EXPECT_NO_THROW(stream.advance([](fvVectorMatrix&) {}));
    stream.engine().losePressureGradientFromNowOn();
    expectFound([&] { stream.advance([](fvVectorMatrix&) {}); }, "pressureForceTolerance");
}

TEST(PressureForceBalance, FindsADemStepThatIsMissing)
{
    Stream stream(withForceTimes(1, "all"));
    EXPECT_NO_THROW(stream.advance([](fvVectorMatrix&) {}));
    stream.engine().missAStepFromNowOn();
    expectFound([&] { stream.advance([](fvVectorMatrix&) {}); }, "pressureForceTolerance");
}

// A case that leaves the force out on purpose runs on, and the error is reported in full.
TEST(PressureForceBalance, IsNoReasonToStopWhereTheForceIsLeftOut)
{
    StreamSetup setup = withForceTimes(1, "all");
    setup.pressureForce = "noPressureGradient";
    Stream stream(setup);
    EXPECT_NO_THROW(stream.advance([](fvVectorMatrix&) {}));
    EXPECT_NEAR(stream.pressureForceError(), 1, 1e-9);
}

} // namespace clepsydra::tests
