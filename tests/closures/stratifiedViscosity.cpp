/// \file
/// Viscosity of a liquid that changes with height.

#include "closures/stratifiedViscosity.h"

#include "relative.h"

namespace
{

using namespace clepsydra::closures;

/// Step ln 2: half the viscosity far above, all of it far below, 1/sqrt 2 of it at the edge; one standard deviation
/// below and above, erfc(+-1/sqrt 2) = .3173105 and 1.6826895: 2^-.15865526 = .8958605 and 2^-.84134474 = .5581226. A
/// step over the whole of erfc, or a width without the root of two, fails.
TEST(StratifiedViscosity, StepsBetweenTwoLiquids)
{
    const Stratification liquid{std::log(2.0), 0.243, 0.008};
    EXPECT_TRUE(liquid.isThere());
    EXPECT_RELATIVE(liquid.factor(0.0, 0.0), 1.0, 1e-12);
    EXPECT_RELATIVE(liquid.factor(0.5, 0.0), 0.5, 1e-12);
    EXPECT_RELATIVE(liquid.factor(0.243, 0.0), 0.7071067812, 1e-9);
    EXPECT_RELATIVE(liquid.factor(0.235, 0.0), 0.8958605, 1e-6);
    EXPECT_RELATIVE(liquid.factor(0.251, 0.0), 0.5581226, 1e-6);
}

/// Particles of 2 and 4 mm with a lag of 1.5 d meet the middle of the edge 3 and 6 mm below where it is: a larger particle
/// changes its speed later on its way down. The wrong sign lets it change before it is there.
TEST(StratifiedViscosity, IsFeltFromAboveTheParticle)
{
    const Stratification liquid{std::log(2.0), 0.243, 0.008, 1.5};
    EXPECT_RELATIVE(liquid.factor(0.243, 0.0), 0.7071067812, 1e-9);
    EXPECT_RELATIVE(liquid.factor(0.240, 2e-3), 0.7071067812, 1e-9);
    EXPECT_RELATIVE(liquid.factor(0.237, 4e-3), 0.7071067812, 1e-9);
    EXPECT_LT(liquid.factor(0.240, 4e-3), liquid.factor(0.240, 2e-3));
}

/// exp(3.3*.1) = 1.3909681 a tenth of a metre above the stated height, its inverse below; with a step besides, both.
TEST(StratifiedViscosity, ChangesEvenlyBesides)
{
    const Stratification even{0.0, 0.2, 0.001, 0.0, 3.3};
    EXPECT_TRUE(even.isThere());
    EXPECT_RELATIVE(even.factor(0.3, 0.0), 1.3909681, 1e-7);
    EXPECT_RELATIVE(even.factor(0.1, 0.0), 1.0 / 1.3909681, 1e-7);
    const Stratification both{std::log(2.0), 0.2, 0.001, 0.0, 3.3};
    EXPECT_RELATIVE(both.factor(0.3, 0.0), 0.5 * 1.3909681, 1e-7);
    EXPECT_RELATIVE(both.factor(0.1, 0.0), 1.0 / 1.3909681, 1e-7);
}

/// Without step and gradient the factor is 1 to the last bit, whatever else is set.
TEST(StratifiedViscosity, IsUniformWithoutStepAndGradient)
{
    const Stratification uniform{0.0, 0.2, 0.001, 1.5};
    EXPECT_FALSE(uniform.isThere());
    EXPECT_FALSE(Stratification().isThere());
    EXPECT_EQ(uniform.factor(0.1234, 1e-3), 1.0);
}

} // namespace
