// The heat that particles and fluid exchange, in the simplest equation of the fluid's temperature, without flow: what it does
// in time, against the linear analysis and exact solutions, and that an imbalance stops a run. An exchange that takes the
// fluid's temperature of the step before oscillates or diverges where it is strong.

#include "couplingStep/heatExchange.h"

#include "conservation/faults.h"
#include "couplingState.h"
#include "support/boxMesh.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"
#include "vectors.h"

#include "fvm.H"
#include "mathematicalConstants.H"

#include <cmath>
#include <functional>

namespace clepsydra::tests
{

namespace
{

using namespace Foam;

constexpr double fluidDensity = 1000;
constexpr double fluidCp = 4000;
constexpr double particleCp = 800;
constexpr double radius = 0.02;
constexpr double interval = 0.01;

struct BoxSetup
{
    std::string smoothing = "off";
    std::array<int, 3> cells = {2, 2, 2};
    double conductivity = 0.6;
    /// Of the particles over that of the fluid.
    double capacityRatio = 1;
    double coarseGraining = 1;
};

/// A box of fluid at rest, 1 m wide, with a particle in the middle of each eighth of it. The Nusselt number is 2.
class HeatedBox
{
public:
    explicit HeatedBox(const BoxSetup& setup)
        : engine_(interval, Vector3d::Zero())
    {
        case_.writeDictionary("constant/couplingProperties", "voidFractionModel divided; smoothingModel "
                                                                 + setup.smoothing
                                                                 + "; energy { heatTransferModel RanzMarshall; }");
        properties_ = std::make_unique<IOdictionary>(IOobject(
            "couplingProperties", case_.time().constant(), case_.time(), IOobject::MUST_READ, IOobject::NO_WRITE));
        mesh_ = boxMesh(case_.time(), point::zero, point::one, setup.cells);
        readFromCase<fvSchemes>(*mesh_);
        readFromCase<fvSolution>(*mesh_);
        for (int particle = 0; particle < count; ++particle)
        {
            engine_.addParticle(particle + 1,
                {0.25 + 0.5 * (particle % 2), 0.25 + 0.5 * (particle / 2 % 2), 0.25 + 0.5 * (particle / 4)}, radius);
        }
        fluidCapacity_ = fluidDensity * fluidCp * (1 - count * sphereVolume(radius));
        temperatures_.setConstant(400);
        capacities_.setConstant(setup.capacityRatio * fluidCapacity_ / count);
        distribution_ = std::make_unique<Distribution>(*properties_, *mesh_);
        mapping_ = std::make_unique<ParticleMapping>(*mesh_, *properties_, *distribution_, timers_);
        const Energy energy{properties_->subDict("energy"), {fluidCp, setup.conductivity}, {}, setup.coarseGraining};
        exchange_ =
            std::make_unique<HeatExchange>(*mesh_, energy, FluidProperties{fluidDensity, 1e-3, Vector3d::Zero()});
        T_ = std::make_unique<volScalarField>(IOobject("T", case_.time().timeName(), *mesh_), *mesh_,
            dimensionedScalar("T", dimTemperature, 300), "zeroGradient");
    }

    /// One coupling step.
    /// \param solved  what becomes of the particles' source before it is put into the equation
    HeatOfStep advance(
        double timeStep = interval, const std::function<void(fvScalarMatrix&)>& solved = [](fvScalarMatrix&) {})
    {
        case_.time().setDeltaT(timeStep, false);
        ++case_.time();
        T_->storeOldTime();
        const ParticlesView particles = engine_.particles();
        const LocatedParticles located = mapping_->locate(particles, Eigen::MatrixXd(0, particles.size()));
        TemperaturesView view{View<double>(temperatures_.data(), count), ConstView<double>(capacities_.data(), count)};
        const double before = fluidHeat();
        exchange_->update(located, particles, view, timeStep);
        fvScalarMatrix source(exchange_->source(*T_));
        solved(source);
        const dimensionedScalar voidFraction("voidFraction", dimless, 1 - count * sphereVolume(radius));
        solve(voidFraction * fvm::ddt(*T_) == source);
        HeatOfStep heat = exchange_->exchange(located, view, *T_);
        heat.inFluidBefore = before;
        heat.inFluid = fluidHeat();
        return heat;
    }

    /// Of the fluid, of cells of equal size.
    double temperature() const
    {
        return average(T_->primitiveField());
    }

    double fluidHeat() const
    {
        return fluidCapacity_ * temperature();
    }

    double coldestCell() const
    {
        return min(T_->primitiveField());
    }

    double hottestCell() const
    {
        return max(T_->primitiveField());
    }

    /// h A dt over the heat capacity of a particle.
    double timeConstants(double timeStep, const BoxSetup& setup) const
    {
        return 2 * constant::mathematical::pi * setup.conductivity * 2 * radius * timeStep / capacities_[0];
    }

    Eigen::Array<double, 8, 1>& temperatures()
    {
        return temperatures_;
    }

    double particleHeat() const
    {
        return (capacities_ * temperatures_).sum();
    }

    volScalarField& T()
    {
        return *T_;
    }

    const Time& time() const
    {
        return case_.time();
    }

    static constexpr int count = 8;

private:
    TemporaryCase case_;
    std::unique_ptr<IOdictionary> properties_;
    std::unique_ptr<fvMesh> mesh_;
    PhaseTimers timers_;
    FakeEngine engine_;
    std::unique_ptr<Distribution> distribution_;
    std::unique_ptr<ParticleMapping> mapping_;
    std::unique_ptr<HeatExchange> exchange_;
    std::unique_ptr<volScalarField> T_;
    double fluidCapacity_ = 0;
    Eigen::Array<double, 8, 1> temperatures_;
    Eigen::Array<double, 8, 1> capacities_;
};

void record(ConservationCheck& conservation, const HeatOfStep& heat)
{
    RankTotals totals;
    conservation.addHeat(heat, totals);
    totals.reduce();
}

/// The particle's time constants in a coupling step; heat capacity of the particles over that of the fluid.
class Exchanges : public testing::TestWithParam<std::pair<double, double>>
{
protected:
    /// \param timeConstants  of a particle in a coupling step
    static BoxSetup setup(double timeConstants, double capacityRatio, const std::string& smoothing)
    {
        BoxSetup setup;
        setup.smoothing = smoothing;
        setup.capacityRatio = capacityRatio;
        const double capacity =
            capacityRatio * fluidDensity * fluidCp * (1 - HeatedBox::count * sphereVolume(radius)) / HeatedBox::count;
        setup.conductivity = timeConstants * capacity / (2 * constant::mathematical::pi * 2 * radius * interval);
        return setup;
    }
};

} // namespace

/// With one particle to a cell and without smoothing, T - T_p is multiplied by (1 - q)/(1 + mu q) in each step, q = 1 -
/// exp(-x), whatever x and mu: also where a particle takes up all it can in a hundredth of a step.
TEST_P(Exchanges, DifferenceDecreasesAsTheLinearAnalysisStates)
{
    const auto [x, mu] = GetParam();
    HeatedBox box(setup(x, mu, "off"));
    EXPECT_NEAR(box.timeConstants(interval, setup(x, mu, "off")), x, 1e-9 * x);
    const double q = -std::expm1(-x);
    double difference = -100;
    for (int step = 0; step < 3; ++step)
    {
        difference *= (1 - q) / (1 + mu * q);
        box.advance();
        EXPECT_NEAR(box.temperature() - box.temperatures()[0], difference, 1e-9 * 100);
    }
}

/// Over many steps, with smoothing over several cells and particles of different temperatures, the heat of fluid, particles
/// and what is pending remains to rounding, and no temperature leaves the range of those at the start. Without the deferred
/// correction the fluid would lose what smoothing carries from warm cells to cold ones, and the balance would not close.
TEST_P(Exchanges, HeatRemainsAndNothingOvershoots)
{
    const auto [x, mu] = GetParam();
    BoxSetup boxSetup = setup(x, mu, "constDiffSmoothing; constDiffSmoothingProps { bandwidth 0.5; }");
    boxSetup.cells = {6, 6, 6};
    HeatedBox box(boxSetup);
    box.temperatures() << 400, 410, 420, 430, 440, 450, 460, 500;
    const double inParticles = box.particleHeat();
    const double atStart = box.fluidHeat() + inParticles;
    ConservationCheck conservation(dictionary::null, box.time());
    HeatOfStep heat;
    for (int step = 0; step < 200; ++step)
    {
        heat = box.advance();
        EXPECT_NO_THROW(record(conservation, heat));
        ASSERT_GT(box.coldestCell(), 300 - 1e-6);
        ASSERT_LT(box.hottestCell(), 500);
        ASSERT_GT(box.temperatures().minCoeff(), 300);
        ASSERT_LT(box.temperatures().maxCoeff(), 500);
    }
    EXPECT_NEAR(box.fluidHeat() + box.particleHeat() + heat.pending, atStart, 1e-10 * atStart);
    // What is left of the heat above 300 K in the particles when two of their time constants at least have passed; mu/(1 + mu)
    // in the end.
    const double above = (438.75 - 300) / 438.75 * inParticles;
    EXPECT_LT(box.particleHeat() - (inParticles - above), (mu / (1 + mu) + 0.3) * above);
}

INSTANTIATE_TEST_SUITE_P(Ratios, Exchanges,
    testing::Values(std::pair(0.01, 0.001), std::pair(0.1, 1.0), std::pair(1.0, 0.5), std::pair(100.0, 1.0),
        std::pair(1.0, 1000.0)));

/// Fluid and particles of one temperature keep it to rounding, with coupling steps that change. Where C T is not taken back by
/// the deferred correction, smoothing would move heat.
TEST(HeatExchangeInTime, UniformTemperatureRemains)
{
    BoxSetup setup;
    setup.cells = {6, 6, 6};
    setup.smoothing = "constDiffSmoothing; constDiffSmoothingProps { bandwidth 0.5; }";
    setup.conductivity = 1e4;
    HeatedBox box(setup);
    box.temperatures().setConstant(300);
    for (int step = 0; step < 20; ++step)
    {
        box.advance(step % 2 == 0 ? interval : 0.3 * interval);
    }
    EXPECT_LT(box.hottestCell() - 300, 1e-8);
    EXPECT_GT(box.coldestCell() - 300, -1e-8);
    EXPECT_LT((box.temperatures() - 300).abs().maxCoeff(), 1e-8);
}

/// A parcel of 8 particles of half its diameter takes the heat of 8 of them. At rest, with Nu = 2, that is four times what a
/// particle of its size takes: that of a fluid of four times the conductivity.
TEST(HeatExchangeInTime, ParcelTakesTheHeatOfItsParticles)
{
    BoxSetup ofParcels;
    ofParcels.conductivity = 1e4;
    ofParcels.coarseGraining = 2;
    BoxSetup ofParticles;
    ofParticles.conductivity = 4e4;
    HeatedBox parcels(ofParcels);
    HeatedBox particles(ofParticles);
    const HeatOfStep heat = parcels.advance();
    EXPECT_LT(heat.received, 0);
    EXPECT_NEAR(heat.received, particles.advance().received, 1e-12 * -heat.received);
}

/// A source that loses a thousandth of itself on its way into the equation.
TEST(HeatBalance, FindsASourceThatIsChanged)
{
    BoxSetup setup;
    setup.conductivity = 1e5;
    HeatedBox box(setup);
    ConservationCheck conservation(dictionary::null, box.time());
    EXPECT_NO_THROW(record(conservation, box.advance()));
    expectFound(
        [&] {
            record(conservation, box.advance(interval, [](fvScalarMatrix& source) {
                source *= dimensionedScalar("kept", dimless, 0.999);
            }));
        },
        "heatTolerance");
}

/// Particles that receive less than the fluid lost, as where a particle changes ranks and its heat does not.
TEST(HeatBalance, FindsHeatThatIsLostOnItsWay)
{
    BoxSetup setup;
    setup.conductivity = 1e5;
    HeatedBox box(setup);
    ConservationCheck conservation(dictionary::null, box.time());
    HeatOfStep heat = box.advance();
    EXPECT_NO_THROW(record(conservation, heat));
    heat = box.advance();
    heat.received *= 1 - 1e-5;
    expectFound([&] { record(conservation, heat); }, "heatTolerance");
}

} // namespace clepsydra::tests
