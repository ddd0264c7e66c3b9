/// \file
/// One row per drag law. Every law is compared with numbers worked out from the printed formula (with pow and C_d, not
/// with the regular form that the code evaluates), and against what any drag law must do.
/// TO ADD A LAW: one row in dragLawTable().

#include "relative.h"

#include "closures/dragLaws.h"

#include <gmock/gmock.h>

#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace
{

using namespace clepsydra::closures;

struct DragRow
{
    std::string name;
    std::function<double(const ParticleInFluid&)> law;
    double inWaterBed;     // Sp [kg/s] in the states below
    double inAirBed;       //
    double inDiluteWater;  //
    double creepingFactor; // Sp/(3 pi mu d) at rest, eps = 0.5
    double isolatedFactor; // Sp/(3 pi mu d) at Re = 100, eps = 1
};

void PrintTo(const DragRow& row, std::ostream* stream)
{
    *stream << row.name;
}

template<class DragLaw>
DragRow row(double inWaterBed, double inAirBed, double inDiluteWater, double creepingFactor, double isolatedFactor)
{
    return {DragLaw::name, DragLaw{}, inWaterBed, inAirBed, inDiluteWater, creepingFactor, isolatedFactor};
}

// 2 mm particle in water, rho eps u d/mu = 1000*.5*.1*.002/.001 = 100 (isolated: 200)
const ParticleInFluid waterBed = makeParticleInFluid(0.002, 0.5, 0.1, 1000.0, 1e-3);
// 1 mm particle in air, 1.2*.45*.3*.001/1.8e-5 = 9 (isolated: 20)
const ParticleInFluid airBed = makeParticleInFluid(0.001, 0.45, 0.3, 1.2, 1.8e-5);
// 2 mm particle in dilute water, 1000*.9*(1/18)*.002/.001 = 100 (isolated: 111.1)
const ParticleInFluid diluteWater = makeParticleInFluid(0.002, 0.9, 1.0 / 18.0, 1000.0, 1e-3);

std::vector<DragRow> dragLawTable()
{
    return {
        // 3 pi mu d: 3 pi * 1e-3 * .002 = 1.884956e-5;  3 pi * 1.8e-5 * .001 = 1.696460e-7
        row<StokesDrag>(1.884955592e-05, 1.696460033e-07, 1.884955592e-05, 1.0, 1.0),

        // water: 200^.687 = 38.08970, C_d = 24/200 (1 + .15*38.08970) = .8056147
        //        pi/8 * 4e-6 * 1000 * .1 * .8056147 = 1.265457e-4
        // air:   20^.687 = 7.830827, factor 1 + .15*7.830827 = 2.174624, * 1.696460e-7 = 3.689163e-7
        // isolated:  1 + .15*100^.687 = 1 + .15*23.659197 = 4.548880
        row<SchillerNaumannDrag>(1.265456591e-04, 3.689162684e-07, 9.076592924e-05, 1.0, 4.548879546),

        // water: 200^.681 = 36.89788; 24/200 (1 + .15*36.89788) = .7841619; .407/(1 + 8710/200) = .0091358
        //        C_d = .7932977; pi/8 * 4e-6 * 1000 * .1 * .7932977 = 1.246109e-4
        // isolated:  100^.681 = 23.01442; 1 + 3.452163 + .407*100/(24*88.1) = 4.471412
        row<BrownLawlerDrag>(1.246109054e-04, 3.654983216e-07, 8.920917789e-05, 1.0, 4.471411686),

        // water: Re 200: .12 + 2.6*40/(1 + 40^1.52 = 273.4) + .411*(7.604563e-4)^.06 + 5e-5 = .7676312
        //        pi/8 * 4e-6 * 1000 * .1 * .7676312 = 1.205792e-4
        // isolated:  C_d(100) = 1.0381253, * 100/24 = 4.325522
        row<MorrisonDrag>(1.205792259e-04, 3.619169762e-07, 8.618930118e-05, 1.0, 4.325521996),

        // water: C_d = (.63 + .48)^2 = 1.2321; chi = 3.7 - .65 exp(-.5^2/2) = 3.7 - .65*.8824969 = 3.1263770
        //        eps^(2 - chi) = .5^-1.1263770 = 2.1830982
        //        1/8 * 1.2321 * 1000 * pi * 4e-6 * .1 * 2.1830982 = 4.225121e-4
        // air:   C_d = (.63 + 1.6)^2 = 4.9729; log10 9 = .9542425; chi = 3.7 - .65*.8616332 = 3.1399384
        //        .45^-1.1399384 = 2.4849427; 1/8 * 4.9729 * 1.2 * pi * 1e-6 * .3 * 2.4849427 = 1.746982e-6
        // dilute: .9^-1.1263770 = 1.1260047; 1/8 * 1.2321 * 1000 * pi * 4e-6/18 * 1.1260047 = 1.210692e-4
        // rest:  4.8^2/24 * .5^(1 - 3.7) = .96 * 6.498019 = 6.238098
        // isolated:  (6.3 + 4.8)^2/24 = 123.21/24 = 5.13375
        row<DiFeliceDrag>(4.225120525e-04, 1.746982246e-06, 1.210691561e-04, 6.2380984040, 5.13375),

        // water: beta = 2.65*1.5 - (5.3 - 1.75)*.25*.8824969 = 3.975 - .7832160 = 3.1917840
        //        .5^-1.1917840 = 2.2843506; 5e-5 * 1.2321 * pi * 2.2843506 = 4.421082e-4
        // rest:  .96 * .5^(1 - 3.975) = .96 * 7.862565 = 7.548062
        row<RongDrag>(4.421081965e-04, 1.821951267e-06, 1.259053179e-04, 7.5480621968, 5.13375),

        // water: beta = 150*.25*.001/(.5*4e-6) + 1.75*.5*1000*.1/.002 = 18750 + 43750 = 62500
        //        V_p = pi/6 * 8e-9 = 4.188790e-9; 62500 * V_p/.5 = 5.235988e-4
        // dilute: beta = 150*.01*.001/(.9*4e-6) + 1.75*.1*1000/18/.002 = 416.6667 + 4861.1111
        //        = 5277.7778, * V_p/.1 = 2.210750e-4
        // rest:  150/18 * .5/.5 = 8.333333;  isolated (no bed at all): 1.75/18 * 100 = 9.722222
        row<ErgunDrag>(5.235987756e-04, 2.057743188e-06, 2.210750386e-04, 150.0 / 18.0, 175.0 / 18.0),

        // dilute: Re 100: C_d = .24*4.548880 = 1.0917311; .9^-2.65 = 1.3220866
        //        beta = .75 * 1.0917311 * .9 * .1 * 1000/18/.002 * 1.3220866 = 2706.292; * V_p/.1 = 1.133608e-4
        // rest:  .5^-2.65 = 6.276673
        row<WenYuDrag>(5.381892869e-04, 2.363168410e-06, 1.133608021e-04, 6.276672784, 4.548879546),

        // Ergun's row at eps .5 and .45, Wen & Yu's at .9 and 1
        row<GidaspowDrag>(5.235987756e-04, 2.057743188e-06, 1.133608021e-04, 150.0 / 18.0, 4.548879546),

        // water: phi .5: F0 = 10*.5/.125 = 40; F3 = .0673 + .106 + .0232*32 = .9157; F = 40 + .5*.9157*100 = 85.785
        //        beta = 18*.001*.25*.5/4e-6 * 85.785 = 48254.06; * V_p/.5 = 4.042523e-4
        // dilute: phi .1: F0 = (1 + 3 sqrt(.05) + 135/64*.1*ln .1 + 1.614)/(1 + .0681 - .0848 + .00814)
        //        = (1 + .6708204 - .4857015 + 1.614)/.99144 = 2.823286
        //        F3 = .0673 + .0212 + .0232/.59049 = .1277894; F = 2.823286 + 6.389470 = 9.212756
        //        3 pi mu d eps^2 F = 1.884956e-5 * .81 * 9.212756 = 1.406617e-4
        // rest:  eps^2 F0 = .25*40 = 10;  isolated: 1 + .5*(.0673 + .0232)*100 = 5.525
        row<KochHillDrag>(4.042522887e-04, 2.296240103e-06, 1.406616567e-04, 10.0, 5.525),

        // water: 10*.5/.25 = 20; .25*(1 + 1.5*.7071068) = .5151650; 41.3/(24*.25) = 6.883333
        //        2 + .75 + 8.4*100^-.343 = 2.75 + 8.4*.2060630 = 4.480929; 1 + 10^1.5 * 100^-1.5 = 1.0316228
        //        F = 20.515165 + 6.883333*4.480929/1.0316228 = 50.413414
        //        3 pi mu d eps F = 1.884956e-5 * .5 * 50.413414 = 4.751354e-4
        // rest:  .5 * 20.515165 = 10.257583
        // isolated:  1 + 41.3/24 * 2.730929/(1 + .1) = 5.272249
        row<BeetstraDrag>(4.751353631e-04, 2.279612057e-06, 1.451108873e-04, 10.257582521, 5.272249023),

        // water: .11*.5*1.5 = .0825; .00456*16 = .07296; (.0845 + 1.0304)*.2060630 = .2297396; sum .2392796
        //        F = 20.515165 + 23.927963 = 44.443128; 1.884956e-5 * .5 * 44.443128 = 4.188666e-4
        // rest:  as Beetstra's;  isolated:  1 + 100*(.2334*.2060630 - .00456) = 5.353510
        row<TangDrag>(4.188666128e-04, 2.626568017e-06, 1.374236767e-04, 10.2575825215, 5.353510218),
    };
}

class DragLaw : public testing::TestWithParam<DragRow>
{};

/// The law gives the numbers of its paper's formula in a liquid bed, a gas bed and a dilute suspension. A law that
/// returns nothing, has a wrong coefficient, confuses superficial with interstitial slip (Re 100 against 200) or model
/// A with B (a factor .5) fails.
TEST_P(DragLaw, GivesTheValuesWorkedOutByHand)
{
    const DragRow& r = GetParam();
    EXPECT_RELATIVE(r.law(waterBed), r.inWaterBed, 1e-8);
    EXPECT_RELATIVE(r.law(airBed), r.inAirBed, 1e-8);
    EXPECT_RELATIVE(r.law(diluteWater), r.inDiluteWater, 1e-8);
}

/// At rest, where the printed C_d is infinite, the law is finite and at its own creeping limit, and it comes there
/// without a jump. A law that evaluates 24/Re gives NaN here.
TEST_P(DragLaw, IsAtItsCreepingLimitAtRest)
{
    const DragRow& r = GetParam();
    ParticleInFluid particle = waterBed;
    particle.slipSpeed = 0.0;
    EXPECT_RELATIVE(r.law(particle), r.creepingFactor * 1.884955592153876e-05, 1e-8);
    for (const double slip : {1e-300, 1e-30, 1e-12, 1e-9})
    {
        particle.slipSpeed = slip;
        EXPECT_RELATIVE(r.law(particle), r.creepingFactor * 1.884955592153876e-05, 1e-3) << "slip " << slip;
    }
}

/// Without neighbours (eps exactly 1, where ln phi does not exist) the law is finite, has its isolated-particle value, and is
/// continuous there. A law that lacks its eps -> 1 branch gives NaN.
TEST_P(DragLaw, IsAtItsIsolatedParticleLimitWithoutNeighbours)
{
    const DragRow& r = GetParam();
    const double stokes = 1.884955592153876e-05;
    EXPECT_RELATIVE(r.law(makeParticleInFluid(0.002, 1.0, 0.05, 1000.0, 1e-3)), r.isolatedFactor * stokes, 1e-8);
    // the laws from lattice Boltzmann rise as sqrt(phi), hence 1e-6 in eps but 1e-2 in the drag
    EXPECT_RELATIVE(r.law(makeParticleInFluid(0.002, 1.0 - 1e-6, 0.05, 1000.0, 1e-3)), r.isolatedFactor * stokes, 1e-2);
}

/// Faster slip never meets less force, at any void fraction from a bed to an isolated particle and 18 decades of slip. The
/// bisection for terminal velocities and any stable time step rest on it. (Sp alone need not rise: Di Felice.)
TEST_P(DragLaw, ForceRisesWithSlip)
{
    const DragRow& r = GetParam();
    for (const double eps : {0.30, 0.36, 0.42, 0.5, 0.6, 0.7, 0.79, 0.81, 0.9, 0.99, 1.0})
    {
        double previous = 0.0;
        for (double slip = 1e-15; slip < 30.0; slip *= 1.1)
        {
            const double force = r.law(makeParticleInFluid(0.002, eps, slip, 1000.0, 1e-3)) * slip;
            ASSERT_TRUE(std::isfinite(force));
            ASSERT_GT(force, previous) << "eps " << eps << ", slip " << slip;
            previous = force;
        }
    }
}

/// Drag in units of Stokes' drag depends on Re and eps alone: the same bed at another scale (a 0.2 mm particle, oil, the
/// slip that keeps Re) gives the same factor. A constant with a hidden dimension fails.
TEST_P(DragLaw, IsDimensionallyConsistent)
{
    const DragRow& r = GetParam();
    // Re = 900*.5*u*.0002/.05 = 100 -> u = 5/.09
    const ParticleInFluid scaled = makeParticleInFluid(0.0002, 0.5, 5.0 / 0.09, 900.0, 0.05);
    EXPECT_RELATIVE(r.law(scaled) / stokesCoefficient(scaled), r.law(waterBed) / stokesCoefficient(waterBed), 1e-12);
}

/// A thicker fluid and a larger particle both mean more drag at the same slip. A law that forgets one of them fails.
TEST_P(DragLaw, RisesWithViscosityAndDiameter)
{
    const DragRow& r = GetParam();
    ParticleInFluid thicker = waterBed;
    thicker.dynamicViscosity *= 2.0;
    EXPECT_GT(r.law(thicker), r.law(waterBed)) << "viscosity must matter";
    ParticleInFluid larger = waterBed;
    larger.diameter *= 2.0;
    EXPECT_GT(r.law(larger), r.law(waterBed)) << "diameter must matter";
}

/// A law that a case can choose is one that this table holds against its paper.
TEST(DragLaws, EachHasItsRow)
{
    std::vector<std::string> tested;
    for (const DragRow& row : dragLawTable())
    {
        tested.push_back(row.name);
    }
    EXPECT_THAT(dragLawNames(), testing::UnorderedElementsAreArray(tested));
}

INSTANTIATE_TEST_SUITE_P(Closures, DragLaw, testing::ValuesIn(dragLawTable()),
    [](const testing::TestParamInfo<DragRow>& law) { return law.param.name; });

} // namespace
