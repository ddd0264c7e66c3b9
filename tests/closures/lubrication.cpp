/// \file
/// Squeeze flow between near spheres.

#include "closures/lubrication.h"

#include "relative.h"

namespace
{

using namespace clepsydra::closures;

/// 6 pi * 1e-3 * 1e-6 = 1.884956e-8 for R 1 mm at a wall; h 10 um, reach 100 um: (1e5 - 1e4) = 9e4: 1.696460e-3 kg/s.
/// Between two such particles R_eff = R/2: a quarter, 4.241150e-4. With R1 + R2 for R_eff it is 16 times too much.
TEST(Lubrication, GrowsAsTheGapCloses)
{
    EXPECT_RELATIVE(squeezeCoefficient(1e-3, 1e-3, 1e-5, 1e-6, 1e-4), 1.696460033e-3, 1e-8);
    EXPECT_RELATIVE(squeezeCoefficient(1e-3, effectiveRadius(1e-3, 1e-3), 1e-5, 1e-6, 1e-4), 4.241150082e-4, 1e-8);
    EXPECT_RELATIVE(effectiveRadius(1e-3, 3e-3), 0.75e-3, 1e-12);
}

/// Bounded at the roughness: (1e6 - 1e4) * 1.884956e-8 = 1.866106e-2 kg/s, up to the touch. Without the cut-off it is
/// infinite there.
TEST(Lubrication, IsBoundedByTheRoughness)
{
    for (const double gap : {1e-6, 1e-9, 0.0})
    {
        EXPECT_RELATIVE(squeezeCoefficient(1e-3, 1e-3, gap, 1e-6, 1e-4), 1.866106037e-2, 1e-8);
    }
}

/// None in contact, where the gap does not close any further. With the value of the touch a steel sphere in oil, on
/// contacts softened to 1e9 Pa, does not bounce at all (cases/validation/bounce; measured: .84 of its speed).
TEST(Lubrication, IsNoneInContact)
{
    for (const double gap : {-1e-12, -1e-9, -1e-5})
    {
        EXPECT_EQ(squeezeCoefficient(1e-3, 1e-3, gap, 1e-6, 1e-4), 0.0);
    }
}

/// At a wall R 1 mm, h 10 um, reach 100 um: Brenner's factor 2.0906/.0206 = 101.485437 less 2.96/.26 = 11.384615, times
/// 6 pi * 1e-3 * 1e-3 = 1.884956e-5: 1.698360e-3 kg/s, .1 % above the leading term alone. From far away on, a gap of one
/// radius has 2.125 - 1 of Stokes' drag, where the leading term has 1 - .005 with a reach of 200 R.
TEST(Lubrication, OfAWallIsBrennersFromAfar)
{
    EXPECT_RELATIVE(wallSqueezeCoefficient(1e-3, 1e-3, 1e-5, 1e-6, 1e-4), 1.69836047e-3, 1e-8);
    EXPECT_RELATIVE(wallSqueezeCoefficient(1e-3, 1e-3, 1e-3, 1e-6, 1e4), 1.125 * 1.884955592e-5, 1e-6);
    EXPECT_EQ(
        wallSqueezeCoefficient(1e-3, 1e-3, 1e-8, 1e-6, 1e-4), wallSqueezeCoefficient(1e-3, 1e-3, 1e-6, 1e-6, 1e-4));
    EXPECT_EQ(wallSqueezeCoefficient(1e-3, 1e-3, -1e-9, 1e-6, 1e-4), 0.0);
    EXPECT_EQ(wallSqueezeCoefficient(1e-3, 1e-3, 1e-4, 1e-6, 1e-4), 0.0);
    EXPECT_LT(wallSqueezeCoefficient(1e-3, 1e-3, 0.9999e-4, 1e-6, 1e-4), 1e-7);
}

/// Asperities that touch beyond the reach leave no film: no force, and none that pulls.
TEST(Lubrication, HasNoFilmBetweenAsperitiesThatAreLarger)
{
    EXPECT_EQ(squeezeCoefficient(1e-3, 1e-3, 1e-5, 2e-4, 1e-4), 0.0);
    EXPECT_EQ(wallSqueezeCoefficient(1e-3, 1e-3, 1e-5, 2e-4, 1e-4), 0.0);
}

/// It ends at the reach without a jump.
TEST(Lubrication, EndsAtItsReach)
{
    EXPECT_EQ(squeezeCoefficient(1e-3, 1e-3, 1e-4, 1e-6, 1e-4), 0.0);
    EXPECT_LT(squeezeCoefficient(1e-3, 1e-3, 0.9999e-4, 1e-6, 1e-4), 1e-7);
    EXPECT_GT(squeezeCoefficient(1e-3, 1e-3, 0.9999e-4, 1e-6, 1e-4), 0.0);
}

} // namespace
