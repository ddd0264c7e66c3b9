/// \file
/// Time scales against arithmetic by hand and against numerical integration.

#include "closures/timeScales.h"

#include "relative.h"

#include "closures/particleInFluid.h"
#include "closures/stokesDrag.h"

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

} // namespace
