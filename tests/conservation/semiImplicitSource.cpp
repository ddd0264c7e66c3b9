// How the drag that is given semi-implicitly behaves in time, against the linear analysis in
// couplingStep/semiImplicitSource.h and against exact solutions. A scheme that applies the drag of a coupling step
// afterwards oscillates or diverges if the drag is strong.

#include "conservation/stream.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clepsydra::tests
{

namespace
{

constexpr double particles = 8;
const double fluidMass = Stream::waterMass(8);

const auto asItIs = [](fvVectorMatrix&) {};

/// One particle in the middle of each of eight cells, Stokes' drag.
/// \param dragTime  K dt over the fluid's mass
StreamSetup oneParticlePerCell(double dragTime)
{
    StreamSetup setup;
    setup.drag = "StokesDrag";
    setup.smoothing = "off";
    setup.cells = setup.particles;
    setup.viscosity = dragTime * fluidMass / (particles * 6 * M_PI * Stream::radius * setup.interval);
    return setup;
}

double dragCoefficient(const StreamSetup& setup)
{
    return 6 * M_PI * setup.viscosity * Stream::radius;
}

double particleMass(const StreamSetup& setup)
{
    return setup.particleDensity * sphereVolume(Stream::radius);
}

class DragTimes : public testing::TestWithParam<double>
{};

/// K dt over the particle's mass; the particles' mass over the fluid's.
class FreeParticles : public testing::TestWithParam<std::pair<double, double>>
{
protected:
    static StreamSetup setup()
    {
        const auto [relaxationTimes, massRatio] = GetParam();
        StreamSetup setup = oneParticlePerCell(relaxationTimes * massRatio);
        setup.particleDensity = massRatio * fluidMass / (particles * sphereVolume(Stream::radius));
        setup.demStepsPerCouplingStep = 2000;
        return setup;
    }
};

double slip(Stream& stream)
{
    return stream.waterSpeed() - stream.engine().particles().velocity(2, 0);
}

} // namespace

// Drag on fixed particles reduces the water's speed to 1/(1 + k) of its value in every coupling step; its sign never
// changes.
TEST_P(DragTimes, WaterStopsMonotonouslyBetweenFixedParticles)
{
    StreamSetup setup = oneParticlePerCell(GetParam());
    setup.fixed = true;
    Stream stream(setup);
    for (int interval = 0; interval < 5; ++interval)
    {
        const double before = stream.waterSpeed();
        stream.advance(asItIs);
        EXPECT_NEAR(stream.waterSpeed() / before, 1 / (1 + GetParam()), 1e-6) << "coupling step " << interval;
    }
}

// The same holds when each coupling step has another length: the semi-implicit source is the drag of the next coupling
// step. If it were that of the current one, the water's speed would change its sign wherever the coupling step grows
// under strong drag.
TEST_P(DragTimes, WaterStopsMonotonouslyWhileTheIntervalChanges)
{
    StreamSetup setup = oneParticlePerCell(GetParam());
    setup.fixed = true;
    setup.adjustable = true;
    Stream stream(setup);
    stream.advance(asItIs, 1);
    for (const int next : {2, 3, 1, 2, 3, 4})
    {
        const double before = stream.waterSpeed();
        stream.advance(asItIs, next);
        const double nextOverFirst = static_cast<double>(next) / setup.demStepsPerCouplingStep;
        EXPECT_NEAR(stream.waterSpeed() / before, 1 / (1 + GetParam() * nextOverFirst), 1e-6) << "next " << next;
    }
    EXPECT_NEAR(stream.lastTimeStep(), 3 * setup.interval / setup.demStepsPerCouplingStep, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(WeakToStrong, DragTimes, testing::Values(0.01, 0.3, 1, 10, 100, 1000));

// The same for a wave in the water while the source is smoothed, which leaves r of the wave's amplitude. Without the
// deferred correction one coupling step later, the wave would fall by 1/(1 + k), as if r were 1.
TEST_P(DragTimes, WaveFallsMonotonouslyBetweenFixedParticles)
{
    constexpr int cells = 16;
    constexpr double smoothingBandwidth = 0.2;
    StreamSetup setup = oneParticlePerCell(GetParam());
    setup.smoothing =
        "constDiffSmoothing; constDiffSmoothingProps { bandwidth " + std::to_string(smoothingBandwidth) + "; }";
    setup.cells = setup.particles = {cells, 1, 1};
    setup.viscosity *= particles / cells * Stream::waterMass(cells) / fluidMass;
    setup.wave = true;
    setup.fixed = true;
    // The wave is an eigenvector of the cells' Laplacian.
    const double eigenvalue = 2 * (1 - std::cos(M_PI / cells)) * cells * cells;
    const double r = std::exp(-smoothingBandwidth * smoothingBandwidth / 4 * eigenvalue);
    Stream stream(setup);
    for (int interval = 0; interval < 5; ++interval)
    {
        const double before = stream.amplitude();
        stream.advance(asItIs);
        EXPECT_NEAR(stream.amplitude() / before, (1 + (1 - r) * GetParam()) / (1 + GetParam()), 1e-4)
            << "coupling step " << interval;
    }
}

// The slip of particles under drag alone falls to (1 - q)/(1 + mu q) in every coupling step, and momentum is conserved.
TEST_P(FreeParticles, RelaxWithTheWaterWithoutRinging)
{
    const auto [relaxationTimes, massRatio] = GetParam();
    Stream stream(setup());
    const double momentum = 0.1 * fluidMass;
    // The share that contacts took up is known from the second coupling step on.
    stream.advance(asItIs);
    const double taken = -std::expm1(-relaxationTimes);
    for (int interval = 0; interval < 4; ++interval)
    {
        const double before = slip(stream);
        if (before < 1e-9)
        {
            break; // There is rounding left only.
        }
        stream.advance(asItIs);
        EXPECT_NEAR(slip(stream) / before, (1 - taken) / (1 + massRatio * taken), 0.01) << "coupling step " << interval;
        EXPECT_NEAR(stream.momentum() / momentum, 1, 1e-9);
    }
}

// The same holds while coupling steps of 2000 DEM steps shrink at once and grow again by a fifth. If the semi-implicit
// source were divided by the length of another coupling step, or taken back over another one, momentum would not be
// conserved.
TEST_P(FreeParticles, KeepTheMomentumWhileTheIntervalChanges)
{
    StreamSetup setup = FreeParticles::setup();
    setup.adjustable = true;
    Stream stream(setup);
    stream.advance(asItIs, 100);
    for (const int next : {120, 144, 10, 12, 12, 1, 2, 1, 1})
    {
        const double before = slip(stream);
        stream.advance(asItIs, next);
        EXPECT_NEAR(stream.momentum() / (0.1 * fluidMass), 1, 1e-12);
        EXPECT_GE(slip(stream), -1e-15);
        EXPECT_LE(slip(stream), before + 1e-15);
    }
}

INSTANTIATE_TEST_SUITE_P(LightToHeavy, FreeParticles,
    testing::Values(
        std::pair(0.01, 1.0), std::pair(0.3, 0.1), std::pair(1.0, 10.0), std::pair(3.0, 1.0), std::pair(10.0, 100.0)));

// Against exp(-(1 + mu) t/tau): halving the coupling step halves the error. The momentum of the semi-implicit source of
// the first coupling step comes from the water, also if a pressure acts from the start. A first coupling step that
// includes a pressure response before any pressure equation was solved differs by 1e-4.
TEST(SemiImplicitSource, BeginsWithWhatTheWaterHas)
{
    StreamSetup setup;
    setup.pressureGradient = -5;
    Stream stream(setup);
    const double before = 0.1 * Stream::waterMass(8);
    EXPECT_LT(stream.waterSpeed(), 0.1 - 1e-6);
    EXPECT_NEAR(stream.momentum(), before, 1e-12 * before);
}

TEST(SemiImplicitSource, IsOfFirstOrderInTheInterval)
{
    const auto error = [](double interval) {
        constexpr double end = 0.08;
        StreamSetup setup = oneParticlePerCell(0.1);
        setup.particleDensity = fluidMass / (particles * sphereVolume(Stream::radius));
        setup.interval = interval;
        setup.demStepsPerCouplingStep = static_cast<int>(std::lround(interval / 1e-5));
        Stream stream(setup);
        for (int i = 0; i < std::lround(end / interval); ++i)
        {
            stream.advance(asItIs);
        }
        const double massRatio = particles * particleMass(setup) / fluidMass;
        return slip(stream) - 0.1 * std::exp(-(1 + massRatio) * dragCoefficient(setup) / particleMass(setup) * end);
    };
    EXPECT_NEAR(error(0.01) / error(0.005), 2, 0.2);
    EXPECT_NEAR(error(0.005) / error(0.0025), 2, 0.1);
}

} // namespace clepsydra::tests
