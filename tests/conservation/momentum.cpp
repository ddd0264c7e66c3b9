// The conservation check of momentum compares the momentum that particles received with the source in the solved
// equation. A check that derived one from the other would never find an error, so each kind of loss is introduced here
// on purpose and must end the run.

#include "conservation/faults.h"
#include "couplingStep/contributions.h"

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

// What a particle has received does not come to its cell, as with a faulty exchange between ranks.
TEST_P(MomentumBalance, FindsThatOneParticlesImpulseIsDropped)
{
    const auto withImpulseTimes = [](double factor) {
        constexpr int alongZ = ContributionRows::momentum.first + 2;
        StreamSetup setup = faultyStream(static_cast<int>(ContributionRows(false).count), alongZ, factor, "one");
        setup.momentumModel = GetParam();
        return setup;
    };
    Stream(withImpulseTimes(1)).advance(asItIs);
    Stream stream(withImpulseTimes(0));
    expectFound(stream, asItIs);
}

INSTANTIATE_TEST_SUITE_P(Both, MomentumBalance, testing::Values("implicitCouple", "explicitCouple"),
    [](const testing::TestParamInfo<std::string>& model) { return model.param; });

} // namespace clepsydra::tests
