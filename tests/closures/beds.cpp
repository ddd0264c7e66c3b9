/// \file
/// Ergun's packed bed and Richardson & Zaki's suspension, against values worked out by hand from the printed equations.

#include "closures/ergun.h"
#include "closures/richardsonZaki.h"

#include "relative.h"

namespace
{

using namespace clepsydra::closures;

// d 1 mm, rho_f 10, nu 1.5e-4 (mu 1.5e-3), eps .451335, L 15.6 mm
const PackedBed column{0.001, 0.451335, 10.0, 1.5e-3};
constexpr double columnLength = 0.0156;

/// eps^3 = .0919386, phi = .548665: linear 150*1.5e-3*.3010333/(.0919386e-6) = 7.367157e5, quadratic
/// 1.75*10*.548665/(.0919386e-3) = 1.044357e5; at .002 m/s 1473.431 + .417743 Pa/m = 22.992 Pa over the column, at .02
/// 230.507 Pa. An Ergun with eps^2, or with only one term, fails.
TEST(Ergun, PressureDropOfTheColumn)
{
    EXPECT_NEAR(ergunPressureGradient(column, 0.002) * columnLength, 22.99, 0.005);
    EXPECT_NEAR(ergunPressureGradient(column, 0.02) * columnLength, 230.5, 0.05);
    EXPECT_RELATIVE(ergunCoefficients(column).linear, 7.367157e5, 1e-5);
    EXPECT_RELATIVE(ergunCoefficients(column).quadratic, 1.044357e5, 1e-5);
}

/// Flow the other way gives the opposite drop, still water none. A square without its sign fails.
TEST(Ergun, PressureDropHasTheSignOfTheVelocity)
{
    EXPECT_DOUBLE_EQ(ergunPressureGradient(column, -0.02), -ergunPressureGradient(column, 0.02));
    EXPECT_EQ(ergunPressureGradient(column, 0.0), 0.0);
}

/// Buoyant weight of the column .548665*1990*9.81*.0156 = 167.09 Pa, U_mf from it .014509 m/s, and the pressure drop
/// at U_mf IS the weight. (validation.md prints U_mf .014539 and 167.4 Pa there: .2 % too much weight.)
TEST(Ergun, MinimumFluidisationOfTheColumn)
{
    EXPECT_NEAR(buoyantWeightGradient(column, 2000.0, 9.81) * columnLength, 167.09, 0.005);
    const double u = minimumFluidisationVelocity(column, 2000.0, 9.81);
    EXPECT_NEAR(u, 0.014509, 5e-7);
    EXPECT_RELATIVE(ergunPressureGradient(column, u), buoyantWeightGradient(column, 2000.0, 9.81), 1e-13);
}

/// 2 mm glass (2500) in water: .0175/.0199/.0224/.0250 m/s at eps .36/.38/.40/.42. Here the quadratic term counts
/// (Re_mf 35..50), so a U_mf from the linear term alone fails (by a factor of two).
TEST(Ergun, MinimumFluidisationOfGlassInWater)
{
    const double voidFraction[] = {0.36, 0.38, 0.40, 0.42};
    const double expected[] = {0.0175, 0.0199, 0.0224, 0.0250};
    for (int i = 0; i < 4; ++i)
    {
        const PackedBed bed{0.002, voidFraction[i], 1000.0, 1e-3};
        EXPECT_NEAR(minimumFluidisationVelocity(bed, 2500.0, 9.81), expected[i], 6e-5);
    }
}

/// For fine particles U_mf is Carman's linear one, eps^3 d^2 (rho_p - rho_f) g/(150 mu phi): .064*1e-12*1500*9.81/(.09) =
/// 1.0464e-8 m/s for 1 um. The textbook root of the quadratic loses its digits here.
TEST(Ergun, MinimumFluidisationOfDustDoesNotCancel)
{
    const PackedBed dust{1e-6, 0.4, 1000.0, 1e-3};
    EXPECT_RELATIVE(minimumFluidisationVelocity(dust, 2500.0, 9.81), 1.0464e-8, 1e-7);
}

/// n from Richardson & Zaki's pieces: 4.65; 4.35*.5^-.03 = 4.4414; 4.45*100^-.1 = 2.8078; 2.39; with the wall at
/// d/D = .1 4.65 + 1.95 = 6.60 and (4.45 + 1.8)*100^-.1 = 3.9435. A constant n fails.
TEST(RichardsonZaki, ExponentOfThePieces)
{
    EXPECT_DOUBLE_EQ(richardsonZakiExponent(0.01), 4.65);
    EXPECT_NEAR(richardsonZakiExponent(0.5), 4.4414, 1e-4);
    EXPECT_NEAR(richardsonZakiExponent(100.0), 2.8078, 1e-4);
    EXPECT_NEAR(richardsonZakiExponent(300.0), 2.5156, 1e-4);
    EXPECT_DOUBLE_EQ(richardsonZakiExponent(1e4), 2.39);
    EXPECT_DOUBLE_EQ(richardsonZakiExponent(0.01, 0.1), 6.60);
    EXPECT_NEAR(richardsonZakiExponent(100.0, 0.1), 3.9435, 1e-4);
}

/// The pieces meet to 2.3 % (Re .2: 4.65/4.5652 = 1.0186; Re 1: 4.45/4.35 = 1.0230; Re 500: 2.3904/2.39 = 1.0001),
/// as published. A piece with a wrong power is off by more.
TEST(RichardsonZaki, PiecesMeetAsWellAsPublished)
{
    const auto jump = [](double at) { return richardsonZakiExponent(at * (1 - 1e-12)) / richardsonZakiExponent(at); };
    EXPECT_NEAR(jump(0.2), 1.0186, 1e-4);
    EXPECT_NEAR(jump(1.0), 1.0 / 1.0230, 1e-4);
    EXPECT_NEAR(jump(200.0), 1.0, 1e-4);
    EXPECT_NEAR(jump(500.0), 1.0001, 1e-4);
}

/// Rowe's smooth exponent at Re 100: a = .175*100^.75 = 5.53398, (4.7 + 2.35*5.53398)/6.53398 = 2.70966; its limits
/// 4.7 and 2.35; and it stays within 6 % of the pieces. An n that does not satisfy Rowe's equation fails.
TEST(RichardsonZaki, RowesExponent)
{
    EXPECT_NEAR(roweExponent(100.0), 2.70966, 1e-5);
    EXPECT_NEAR(roweExponent(0.0), 4.7, 1e-12);
    EXPECT_NEAR(roweExponent(1e12), 2.35, 1e-6);
    for (double reynolds = 0.01; reynolds < 1e4; reynolds *= 1.5)
    {
        EXPECT_RELATIVE(roweExponent(reynolds), richardsonZakiExponent(reynolds), 0.06) << reynolds;
    }
}

} // namespace
