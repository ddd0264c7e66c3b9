// The conservation check of momentum compares the momentum that particles received with the source in the solved
// equation. A check that derived one from the other would never find an error, so each kind of loss is introduced here
// on purpose and must end the run.

#include "conservation/faults.h"

namespace clepsydra::tests
{

namespace
{

const auto asItIs = [](fvVectorMatrix&) {};

StreamSetup streamWith(const std::string& momentumModel)
{
    StreamSetup setup;
    setup.momentumModel = momentumModel;
    return setup;
}

class MomentumBalance : public testing::TestWithParam<std::string>
{
protected:
    static void expectFound(Stream& stream, const std::function<void(fvVectorMatrix&)>& fault)
    {
        tests::expectFound([&] { stream.advance(fault); }, "momentumTolerance");
    }
};

} // namespace

// Twenty coupling steps without a fault pass the check; without this test the others would show nothing.
TEST_P(MomentumBalance, BalancesWhereNothingIsLost)
{
    Stream stream(streamWith(GetParam()));
    for (int interval = 0; interval < 20; ++interval)
    {
        EXPECT_NO_THROW(stream.advance(asItIs));
    }
}

TEST_P(MomentumBalance, FindsASourceThatIsDoubled)
{
    Stream stream(streamWith(GetParam()));
    stream.advance(asItIs);
    expectFound(stream, [](fvVectorMatrix& source) { source *= dimensionedScalar("two", dimless, 2); });
}

TEST_P(MomentumBalance, FindsAWrongSign)
{
    Stream stream(streamWith(GetParam()));
    stream.advance(asItIs);
    expectFound(stream, [](fvVectorMatrix& source) { source.negate(); });
}

TEST_P(MomentumBalance, FindsThatACellHasLostItsShare)
{
    Stream stream(streamWith(GetParam()));
    stream.advance(asItIs);
    expectFound(stream, [](fvVectorMatrix& source) {
        const label cell = findMax(cmptMag(source.source())().component(vector::Z)());
        source.source()[cell] = vector::zero;
    });
}

TEST_P(MomentumBalance, FindsThatOneParticlesImpulseIsDropped)
{
    Stream stream(streamWith(GetParam()));
    stream.advance(asItIs);
    stream.engine().forgetFromNowOn();
    expectFound(stream, asItIs);
}

INSTANTIATE_TEST_SUITE_P(Both, MomentumBalance, testing::Values("implicitCouple", "explicitCouple"),
    [](const testing::TestParamInfo<std::string>& model) { return model.param; });

} // namespace clepsydra::tests
