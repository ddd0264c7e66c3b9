/// \file
/// Drag beside walls.

#include "closures/wallCorrection.h"

#include "relative.h"

#include <cmath>

namespace
{

using namespace clepsydra::closures;

/// n(0) = 3.3, n(100) = 11.8/11 = 1.072727, n(inf) = .85. lambda .1: (.9/.967)^3.3 = .9307136^3.3 = .7890289 (Faxen's
/// series on a tube's axis: .7916340); .3: (.7/.901)^3.3 = .4347421. lambda .2, Re_t 100: (.8/.934)^1.072727 = .8469382.
/// The velocity ratio taken as a drag ratio, or n at one end only, fails.
TEST(DiFelicesWall, GivesTheVelocityRatiosWorkedOutByHand)
{
    EXPECT_DOUBLE_EQ(diFeliceWallExponent(0.0), 3.3);
    EXPECT_RELATIVE(diFeliceWallExponent(100.0), 1.0727272727, 1e-9);
    EXPECT_RELATIVE(diFeliceWallExponent(1e9), 0.85, 1e-6);
    EXPECT_RELATIVE(diFeliceWallVelocityRatio(0.1, 0.0), 0.7890289112, 1e-9);
    EXPECT_RELATIVE(diFeliceWallVelocityRatio(0.1, 0.0), 0.791633955, 0.005);
    EXPECT_RELATIVE(diFeliceWallVelocityRatio(0.3, 0.0), 0.4347421230, 1e-9);
    EXPECT_RELATIVE(diFeliceWallVelocityRatio(0.2, 100.0), 0.8469381592, 1e-9);
    EXPECT_DOUBLE_EQ(diFeliceWallVelocityRatio(0.0, 30.0), 1.0);
}

/// At the particle's own speed the free Re is Re/k: lambda .2, Re 100: k = .85096 at Re_t 117.51, the solution of both.
TEST(DiFelicesWall, IsConsistentAtTheParticlesOwnSpeed)
{
    for (const double lambda : {0.05, 0.2, 0.5, 0.8})
    {
        for (const double reynolds : {0.0, 0.1, 1.0, 10.0, 100.0, 1e4})
        {
            const double ratio = diFeliceWallVelocityRatioAtSpeed(lambda, reynolds);
            EXPECT_RELATIVE(ratio, diFeliceWallVelocityRatio(lambda, reynolds / ratio), 1e-9)
                << lambda << ' ' << reynolds;
        }
    }
    EXPECT_RELATIVE(diFeliceWallVelocityRatioAtSpeed(0.2, 100.0), 0.8509601490, 1e-6);
}

/// lambda .5: 1 - .28125 + .015625 - .0109863 - .0019531 = .7214355, 1/.7214355 = 1.3861252. Far away it is 1.
TEST(FaxensWall, GivesTheDragFactorAlongItWorkedOutByHand)
{
    EXPECT_RELATIVE(faxenParallelFactor(0.5), 1.3861252115, 1e-9);
    EXPECT_DOUBLE_EQ(faxenParallelFactor(0.0), 1.0);
    EXPECT_RELATIVE(faxenParallelFactor(1.0), 3.0843373, 1e-7);
}

/// H. Brenner (1961), the exact series of a sphere that moves towards a plane wall in creeping flow, cosh(alpha) = 1 + gap.
/// Both hyperbolic sines are scaled by exp(-(2n + 1) alpha), so that nothing overflows.
double brennerSeries(double gap)
{
    const double alpha = std::acosh(1.0 + gap);
    double sum = 0.0;
    for (int n = 1; n < 60.0 / alpha; ++n)
    {
        const double odd = 2.0 * n + 1.0;
        const double decay = std::exp(-odd * alpha);
        const double numerator = 1.0 - decay * decay + odd * std::sinh(2.0 * alpha) * decay;
        const double denominator = (1.0 - decay) * (1.0 - decay) - std::pow(odd * std::sinh(alpha), 2) * decay;
        sum += n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * (numerator / denominator - 1.0);
    }
    return 4.0 / 3.0 * std::sinh(alpha) * sum;
}

/// Brenner's printed values at alpha = .5, 1, 1.5, 2 and 3: 9.2518, 3.0361, 1.8375, 1.4129, 1.1252. A series with a
/// wrong term fails here, before the closed form is held against it.
TEST(BrennersWall, SeriesHasThePrintedValues)
{
    EXPECT_RELATIVE(brennerSeries(std::cosh(0.5) - 1.0), 9.2518, 3e-4);
    EXPECT_RELATIVE(brennerSeries(std::cosh(1.0) - 1.0), 3.0361, 1e-4);
    EXPECT_RELATIVE(brennerSeries(std::cosh(1.5) - 1.0), 1.8375, 1e-4);
    EXPECT_RELATIVE(brennerSeries(std::cosh(2.0) - 1.0), 1.4129, 1e-4);
    EXPECT_RELATIVE(brennerSeries(std::cosh(3.0) - 1.0), 1.1252, 1e-4);
}

/// From a ten thousandth of a radius to a thousand radii. Faxen's series for this motion, 1/(1 - 9/8 l + l^3/2), is off by
/// 19 % at a gap of half a radius and by 97 % at a hundredth; lubrication's 1/s alone by 50 % at one radius.
TEST(BrennersWall, ClosedFormKeepsToTheSeriesAtAnyGap)
{
    for (double gap = 1e-4; gap < 1e3; gap *= 1.3)
    {
        EXPECT_RELATIVE(brennerPerpendicularFactor(gap), brennerSeries(gap), 0.0072) << gap;
    }
    // worked out by hand: (6 + 9 + 2)/(6 + 2); 1/s of lubrication
    EXPECT_DOUBLE_EQ(brennerPerpendicularFactor(1.0), 17.0 / 8.0);
    EXPECT_RELATIVE(brennerPerpendicularFactor(1e-6) * 1e-6, 1.0, 1e-5);
}

} // namespace
