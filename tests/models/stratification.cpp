/// \file
/// Forces on particles in a liquid whose viscosity changes with height.

#include "forcesOnParticles.h"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

namespace
{

constexpr double radius = 1e-3;

/// Half as viscous above 20 mm.
FluidProperties layers()
{
    FluidProperties fluid{1000, 1e-2, {0, 0, -9.81}};
    fluid.stratification = {std::log(2.0), 0.02, 0.003, 1.5};
    return fluid;
}

/// What the forces add to gravity at three heights, two of them in the layers' edge, in a second step: a history force
/// needs a first.
Eigen::Matrix3Xd accelerations(const std::string& force, const std::vector<FluidProperties>& fluids)
{
    const std::string wall = "walls ( ((1.09e-3 0 0) (-1 0 0)) );";
    Eigen::Matrix3Xd found(3, 3);
    for (std::size_t i = 0; i < 3; ++i)
    {
        ForcesOnParticles test(
            "forceModels (" + force + "); lubricationForceProps { roughness 1e-6; " + wall + " }", fluids[i]);
        const double heights[] = {0.014, 0.0185, 0.03};
        for (int particle = 0; particle < 3; ++particle)
        {
            test.engine().addParticle(particle + 1, {0, 0, heights[particle]}, radius, 2500, {0.01, 0.002, -0.03});
            test.fluidAt(particle).vorticity = {2, 3, 5};
        }
        test.engine().requestMemory(test.forces().needs().memory);
        test.engine().advance(1);
        found.col(static_cast<Eigen::Index>(i)) = test.accelerationOf(static_cast<Eigen::Index>(i)) - fluids[i].gravity;
    }
    return found;
}

/// Every force that knows the viscosity takes it at the height of its particle: what a liquid has that is all of that
/// viscosity, but for the .3 um of the first step. One that takes the lower liquid's, or the first particle's for all, fails.
TEST(Stratification, EveryForceTakesTheViscosityAtItsParticle)
{
    const FluidProperties liquid = layers();
    const auto uniform = [&](double h, double diameter) {
        return FluidProperties{liquid.density, liquid.viscosityAt({0.3, 0.1, h}, diameter), liquid.gravity};
    };
    EXPECT_NEAR(uniform(0.03, 0).dynamicViscosity, 0.5e-2, 1e-5);
    EXPECT_NEAR(uniform(0, 0).dynamicViscosity, 1e-2, 1e-10);
    for (const std::string force : {"StokesDrag", "SchillerNaumannDrag", "historyForce", "SaffmanLiftForce"})
    {
        const Eigen::Matrix3Xd found = accelerations(force, {liquid, liquid, liquid});
        const Eigen::Matrix3Xd expected =
            accelerations(force, {uniform(0.014, 2 * radius), uniform(0.0185, 2 * radius), uniform(0.03, 2 * radius)});
        EXPECT_LT((found - expected).norm(), 1e-4 * expected.norm()) << force;
        EXPECT_GT((expected.col(0) - expected.col(2)).norm(), 0.1 * expected.norm()) << force;
    }
    // The film between particle and wall is liquid that lies there, not what the particle brings along.
    const Eigen::Matrix3Xd found = accelerations("lubricationForce", {liquid, liquid, liquid});
    const Eigen::Matrix3Xd expected =
        accelerations("lubricationForce", {uniform(0.014, 0), uniform(0.0185, 0), uniform(0.03, 0)});
    EXPECT_LT((found - expected).norm(), 1e-4 * expected.norm());
    EXPECT_GT((expected.col(0) - expected.col(2)).norm(), 0.1 * expected.norm());
}

closures::Stratification read(const std::string& entries, const Vector3d& gravity = {0, 0, -9.81})
{
    const Foam::dictionary dict(Foam::IStringStream("stratification { " + entries + " }")());
    return readStratification(dict, gravity, Foam::boundBox(Foam::point::zero, Foam::point(0.1, 0.1, 0.3)));
}

/// What is not given is zero, but the edge must be.
TEST(Stratification, IsReadFromItsEntry)
{
    const closures::Stratification all = read("height 0.243; width 0.008; step 0.66; lag 1.5; gradient -0.4;");
    EXPECT_EQ(all.height, 0.243);
    EXPECT_EQ(all.width, 0.008);
    EXPECT_EQ(all.step, 0.66);
    EXPECT_EQ(all.lag, 1.5);
    EXPECT_EQ(all.gradient, -0.4);
    const closures::Stratification few = read("height 0.243; width 0.008; step 0.66;");
    EXPECT_EQ(few.lag, 0);
    EXPECT_EQ(few.gradient, 0);
    EXPECT_FALSE(readStratification(Foam::dictionary(), {0, 0, -9.81}, Foam::boundBox()).isThere());
    // Layers need a direction, but a liquid that is none may be weightless.
    EXPECT_FALSE(read("height 0.243; width 0.008;", Vector3d::Zero()).isThere());
}

TEST(Stratification, RefusesWhatItCannotUse)
{
    for (const std::string entries : {"width 0.008; step 0.66;", "height 0.243; step 0.66;",
             "height 0.243; width 0; step 1;", "height 0.243; width -1; step 1;", "height 0.243; width 0.008; step 21;",
             "height 0.243; width 0.008; step nan;", "height 0.243; width 0.008; gradient 1e3;",
             "height nan; width 0.008; step 1;", "height 0.243; width 0.008; stp 1;",
             "height 0.243; width 0.008; step 1; lag 1e5;"})
    {
        EXPECT_THROW(read(entries), Foam::IOerror) << entries;
    }
    EXPECT_THROW(read("height 0.243; width 0.008; step 0.66;", Vector3d::Zero()), Foam::IOerror);
}

} // namespace

} // namespace clepsydra::tests
