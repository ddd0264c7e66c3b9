/// \file
/// Drag beside walls.

#include "closures/wallCorrection.h"

#include "relative.h"

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

/// At the bead's own speed the free Re is Re/k: lambda .2, Re 100: k = .85096 at Re_t 117.51, the solution of both.
TEST(DiFelicesWall, IsConsistentAtTheBeadsOwnSpeed)
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

/// lambda .5: 1 - .28125 + .015625 - .0109863 - .0019531 = .7214355, 1/.7214355 = 1.3861252; perpendicular
/// 1 - .5625 + .0625 = .5: 2. Brenner's exact 1.8375 at lambda = .4250960: within 3 %. Far away both are 1.
TEST(FaxensWall, GivesTheDragFactorsWorkedOutByHand)
{
    EXPECT_RELATIVE(faxenParallelFactor(0.5), 1.3861252115, 1e-9);
    EXPECT_RELATIVE(faxenPerpendicularFactor(0.5), 2.0, 1e-12);
    EXPECT_RELATIVE(faxenPerpendicularFactor(0.4250960343), 1.8374747918, 0.03);
    EXPECT_DOUBLE_EQ(faxenParallelFactor(0.0), 1.0);
    EXPECT_DOUBLE_EQ(faxenPerpendicularFactor(0.0), 1.0);
    EXPECT_RELATIVE(faxenParallelFactor(1.0), 3.0843373, 1e-7);
    EXPECT_RELATIVE(faxenPerpendicularFactor(1.0), 2.6666667, 1e-7);
}

} // namespace
