/// \file
/// The drag laws in vector units against the same laws for one particle at a time.

#include "forces/dragOfMany.h"

#include "closures/dragLaws.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>

namespace
{

using namespace clepsydra;

// 251 particles fill no whole number of vectors; at rest and at Re to 5000, in beds and alone. An empty implementation leaves
// the coefficients as they are, a wrong mask the last of them.
TEST(DragOfMany, IsThatOfEachParticle)
{
    ManyParticlesInFluid particles;
    particles.count = 251;
    particles.density = 1000;
    particles.dynamicViscosity = 1e-3;
    for (std::size_t i = 0; i < particles.count; ++i)
    {
        const double share = static_cast<double>(i) / 250;
        particles.diameter[i] = 1e-3 * (1 + share);
        particles.voidFraction[i] = 0.36 + 0.64 * std::fmod(7 * share, 1.0);
        particles.logVoidFraction[i] = std::log(particles.voidFraction[i]);
        particles.slipSpeed[i] = 2.5 * share * share * share;
    }
    closures::forEachDragLaw([&](const auto& law) {
        ManyCoefficients coefficients;
        coefficients.fill(-1);
        dragOfMany(law.name)(particles, coefficients);
        for (std::size_t i = 0; i < particles.count; ++i)
        {
            const double alone = law({particles.diameter[i], particles.voidFraction[i], particles.logVoidFraction[i],
                particles.slipSpeed[i], particles.density, particles.dynamicViscosity});
            EXPECT_NEAR(coefficients[i] / alone, 1, 1e-13) << law.name << ", particle " << i;
        }
    });
}

// OpenFOAM stops a program that divides by zero, and a compiler may take the branches of a law for all particles at once, with
// zero where a branch is not the particle's: Koch and Hill's logarithm of a dense bed's particles did so.
TEST(DragOfMany, RaisesNoFloatingPointException)
{
    for (const double voidFraction : {0.36, 0.59, 0.61, 0.9, 1.0})
    {
        ManyParticlesInFluid particles;
        particles.count = 251;
        particles.density = 1000;
        particles.dynamicViscosity = 1e-3;
        particles.diameter.fill(1e-3);
        particles.voidFraction.fill(voidFraction);
        particles.logVoidFraction.fill(std::log(voidFraction));
        particles.slipSpeed.fill(0);
        closures::forEachDragLaw([&](const auto& law) {
            ManyCoefficients coefficients;
            std::feclearexcept(FE_ALL_EXCEPT);
            dragOfMany(law.name)(particles, coefficients);
            EXPECT_FALSE(std::fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW))
                << law.name << " at a void fraction of " << voidFraction;
        });
    }
}

TEST(DragOfMany, RefusesAnUnknownName)
{
    EXPECT_THROW(dragOfMany("NoDrag"), std::invalid_argument);
}

} // namespace
