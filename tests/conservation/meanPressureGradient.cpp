/// \file
/// The mean pressure gradient that carries the particles' weight in a periodic box.

#include "couplingState.h"
#include "couplingStep/meanPressureGradient.h"
#include "support/boxMesh.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"

#include "IStringStream.H"
#include "volFields.H"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

/// One particle in the fluid, a quarter of one and one outside of it, in a box of 1 m3 that repeats along gravity: the gradient is
/// the weight less the buoyancy of 1.25 of them, (2500 - 1000) 1.25 V_p g. With the mass of the others the fluid would carry
/// particles that do not hold on to it, and be driven upwards.
TEST(MeanPressureGradient, CarriesWhatIsInTheFluid)
{
    TemporaryCase temporaryCase;
    const auto mesh = boxMesh(temporaryCase.time(), {0, 0, 0}, {1, 1, 1}, {2, 2, 2});
    readFromCase<Foam::fvSchemes>(*mesh);
    const Foam::dictionary properties(
        Foam::IStringStream("meanPressureGradient balanceWeight; forceModels (Archimedes);")());
    const FluidProperties water{1000, 1e-3, {0, 0, -9.81}};
    constexpr double radius = 0.05;
    FakeEngine engine(1e-3);
    for (const int id : {1, 2, 3})
    {
        engine.addParticle(id, {0.5, 0.5, 0.2 * id}, radius, 2500);
    }
    engine.particles().state[1].fluid.submergedFraction = 0.25;
    engine.particles().state[2].fluid.submergedFraction = 0;

    MeanPressureGradient mean(properties, *mesh, {Vector3d::Zero(), Vector3d::UnitZ()}, water, ModelType::A, true);
    RankTotals totals;
    mean.addTo(engine.particles(), totals);
    totals.reduce();
    const Foam::volScalarField p(Foam::IOobject("p", temporaryCase.time().timeName(), *mesh), *mesh,
        Foam::dimensionedScalar(Foam::sqr(Foam::dimVelocity), Foam::Zero));
    const Foam::tmp<Foam::volVectorField> gradient = mean.gradient(p);
    EXPECT_NEAR(gradient()[0].z(), -1.5 * 1.25 * sphereVolume(radius) * 9.81, 1e-9);
}

} // namespace clepsydra::tests
