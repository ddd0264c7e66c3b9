/// \file
/// One row per polydispersity law, against numbers worked out by hand from the papers' formulas for the total force.
/// TO ADD A LAW: one row in polydispersityTable().

#include "closures/polydisperseDrag.h"

#include "relative.h"

#include "closures/beetstraDrag.h"

#include <gmock/gmock.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace
{

using namespace clepsydra::closures;

struct PolydispersityRow
{
    std::string name;
    std::function<double(const ParticleInFluid&, double)> drag; // of a particle among others of a mean diameter
    std::function<double(double, double, double)> law;
    double small;        // Sp [kg/s] in the states below
    double large;        //
    double equalSpheres; // factor on the drag law's value where all particles have one size
};

void PrintTo(const PolydispersityRow& row, std::ostream* stream)
{
    *stream << row.name;
}

template<class Law>
PolydispersityRow row(double small, double large, double equalSpheres)
{
    return {Law::name,
        [](const ParticleInFluid& p, double mean) { return polydisperseDrag(Law{}, BeetstraDrag{}, p, mean); }, Law{},
        small, large, equalSpheres};
}

// Particles of 1.5 and 3 mm in water among others of the Sauter mean diameter 2 mm, Re of the mean diameter 100.
constexpr double mean = 0.002;
const ParticleInFluid smallOne = makeParticleInFluid(0.0015, 0.5, 0.1, 1000.0, 1e-3);
const ParticleInFluid largeOne = makeParticleInFluid(0.003, 0.5, 0.1, 1000.0, 1e-3);

std::vector<PolydispersityRow> polydispersityTable()
{
    return {
        // Equal spheres of 2 mm: F = 50.413428 in units of 3 pi mu d eps U (worked out in dragLawTable.cpp).
        // 3 pi mu d: 1.413717e-5 and 2.827433e-5
        // small: y = .75: 1.413717e-5 * .5 * .75 * 50.413428 = 2.672636e-4
        // large: y = 1.5: 2.827433e-5 * .5 * 1.5 * 50.413428 = 1.069055e-3
        row<BeetstraPolydispersity>(2.672636418e-04, 1.069054567e-03, 1.0),

        // small: .75 + .064*.421875 = .777; .777/.75 = 1.036 times the value above
        // large: 1.5 + .064*3.375 = 1.716; 1.716/1.5 = 1.144 times the value above
        row<BeetstraCubicPolydispersity>(2.768851329e-04, 1.222998425e-03, 1.064),

        // a = 1 - 1.33 + 2.274 - 1.41725 = .52675; 1/eps = 2; F - 2 = 48.413428
        // small: .52675*.75 + .47325*.5625 = .661266; F_i = 2 + 32.014134 = 34.014134; * 1.413717e-5 * .5 = 2.404318e-4
        // large: .52675*1.5 + .47325*2.25 = 1.854938; F_i = 2 + 89.803885 = 91.803885; * 2.827433e-5 * .5
        row<YinSundaresanPolydispersity>(2.404317565e-04, 1.297846816e-03, 1.0),
    };
}

class PolydispersityLaw : public testing::TestWithParam<PolydispersityRow>
{};

/// The law gives the numbers of its paper. A law that evaluates the drag law with the particle's own diameter, or one
/// that takes the inverse of y, fails.
TEST_P(PolydispersityLaw, GivesTheValuesWorkedOutByHand)
{
    const PolydispersityRow& r = GetParam();
    EXPECT_RELATIVE(r.drag(smallOne, mean), r.small, 1e-8);
    EXPECT_RELATIVE(r.drag(largeOne, mean), r.large, 1e-8);
}

/// Among particles of its own size a particle has the drag law's drag; the cubic form is 6.4 % above it, as published.
TEST_P(PolydispersityLaw, IsTheDragLawAmongEqualSpheres)
{
    const PolydispersityRow& r = GetParam();
    for (const double eps : {0.36, 0.5, 0.8, 1.0})
    {
        const ParticleInFluid particle = makeParticleInFluid(mean, eps, 0.1, 1000.0, 1e-3);
        EXPECT_RELATIVE(r.drag(particle, mean), r.equalSpheres * BeetstraDrag{}(particle), 1e-14) << "eps " << eps;
    }
}

/// A larger particle in the same mixture has more drag, at any void fraction of a bed.
TEST_P(PolydispersityLaw, GrowsWithTheDiameter)
{
    for (const double eps : {0.36, 0.45, 0.6, 0.8})
    {
        double previous = 0.0;
        for (double y = 0.25; y < 4.0; y *= 1.1)
        {
            const double drag = y * GetParam().law(y, eps, 20.0);
            EXPECT_GT(drag, previous) << "eps " << eps << ", y " << y;
            previous = drag;
        }
    }
}

/// A law that a case can choose is one that this table holds against its paper.
TEST(PolydispersityLaws, EachHasItsRow)
{
    std::vector<std::string> tested;
    for (const PolydispersityRow& row : polydispersityTable())
    {
        tested.push_back(row.name);
    }
    EXPECT_THAT(polydispersityLawNames(), testing::UnorderedElementsAreArray(tested));
}

INSTANTIATE_TEST_SUITE_P(Closures, PolydispersityLaw, testing::ValuesIn(polydispersityTable()),
    [](const testing::TestParamInfo<PolydispersityRow>& law) { return law.param.name; });

/// Model A's factor and the force of the pressure gradient, (1 - eps) y^2 of F, add up to the published factor on the
/// total force. eps = .4, y = 2: .4*2 + .6*4 + .064*.4*8 = 3.4048 with the cubic term and 3.2 without. A law that
/// applies the factor of the total force to model A's drag counts the pressure gradient twice: 3.4048 f, not 2.512 f.
TEST(Polydispersity, BelongsToModelA)
{
    const double eps = 0.4;
    const double total = 10.0;          // F of equal spheres, with the pressure gradient
    const double f = eps * eps * total; // Sp/(3 pi mu d): F eps without the gradient, and U = eps U_r
    // drag in units of 3 pi mu d U, then the share of the pressure gradient
    const auto totalForce = [&](double g) { return g / eps + 0.6 * 4.0 * total; };
    EXPECT_RELATIVE(totalForce(BeetstraCubicPolydispersity{}(2.0, eps, f)), 34.048, 1e-12);
    EXPECT_RELATIVE(totalForce(BeetstraPolydispersity{}(2.0, eps, f)), 32.0, 1e-12);
}

/// Equal volumes of 1 mm and 3 mm have <d> = 2/(1/1 + 1/3) = 1.5 mm. By Beetstra's factor all particles together have
/// the drag of equal spheres of 1.5 mm: with 27 small ones for each large one 27 Sp(1 mm) + Sp(3 mm) = 54/1.5^3 Sp(1.5
/// mm) = 16 Sp. A mean by number or by volume in place of Sauter's fails.
TEST(Polydispersity, KeepsTheDragOfTheWholeBed)
{
    const auto inBed = [](double diameter) { return makeParticleInFluid(diameter, 0.42, 0.05, 1000.0, 1e-3); };
    const auto drag = [&](double diameter) {
        return polydisperseDrag(BeetstraPolydispersity{}, BeetstraDrag{}, inBed(diameter), 0.0015);
    };
    EXPECT_RELATIVE(27.0 * drag(0.001) + drag(0.003), 16.0 * BeetstraDrag{}(inBed(0.0015)), 1e-12);
}

/// A grain of dust among large particles: Yin & Sundaresan's law tends to Stokes' drag with the interstitial slip, 3 pi
/// mu d = 9.424778e-9 for 1 um in water; Beetstra's factor tends to none at all.
TEST(Polydispersity, OfDustAmongLargeParticles)
{
    const ParticleInFluid dust = makeParticleInFluid(1e-6, 0.45, 1e-3, 1000.0, 1e-3);
    EXPECT_RELATIVE(polydisperseDrag(YinSundaresanPolydispersity{}, BeetstraDrag{}, dust, 0.002), 9.424778e-9, 0.01);
    EXPECT_LT(polydisperseDrag(BeetstraPolydispersity{}, BeetstraDrag{}, dust, 0.002), 1e-9);
}

} // namespace
