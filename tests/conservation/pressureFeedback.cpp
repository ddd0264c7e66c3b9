// Linear analysis of particles and fluid in a closed column, one wave along it: the fluid must make room for the
// particles, eps U + alpha v = 0, by a pressure that the particles feel in the next coupling step. With what
// forces/anticipatedMotion.h gives, an error shrinks from coupling step to coupling step for all densities, coupling
// steps and low-passes; with nothing anticipated it grows, so that an empty implementation fails.

#include "forces/anticipatedMotion.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

namespace clepsydra::tests
{

namespace
{

struct Column
{
    double solidFraction;
    /// The particles' over the fluid's.
    double densityRatio;
    /// Drag coefficient times coupling step over the particles' mass.
    double relaxationTimes;
    /// Part of d(eps) that the low-pass lets through in a coupling step.
    double approach;
    /// True: contacts keep the particles where they are, and their drag does not move them.
    bool fixed = false;
};

/// Response of a particle to the impulse of the last coupling step, per mass of particles; the coupling step is the
/// unit of time.
AnticipatedMotion anticipated(const Column& column, bool seenAsFixed)
{
    ReceivedImpulse received;
    received.implicitCoefficientTime = column.relaxationTimes;
    received.impulse = Vector3d(0, 0, 1);
    // The velocity changed across the impulse: the particle is not fixed, but all of the drag was taken up.
    return anticipatedMotion(received, seenAsFixed ? Vector3d(1, 0, 0) : Vector3d(0, 0, 1), 1, 1, 1);
}

/// One coupling step maps the particles' velocity, the fluid's velocity, -grad p over the fluid's density, the impulse
/// given in advance per mass of fluid, and displacement of the particles that continuity has not had: the equations of
/// SemiImplicitSource and VoidFractionRate in the order of CouplingStep.
Eigen::Matrix<double, 5, 5> amplification(const Column& column, const AnticipatedMotion& motion)
{
    using Row = Eigen::Matrix<double, 1, 5>;
    const auto unit = [](int i) { return Row(Row::Unit(i)); };
    const Row velocity = unit(0);
    const Row fluid = unit(1);
    const Row push = unit(2);
    const Row semiImplicitImpulse = unit(3);
    const double alpha = column.solidFraction;
    const double eps = 1 - alpha;
    const double massRatio = alpha * column.densityRatio / eps;
    const double buoyancy = 1 / column.densityRatio;
    const double x = column.relaxationTimes;
    const double left = std::exp(-x);
    const double mean = (1 - left) / x;

    const Row limit = fluid + buoyancy / x * push;
    Row moved = limit + left * (velocity - limit);
    Row displacement = limit + mean * (velocity - limit);
    Row received = massRatio * (moved - velocity - buoyancy * push);
    if (column.fixed)
    {
        moved.setZero();
        displacement.setZero();
        received = massRatio * x * fluid;
    }

    const double n = motion.velocityResponse;
    const Row owed = unit(4) + displacement;
    Eigen::Matrix2d left2;
    left2 << 1 + massRatio * motion.drag, -1 - massRatio * buoyancy * n, //
        eps / alpha + column.approach * n, column.approach * motion.pressureResponse * buoyancy;
    Eigen::Matrix<double, 2, 5> right;
    right << fluid + massRatio * motion.drag * moved - received + semiImplicitImpulse,
        -column.approach * (owed + (1 - n) * moved);
    const Eigen::Matrix<double, 2, 5> solved = left2.partialPivLu().solve(right);
    const Row newFluid = solved.row(0);
    const Row newPush = solved.row(1);

    const Row given =
        column.approach * (owed + (1 - n) * moved + n * newFluid + motion.pressureResponse * buoyancy * newPush);
    Eigen::Matrix<double, 5, 5> step;
    step << moved, newFluid, newPush, massRatio * (motion.drag * (newFluid - moved) - buoyancy * n * newPush),
        owed - given;
    return step;
}

double growth(const Column& column, const AnticipatedMotion& motion)
{
    return amplification(column, motion).eigenvalues().cwiseAbs().maxCoeff();
}

} // namespace

TEST(PressureFeedback, ErrorsShrinkForAllDensitiesIntervalsAndLowPasses)
{
    for (const double solidFraction : {0.01, 0.1, 0.3, 0.6})
    {
        // 2100 is sand in air, where 1e-4 relaxation times are a coupling step for 3 mm and 0.1 for 0.1 mm.
        for (const double densityRatio : {0.05, 0.5, 1.0, 2.5, 8.0, 100.0, 2100.0, 1e4})
        {
            for (const double relaxationTimes : {1e-4, 0.01, 0.1, 0.5, 1.0, 3.0, 10.0, 100.0})
            {
                for (const double approach : {0.02, 0.2, 0.5, 1.0})
                {
                    for (const bool fixed : {false, true})
                    {
                        const Column column{solidFraction, densityRatio, relaxationTimes, approach, fixed};
                        // See VoidFractionRate for what is left out.
                        if (fixed || approach > 0.4 || relaxationTimes <= 1)
                        {
                            EXPECT_LT(growth(column, anticipated(column, true)), 1)
                                << solidFraction << ' ' << densityRatio << ' ' << relaxationTimes << ' ' << approach
                                << ' ' << fixed;
                        }
                        if (!fixed)
                        {
                            EXPECT_LT(growth(column, anticipated(column, false)), 1)
                                << solidFraction << ' ' << densityRatio << ' ' << relaxationTimes << ' ' << approach;
                        }
                    }
                }
            }
        }
    }
}

// Why the pressure response is anticipated: applied afterwards, it is too late for light particles, and for heavy ones
// at long coupling steps.
TEST(PressureFeedback, GrowsWhereNothingIsAnticipated)
{
    const auto afterwards = [](const Column& column) {
        return growth(column, AnticipatedMotion{column.relaxationTimes, 0, 0});
    };
    EXPECT_GT(afterwards({0.6, 0.05, 0.1, 1}), 2);
    EXPECT_GT(afterwards({0.6, 0.5, 0.1, 1}), 1);
    EXPECT_GT(afterwards({0.6, 2.5, 3, 1}), 1);
}

/// A wave of shear, which moves no volume: the added mass acts by DU/Dt of the last coupling step. One coupling step maps
/// the particles' velocity, the fluid's, the impulse given in advance per mass of fluid, and the last change of the
/// fluid's velocity.
double growthOfShear(const Column& column, double coefficient, bool implicitReaction)
{
    using Row = Eigen::Matrix<double, 1, 4>;
    const auto unit = [](int i) { return Row(Row::Unit(i)); };
    const Row velocity = unit(0);
    const Row fluid = unit(1);
    const double massRatio = column.solidFraction * column.densityRatio / (1 - column.solidFraction);
    const double perMass = coefficient / column.densityRatio;
    const double x = column.relaxationTimes;
    const Row limit = fluid + perMass / x * unit(3);
    Row moved = limit + std::exp(-x / (1 + perMass)) * (velocity - limit);
    Row received = massRatio * (moved - velocity);
    if (column.fixed)
    {
        moved.setZero();
        received = massRatio * (x * fluid + perMass * unit(3));
    }
    const double drag = massRatio * (column.fixed ? x : -std::expm1(-x));
    const double addedMass = implicitReaction ? implicitAddedMass(massRatio * perMass, 1) : 0;
    const Row newFluid = (fluid - received + unit(2) + drag * moved + addedMass * fluid) / (1 + drag + addedMass);
    Eigen::Matrix4d step;
    step << moved, newFluid, drag * (newFluid - moved) + addedMass * (newFluid - fluid), newFluid - fluid;
    return step.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(AddedMassFeedback, DoesNotGrowAtAnyDensityAndSolidFraction)
{
    for (const double solidFraction : {0.01, 0.3, 0.4, 0.5, 0.6, 0.65})
    {
        const double zuber = 0.5 * (1 + 2 * solidFraction) / (1 - solidFraction);
        for (const double coefficient : {0.5, zuber, 10.0})
        {
            for (const double densityRatio : {0.05, 1.0, 2.5, 8.0, 2100.0})
            {
                for (const double relaxationTimes : {1e-6, 1e-4, 0.01, 0.1, 1.0, 10.0, 100.0})
                {
                    for (const bool fixed : {false, true})
                    {
                        EXPECT_LT(
                            growthOfShear({solidFraction, densityRatio, relaxationTimes, 1, fixed}, coefficient, true),
                            1 + 1e-9)
                            << solidFraction << ' ' << coefficient << ' ' << densityRatio << ' ' << relaxationTimes
                            << ' ' << fixed;
                    }
                }
            }
        }
    }
}

// Why a part of it is implicit. The coefficient 1/2 needs none of it: such runs are what they were.
TEST(AddedMassFeedback, GrowsInDenseBedsWhereAllOfItIsExplicit)
{
    constexpr double zuberAtSixTenths = 2.75;
    EXPECT_GT(growthOfShear({0.6, 2.5, 0.01, 1, false}, zuberAtSixTenths, false), 1.5);
    EXPECT_GT(growthOfShear({0.6, 2100, 1e-4, 1, false}, zuberAtSixTenths, false), 3);
    EXPECT_GT(growthOfShear({0.6, 2100, 1e-4, 1, true}, zuberAtSixTenths, false), 3);
    EXPECT_EQ(implicitAddedMass(0.5 * 0.6, 0.4), 0);
}

} // namespace clepsydra::tests
