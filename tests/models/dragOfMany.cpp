/// \file
/// The drag laws in vector units against the same laws for one bead at a time.

#include "forces/dragOfMany.h"

#include "closures/dragLaws.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>

namespace
{

using namespace clepsydra;

// 251 beads fill no whole number of vectors; at rest and at Re to 5000, in beds and alone. An empty implementation leaves
// the coefficients as they are, a wrong mask the last of them.
TEST(DragOfMany, IsThatOfEachBead)
{
    ManyBeadsInFluid beads;
    beads.count = 251;
    beads.density = 1000;
    beads.dynamicViscosity = 1e-3;
    for (std::size_t i = 0; i < beads.count; ++i)
    {
        const double share = static_cast<double>(i) / 250;
        beads.diameter[i] = 1e-3 * (1 + share);
        beads.voidFraction[i] = 0.36 + 0.64 * std::fmod(7 * share, 1.0);
        beads.logVoidFraction[i] = std::log(beads.voidFraction[i]);
        beads.slipSpeed[i] = 2.5 * share * share * share;
    }
    closures::forEachDragLaw([&](const auto& law) {
        ManyCoefficients coefficients;
        coefficients.fill(-1);
        dragOfMany(law.name)(beads, coefficients);
        for (std::size_t i = 0; i < beads.count; ++i)
        {
            const double alone = law({beads.diameter[i], beads.voidFraction[i], beads.logVoidFraction[i],
                beads.slipSpeed[i], beads.density, beads.dynamicViscosity});
            EXPECT_NEAR(coefficients[i] / alone, 1, 1e-13) << law.name << ", bead " << i;
        }
    });
}

// OpenFOAM stops a program that divides by zero, and a compiler may take the branches of a law for all beads at once, with
// zero where a branch is not the bead's: Koch and Hill's logarithm of a dense bed's beads did so.
TEST(DragOfMany, RaisesNoFloatingPointException)
{
    for (const double voidFraction : {0.36, 0.59, 0.61, 0.9, 1.0})
    {
        ManyBeadsInFluid beads;
        beads.count = 251;
        beads.density = 1000;
        beads.dynamicViscosity = 1e-3;
        beads.diameter.fill(1e-3);
        beads.voidFraction.fill(voidFraction);
        beads.logVoidFraction.fill(std::log(voidFraction));
        beads.slipSpeed.fill(0);
        closures::forEachDragLaw([&](const auto& law) {
            ManyCoefficients coefficients;
            std::feclearexcept(FE_ALL_EXCEPT);
            dragOfMany(law.name)(beads, coefficients);
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
