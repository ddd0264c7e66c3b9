/// \file
/// Time scales against arithmetic by hand and against numerical integration. Discrete random walk through eddies: numbers that
/// are random, and the same whenever they are asked for; times in eddies.

#include "closures/timeScales.h"

#include "closures/discreteRandomWalk.h"

#include "relative.h"

#include "closures/particleInFluid.h"
#include "closures/stokesDrag.h"

#include <vector>

namespace
{

using namespace clepsydra::closures;

/// 2 mm glass (2540) softened to E = 5e6 Pa, nu .2: G = 5e6/2.4 = 2.083333e6; sqrt(2540/G) = 3.491704e-2;
/// pi*.001*3.491704e-2/(.03262 + .8766) = 1.206475e-4 s, so that the usual step of 4e-5 s is .33 of it. The diameter
/// in place of the radius doubles it.
TEST(TimeScales, RayleighTime)
{
    const double g = shearModulus(5e6, 0.2);
    EXPECT_RELATIVE(g, 2.083333333e6, 1e-9);
    EXPECT_RELATIVE(rayleighTime(0.001, 2540.0, g, 0.2), 1.206475e-4, 1e-6);
}

/// The collision of two such particles at .1 m/s, by integrating the energy balance m* w^2/2 + 8/15 E* sqrt(R*) x^(5/2) =
/// m* v^2/2 over the way in and out. The substitution x = x_max (1 - s^2) removes the singularity at the turning
/// point. A wrong coefficient or power fails.
TEST(TimeScales, HertzCollisionTimeIsTheIntegralOfTheMotion)
{
    const double radius = 0.001;
    const double mass = 4.0 / 3.0 * pi * radius * radius * radius * 2540.0;
    const double effectiveMass = 0.5 * mass;
    const double modulus = 0.5 * 5e6 / (1.0 - 0.04);
    const double speed = 0.1;
    const double maximum =
        std::pow(15.0 / 16.0 * effectiveMass * speed * speed / (modulus * std::sqrt(0.5 * radius)), 0.4);
    const int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
    {
        const double s = (i + 0.5) / steps;
        const double x = 1.0 - s * s;
        sum += 2.0 * s / std::sqrt(1.0 - x * x * std::sqrt(x)) / steps;
    }
    const double integral = 2.0 * maximum / speed * sum;
    EXPECT_RELATIVE(hertzCollisionTimeOfEqualParticles(radius, 2540.0, 5e6, 0.2, speed), integral, 1e-6);
    EXPECT_RELATIVE(hertzCollisionTime(effectiveMass, 0.5 * radius, modulus, speed), integral, 1e-6);
    EXPECT_RELATIVE(integral, 4.384447e-4, 1e-6); // and by hand, 2.94328 x_max/v
}

/// A particle in creeping flow relaxes in rho_p d^2/(18 mu): 2500*1e-8/(.018) = 1.388889e-3 s for .1 mm glass in water;
/// with its added mass, (2500 + 500)/2500 of that. Sp/m in place of m/Sp fails.
TEST(TimeScales, RelaxationTimeInCreepingFlow)
{
    const ParticleInFluid particle = makeParticleInFluid(1e-4, 1.0, 0.0, 1000.0, 1e-3);
    const double volume = pi / 6.0 * 1e-12;
    EXPECT_RELATIVE(relaxationTime(2500.0 * volume, StokesDrag{}(particle)), 1.388888889e-3, 1e-9);
    EXPECT_RELATIVE(relaxationTime(3000.0 * volume, StokesDrag{}(particle)), 1.666666667e-3, 1e-9);
}

/// 3e5 numbers of neighbouring particles and eddies: mean 0, variance 1, fourth moment 3, and no correlation between the
/// axes, between one particle and the next, and between one eddy and the next, all to four standard errors. A generator
/// that mixes badly correlates neighbours; one without the logarithm has another fourth moment (1.8 for a uniform number).
TEST(DiscreteRandomWalk, NumbersAreNormalAndIndependent)
{
    constexpr int particles = 1000;
    constexpr int eddies = 100;
    double mean = 0;
    double variance = 0;
    double fourth = 0;
    double betweenAxes = 0;
    double betweenParticles = 0;
    double betweenEddies = 0;
    for (int particle = 1; particle <= particles; ++particle)
    {
        for (int eddy = 1; eddy <= eddies; ++eddy)
        {
            const auto here = normalNumbers(7, particle, eddy);
            const auto ofNext = normalNumbers(7, particle + 1, eddy);
            const auto later = normalNumbers(7, particle, eddy + 1);
            for (int axis = 0; axis < 3; ++axis)
            {
                const double number = here[axis];
                mean += number;
                variance += number * number;
                fourth += number * number * number * number;
                betweenAxes += number * here[(axis + 1) % 3];
                betweenParticles += number * ofNext[axis];
                betweenEddies += number * later[axis];
            }
        }
    }
    constexpr double count = 3.0 * particles * eddies;
    const double allowed = 4 / std::sqrt(count);
    EXPECT_NEAR(mean / count, 0, allowed);
    EXPECT_NEAR(variance / count, 1, allowed * std::sqrt(2.0));
    EXPECT_NEAR(fourth / count, 3, allowed * std::sqrt(96.0));
    EXPECT_NEAR(betweenAxes / count, 0, allowed);
    EXPECT_NEAR(betweenParticles / count, 0, allowed);
    EXPECT_NEAR(betweenEddies / count, 0, allowed);
}

TEST(DiscreteRandomWalk, NumbersAreAFunctionOfTheirArguments)
{
    EXPECT_EQ(normalNumbers(7, 12, 3), normalNumbers(7, 12, 3));
    EXPECT_NE(normalNumbers(7, 12, 3), normalNumbers(8, 12, 3));
    EXPECT_NE(normalNumbers(7, 12, 3), normalNumbers(7, 3, 12));
}

/// k 0.01 m2/s2 and epsilon 0.1 m2/s3: l = 0.09^0.75 1e-3/0.1 = 1.6432 mm, t_e = l/0.1 m/s = 16.43 ms. A particle with tau
/// 0.1 s and a slip of 0.02 m/s has a stopping distance of 2 mm and crosses in -0.1 ln(1 - 0.82158) = 172.4 ms: the eddy
/// decays first. At a slip of 0.2 m/s: -0.1 ln(1 - 0.082158) = 8.573 ms, before that. At 0.01 m/s it never crosses.
TEST(DiscreteRandomWalk, TimesInAnEddy)
{
    const double size = eddySize(0.01, 0.1);
    EXPECT_RELATIVE(size, 1.6431676725e-3, 1e-9);
    EXPECT_RELATIVE(timeInEddy(size, 0.1, 0.1, 0.02), 1.6431676725e-2, 1e-9);
    EXPECT_RELATIVE(timeInEddy(size, 1e-3, 0.1, 0.02), -0.1 * std::log(1 - size / 2e-3), 1e-12);
    EXPECT_RELATIVE(timeInEddy(size, 0.1, 0.1, 0.2), 8.573043e-3, 1e-6);
    EXPECT_RELATIVE(timeInEddy(size, 0.1, 0.1, 0.01), 1.6431676725e-2, 1e-9);
    EXPECT_RELATIVE(timeInEddy(size, 0.1, 0, 0), 1.6431676725e-2, 1e-9);
}

/// The diffusion coefficient that the header states, by 4e4 walks through 50 eddies each.
TEST(DiscreteRandomWalk, DiffusesAsStated)
{
    const double size = eddySize(0.01, 0.1);
    const double deviation = std::sqrt(2.0 / 3 * 0.01);
    double squared = 0;
    double time = 0;
    for (int particle = 1; particle <= 40000; ++particle)
    {
        double place[3] = {0, 0, 0};
        for (int eddy = 1; eddy <= 50; ++eddy)
        {
            const auto numbers = normalNumbers(3, particle, eddy);
            const double fluctuation =
                deviation * std::sqrt(numbers[0] * numbers[0] + numbers[1] * numbers[1] + numbers[2] * numbers[2]);
            const double duration = timeInEddy(size, fluctuation, 0, 0);
            time += duration;
            for (int axis = 0; axis < 3; ++axis)
            {
                place[axis] += deviation * numbers[axis] * duration;
            }
        }
        squared += place[0] * place[0] + place[1] * place[1] + place[2] * place[2];
    }
    EXPECT_RELATIVE(squared / 3 / (2 * time), size * deviation / (6 * std::sqrt(2 / pi)), 0.02);
}

} // namespace
