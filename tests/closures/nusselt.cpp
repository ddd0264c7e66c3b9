/// \file
/// Heat transfer, against values worked out by hand from the printed formulas.

#include "closures/heatExchange.h"
#include "closures/nusselt.h"

#include "relative.h"

namespace
{

using namespace clepsydra::closures;

/// Conduction into fluid at rest: Nu = 2 exactly, the only value here that is exact.
TEST(Nusselt, OfAnIsolatedParticleAtRestIsTwo)
{
    EXPECT_DOUBLE_EQ(ranzMarshallNusselt(0.0, 0.7), 2.0);
    EXPECT_NEAR(gunnNusselt(0.0, 0.7, 1.0), 2.0, 1e-14);
}

/// Air: .7^(1/3) = .887904; 2 + .6*10*.887904 = 7.327424. Water: 7^(1/3) = 1.912931; 2 + .6*5*1.912931 = 7.738794. The
/// two exponents exchanged give 3.5 and 6.5.
TEST(Nusselt, OfRanzAndMarshall)
{
    EXPECT_RELATIVE(ranzMarshallNusselt(100.0, 0.7), 7.327424, 1e-6);
    EXPECT_RELATIVE(ranzMarshallNusselt(25.0, 7.0), 7.738794, 1e-6);
}

/// Air, eps .5, Re 100: 7 - 5 + 1.25 = 3.25; 1 + .7*2.511886*.887904 = 2.561219; 1.33 - 1.2 + .3 = .43; 100^.7 =
/// 25.118864; 3.25*2.561219 + .43*25.118864*.887904 = 8.323962 + 9.590352 = 17.914314.
/// Isolated: 2*2.561219 + .13*25.118864*.887904 = 8.021848, 9 % above Ranz & Marshall.
/// Water, eps .4, Re 1000: 3.8*(1 + .7*3.981072*1.912931) + .562*125.892541*1.912931 = 24.057314 + 135.342916.
TEST(Nusselt, OfGunn)
{
    EXPECT_RELATIVE(gunnNusselt(100.0, 0.7, 0.5), 17.914314, 1e-6);
    EXPECT_RELATIVE(gunnNusselt(100.0, 0.7, 1.0), 8.021848, 1e-6);
    EXPECT_RELATIVE(gunnNusselt(1000.0, 7.0, 0.4), 159.40023, 1e-6);
}

/// Nu k/d times pi d^2: a sphere of 2 mm in water (0.6 W/(m K)) with Nu = 10 has 0.0376991 W/K.
TEST(HeatExchange, ConductanceIsThatOfTheSurface)
{
    EXPECT_RELATIVE(heatConductance(10, 0.6, 2e-3), 10 * 0.6 / 2e-3 * 3.14159265358979 * 4e-6, 1e-14);
}

/// A short time takes h A t, a long one all that the particle can take and not more: an explicit step of a hundred time
/// constants would take a hundred times that. Two halves of a time take what the whole takes.
TEST(HeatExchange, IsExactForAnyTime)
{
    constexpr double capacity = 5;
    constexpr double conductance = 2;
    EXPECT_RELATIVE(heatTaken(capacity, conductance, 1e-9), 2e-9, 1e-9);
    EXPECT_DOUBLE_EQ(heatTaken(capacity, conductance, 250), capacity);
    EXPECT_EQ(heatTaken(capacity, 0, 1), 0);
    EXPECT_RELATIVE(heatTaken(capacity, conductance, 2.5), capacity * (1 - std::exp(-1)), 1e-14);
    const double half = heatTaken(capacity, conductance, 1.25) / capacity;
    EXPECT_RELATIVE(heatTaken(capacity, conductance, 2.5) / capacity, half + (1 - half) * half, 1e-14);
}

} // namespace
