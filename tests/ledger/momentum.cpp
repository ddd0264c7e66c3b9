// The momentum ledger compares what the beads were given with what the solved equation holds. A ledger that works out one
// from the other balances whatever happens; so each kind of loss is made here on purpose, and must end the run.

#include "ledger/faults.h"

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

class MomentumLedger : public testing::TestWithParam<std::string>
{
protected:
    static void expectFound(Stream& stream, const std::function<void(fvVectorMatrix&)>& fault)
    {
        tests::expectFound([&] { stream.advance(fault); }, "momentumTolerance");
    }
};

} // namespace

// Twenty intervals of an honest run balance; without this the others would show nothing.
TEST_P(MomentumLedger, BalancesWhereNothingIsLost)
{
    Stream stream(streamWith(GetParam()));
    for (int interval = 0; interval < 20; ++interval)
    {
        EXPECT_NO_THROW(stream.advance(asItIs));
    }
}

TEST_P(MomentumLedger, FindsASourceThatIsDoubled)
{
    Stream stream(streamWith(GetParam()));
    stream.advance(asItIs);
    expectFound(stream, [](fvVectorMatrix& source) { source *= dimensionedScalar("two", dimless, 2); });
}

TEST_P(MomentumLedger, FindsAWrongSign)
{
    Stream stream(streamWith(GetParam()));
    stream.advance(asItIs);
    expectFound(stream, [](fvVectorMatrix& source) { source.negate(); });
}

TEST_P(MomentumLedger, FindsThatACellHasLostItsShare)
{
    Stream stream(streamWith(GetParam()));
    stream.advance(asItIs);
    expectFound(stream, [](fvVectorMatrix& source) {
        const label cell = findMax(cmptMag(source.source())().component(vector::Z)());
        source.source()[cell] = vector::zero;
    });
}

TEST_P(MomentumLedger, FindsThatOneBeadsImpulseIsDropped)
{
    Stream stream(streamWith(GetParam()));
    stream.advance(asItIs);
    stream.engine().forgetFromNowOn();
    expectFound(stream, asItIs);
}

INSTANTIATE_TEST_SUITE_P(Both, MomentumLedger, testing::Values("implicitCouple", "explicitCouple"),
    [](const testing::TestParamInfo<std::string>& model) { return model.param; });

} // namespace clepsydra::tests
