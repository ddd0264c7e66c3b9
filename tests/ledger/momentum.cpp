// The momentum ledger compares what the beads were given with what the solved equation holds. A ledger that works out one
// from the other balances whatever happens; so each kind of loss is made here on purpose, and must end the run.

#include <gmock/gmock.h>

#include "interval/couplingInterval.h"
#include "support/boxMesh.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"

#include "fvm.H"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

namespace
{

using namespace Foam;

/// Shows one bead without its impulse to those who count the beads and put them into cells after an interval, as an
/// exchange between ranks would that forgets it; at home, where it is asked for next, the bead still has it.
class ForgetfulEngine final : public FakeEngine
{
public:
    using FakeEngine::FakeEngine;

    void advance(int steps) override
    {
        FakeEngine::advance(steps);
        viewsWithout_ = forgets_ ? 2 : 0;
    }

    BeadsView beads() override
    {
        BeadsView all = FakeEngine::beads();
        if (viewsWithout_ > 0)
        {
            --viewsWithout_;
            shown_.assign(all.state, all.state + all.size());
            shown_.front().given.impulse.setZero();
            all.state = shown_.data();
        }
        return all;
    }

    void forgetFromNowOn()
    {
        forgets_ = true;
    }

private:
    bool forgets_ = false;
    int viewsWithout_ = 0;
    std::vector<CouplingState> shown_;
};

/// Eight beads in a box of water that streams past them, and the simplest fluid's equation: dU/dt = source.
class Stream
{
public:
    explicit Stream(const std::string& momentumModel)
    {
        case_.writeDictionary("constant/couplingProperties",
            "fluid incompressible; modelType A; couplingInterval 0.01; voidFractionModel divided; "
            "smoothingModel constDiffSmoothing; constDiffSmoothingProps { smoothingLength 0.15; } "
            "forceModels (SchillerNaumannDrag gradPForce Archimedes); momCoupleModels ("
                + momentumModel + "); DEM { engine liggghts; script none; }");
        mesh_ = boxMesh(case_.time(), point::zero, point::one, {6, 6, 6});
        readFromCase(static_cast<fvSchemes&>(*mesh_));
        readFromCase(static_cast<fvSolution&>(*mesh_));
        for (int bead = 0; bead < 8; ++bead)
        {
            engine_.addBead(bead + 1, Vector3d(bead & 1 ? 0.7 : 0.3, bead & 2 ? 0.7 : 0.3, bead & 4 ? 0.7 : 0.3), 0.02);
        }
        const FluidProperties fluid{1000, 1, Vector3d::Zero()};
        settings_ = std::make_unique<CouplingSettings>(case_.time());
        models_ = std::make_unique<FluidModels>(*mesh_, *settings_, fluid, timers_);
        interval_ =
            std::make_unique<CouplingInterval>(*mesh_, *settings_, fluid, engine_, models_.get(), timers_, false);
        U_ = std::make_unique<volVectorField>(IOobject("U", case_.time().timeName(), *mesh_), *mesh_,
            dimensionedVector("U", dimVelocity, vector(0, 0, 0.1)), "zeroGradient");
        p_ = std::make_unique<volScalarField>(IOobject("p", case_.time().timeName(), *mesh_), *mesh_,
            dimensionedScalar("p", dimPressure / dimDensity, 0), "zeroGradient");
        interval_->start(*U_, *p_);
    }

    /// \param solved  what becomes of the beads' source before it is put into the equation
    void advance(const std::function<void(fvVectorMatrix&)>& solved)
    {
        ++case_.time();
        U_->storeOldTime();
        interval_->advance(*U_, *p_, [&] {
            fvVectorMatrix source(interval_->fluid().momentumSource(*U_));
            solved(source);
            solve(fvm::ddt(*U_) == source);
            return SolvedFluid{sum(mesh_->V().field() * (source & *U_)().primitiveField()),
                tmp<volScalarField>::New("none", interval_->fluid().ddtVoidFraction())};
        });
    }

    ForgetfulEngine& engine()
    {
        return engine_;
    }

private:
    /// A mesh made in memory comes without them.
    template<class Dictionary>
    static void readFromCase(Dictionary& dictionary)
    {
        dictionary.readOpt() = IOobject::MUST_READ;
        dictionary.read();
    }

    TemporaryCase case_;
    std::unique_ptr<fvMesh> mesh_;
    PhaseTimers timers_;
    ForgetfulEngine engine_{1e-3, Vector3d::Zero()};
    std::unique_ptr<CouplingSettings> settings_;
    std::unique_ptr<FluidModels> models_;
    std::unique_ptr<CouplingInterval> interval_;
    std::unique_ptr<volVectorField> U_;
    std::unique_ptr<volScalarField> p_;
};

const auto asItIs = [](fvVectorMatrix&) {};

class MomentumLedger : public testing::TestWithParam<std::string>
{
protected:
    void SetUp() override
    {
        FatalError.throwExceptions();
        FatalIOError.throwExceptions();
    }

    void TearDown() override
    {
        FatalError.dontThrowExceptions();
        FatalIOError.dontThrowExceptions();
    }

    static void expectFound(Stream& stream, const std::function<void(fvVectorMatrix&)>& fault)
    {
        try
        {
            stream.advance(fault);
            ADD_FAILURE() << "the books balance";
        }
        catch (const Foam::error& error)
        {
            EXPECT_THAT(std::string(error.message()), testing::HasSubstr("momentumTolerance"));
        }
    }
};

} // namespace

// Twenty intervals of an honest run balance; without this the others would show nothing.
TEST_P(MomentumLedger, BalancesWhereNothingIsLost)
{
    Stream stream(GetParam());
    for (int interval = 0; interval < 20; ++interval)
    {
        EXPECT_NO_THROW(stream.advance(asItIs));
    }
}

TEST_P(MomentumLedger, FindsASourceThatIsDoubled)
{
    Stream stream(GetParam());
    stream.advance(asItIs);
    expectFound(stream, [](fvVectorMatrix& source) { source *= dimensionedScalar("two", dimless, 2); });
}

TEST_P(MomentumLedger, FindsAWrongSign)
{
    Stream stream(GetParam());
    stream.advance(asItIs);
    expectFound(stream, [](fvVectorMatrix& source) { source.negate(); });
}

TEST_P(MomentumLedger, FindsThatACellHasLostItsShare)
{
    Stream stream(GetParam());
    stream.advance(asItIs);
    expectFound(stream, [](fvVectorMatrix& source) {
        const label cell = findMax(cmptMag(source.source())().component(vector::Z)());
        source.source()[cell] = vector::zero;
    });
}

TEST_P(MomentumLedger, FindsThatOneBeadsImpulseIsDropped)
{
    Stream stream(GetParam());
    stream.advance(asItIs);
    stream.engine().forgetFromNowOn();
    expectFound(stream, asItIs);
}

INSTANTIATE_TEST_SUITE_P(Both, MomentumLedger, testing::Values("implicitCouple", "explicitCouple"),
    [](const testing::TestParamInfo<std::string>& model) { return model.param; });

} // namespace clepsydra::tests
