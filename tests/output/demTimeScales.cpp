// First: OpenFOAM's `Log` is a macro, GoogleMock's a function.
#include <gmock/gmock.h>

#include "run/demTimeScales.h"
#include "run/startReport.h"
#include "support/boxMesh.h"
#include "support/errorOf.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"

#include "IStringStream.H"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

namespace
{

const FluidProperties water{1000, 1e-3, {0, 0, -9.81}};

/// An engine with particles of 4 mm on every rank and one of 2 mm on the last; glass softened to E = 5e6 Pa.
std::unique_ptr<FakeEngine> engineWithParticles()
{
    auto made = std::make_unique<FakeEngine>(4e-5);
    FakeEngine& engine = *made;
    engine.setContactMaterials({{5e6, 0.2}});
    const int rank = Foam::Pstream::myProcNo();
    engine.addParticle(rank, {0, 0, 0}, 0.002, 2540);
    if (rank == Foam::Pstream::nProcs() - 1)
    {
        engine.addParticle(100, {0, 0, 0.01}, 0.001, 2540);
    }
    engine.initialise(nullptr);
    return made;
}

/// By hand for the 2 mm particle: Rayleigh time 1.206475e-4 s; collision at 1 m/s 4.384447e-4 s (at 0.1 m/s)/10^0.2;
/// relaxation 4/3 (rho_p/rho) d/(C_d U) with C_d = 0.44 at Re = 2000. Cells of 0.1 x 0.05 x 0.02 m: 0.02 m at 1 m/s,
/// where the cube root of the volume would give 0.046. The other particles are larger: a mean, or one rank's own minimum,
/// fails.
TEST(DemTimeScales, AreThoseOfTheSmallestParticleAndTheThinnestCell)
{
    TemporaryCase temporaryCase;
    const auto mesh = boxMesh(temporaryCase.time(), {0, 0, 0}, {0.2, 0.2, 0.1}, {2, 4, 5});
    const auto engine = engineWithParticles();

    const DemTimeScales scales = demTimeScales(*engine, 1e-3, &water, *mesh);

    EXPECT_EQ(scales.demStep, 4e-5);
    EXPECT_EQ(scales.couplingTimeStep, 1e-3);
    EXPECT_EQ(scales.particles, Foam::Pstream::nProcs() + 1);
    EXPECT_NEAR(scales.rayleigh.value(), 1.206475e-4, 1e-10);
    EXPECT_NEAR(scales.collision.value(), 2.766399e-4, 1e-9);
    EXPECT_NEAR(scales.relaxation.value(), 4.0 / 3 * 2.54 * 0.002 / 0.44, 1e-9);
    EXPECT_NEAR(scales.courant.value(), 0.02, 1e-12);
}

/// What is not known must be empty, not zero or huge: no fluid, then no particle and no material.
TEST(DemTimeScales, AreEmptyWhereNotKnown)
{
    TemporaryCase temporaryCase;
    const auto mesh = boxMesh(temporaryCase.time(), {0, 0, 0}, {1, 1, 1}, {1, 1, 1});
    const auto dry = engineWithParticles();
    const DemTimeScales ofDry = demTimeScales(*dry, 1e-3, nullptr, *mesh);
    EXPECT_TRUE(ofDry.rayleigh.has_value());
    EXPECT_FALSE(ofDry.relaxation.has_value());
    EXPECT_FALSE(ofDry.courant.has_value());

    FakeEngine empty(4e-5);
    empty.initialise(nullptr);
    const DemTimeScales ofEmpty = demTimeScales(empty, 1e-3, &water, *mesh);
    EXPECT_EQ(ofEmpty.particles, 0);
    EXPECT_FALSE(ofEmpty.rayleigh.has_value());
    EXPECT_FALSE(ofEmpty.collision.has_value());
    EXPECT_FALSE(ofEmpty.relaxation.has_value());
    EXPECT_TRUE(ofEmpty.courant.has_value());
}

std::string errorWith(double demStep, const std::string& demEntries)
{
    const Foam::dictionary dem(Foam::IStringStream("script \"DEM/in.hopper\"; " + demEntries)());
    return errorOf([&] { checkDemStep({demStep, 1e-3, 1, 1e-4, {}, {}, {}}, dem); });
}

/// At a Rayleigh time of 1e-4 s the limit is 4e-5 s, or what the entry says; above it the error must name what is
/// wrong and what is allowed. A check that never raises, or takes the entry for nothing, fails.
TEST(StartReport, RefusesADemStepAboveTheStableOne)
{
    EXPECT_EQ(errorWith(3.9e-5, ""), "");
    EXPECT_THAT(errorWith(4.1e-5, ""),
        testing::AllOf(testing::HasSubstr("DEM step is above the stable one"), testing::HasSubstr("DEM/in.hopper"),
            testing::HasSubstr("'maxRayleighFraction'"), testing::HasSubstr("at most 4e-05 s")));
    EXPECT_EQ(errorWith(4.1e-5, "maxRayleighFraction 0.5;"), "");
    EXPECT_THAT(errorWith(2.1e-5, "maxRayleighFraction 0.2;"), testing::HasSubstr("at most 2e-05 s"));
    EXPECT_THAT(errorWith(1e-5, "maxRayleighFraction -1;"), testing::HasSubstr("'maxRayleighFraction' is -1"));
}

/// The log must hold the versions, the models handed in, and each time scale with its verdict.
TEST(StartReport, PrintsModelsAndTimeScales)
{
    const Foam::dictionary dem;
    FakeEngine engine(4e-5);
    testing::internal::CaptureStdout();
    printStartReport(
        engine, {"DiFelice: xi = 3.7"}, {"m dv/dt = F"}, {4e-5, 1e-3, 3000, 1.2e-4, 1e-4, 0.0153, {}}, dem);
    const std::string text = testing::internal::GetCapturedStdout();
    if (Foam::Pstream::master())
    {
        EXPECT_THAT(text, testing::HasSubstr("fake engine"));
        EXPECT_THAT(text, testing::HasSubstr("commit "));
        EXPECT_THAT(text, testing::HasSubstr("DiFelice: xi = 3.7"));
        EXPECT_THAT(text, testing::HasSubstr("m dv/dt = F"));
        EXPECT_THAT(text, testing::ContainsRegex("Rayleigh time +0.00012 s +DEM step is 0.333 of it, respected"));
        EXPECT_THAT(text, testing::ContainsRegex("Collision .Hertz. at 1 m/s .*is 0.4 of it, NOT RESPECTED"));
        EXPECT_THAT(text, testing::ContainsRegex("Courant limit at 1 m/s +not known"));
    }
}

} // namespace

} // namespace clepsydra::tests
