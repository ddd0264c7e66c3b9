// The viscous force on a bead is V_p div(tau) with the very stress that the fluid's equation has.

#include "interval/viscousStress.h"

#include "interval/couplingInterval.h"
#include "support/boxMesh.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

using namespace Foam;

// U = (a x2, 0, 0) has div U = 2 a x, so div(tau) = mu (2 a + 2 a - 2/3 2 a) = 8/3 a mu along x, of which the Laplacian of
// U is 2 a mu only. Second differences have both exactly, away from the walls. A force without the transpose is off by a
// quarter; one that does not reach the bead is zero.
TEST(ViscousStress, OfABeadIsThatOfTheEquationWhereDivergenceIsNotZero)
{
    constexpr double density = 1000;
    constexpr double viscosity = 0.7;
    constexpr double a = 3;
    constexpr int cells = 12;
    TemporaryCase folder;
    folder.writeDictionary("constant/couplingProperties",
        "fluid incompressible; modelType A; couplingInterval 0.01; voidFractionModel divided; smoothingModel off; "
        "forceModels (gradPForce viscForce); momCoupleModels (explicitCouple); "
        "DEM { engine liggghts; script none; }");
    const auto mesh = boxMesh(folder.time(), point::zero, point::one, {cells, cells, cells});
    readFromCase<fvSchemes>(*mesh);
    volVectorField U(IOobject("U", folder.time().timeName(), *mesh), *mesh,
        dimensionedVector("U", dimVelocity, vector::zero), "zeroGradient");
    forAll (U, cell)
    {
        U[cell].x() = a * sqr(mesh->C()[cell].x());
    }
    U.correctBoundaryConditions();
    const volScalarField p(IOobject("p", folder.time().timeName(), *mesh), *mesh,
        dimensionedScalar("p", dimPressure / dimDensity, 0), "zeroGradient");

    FakeEngine engine(1e-3, Vector3d::Zero());
    engine.addBead(1, Vector3d(0.52, 0.47, 0.55), 0.02);
    const FluidProperties fluid{density, viscosity, Vector3d::Zero()};
    const CouplingSettings settings(folder.time());
    PhaseTimers timers;
    FluidModels models(*mesh, settings, fluid, timers);
    CouplingInterval interval(*mesh, settings, fluid, engine, &models, timers, false);
    interval.start(U, p);
    const Vector3d atBead = engine.beads().state[0].fluid.viscousStressDivergence;
    EXPECT_NEAR(atBead.x(), 8.0 / 3 * a * viscosity, 1e-9);
    EXPECT_NEAR(atBead.tail<2>().norm(), 0, 1e-9);

    const dimensionedScalar nu("nu", dimViscosity, viscosity / density);
    const volVectorField explicitly(divergenceOfViscousStress(nu, U));
    const volVectorField implicitly(implicitDivergenceOfViscousStress(nu, U) & U);
    EXPECT_GT(gMax(mag(explicitly.primitiveField())()), a * viscosity / density);
    EXPECT_LT(gMax(mag(explicitly.primitiveField() - implicitly.primitiveField())()), 1e-12);
}

} // namespace clepsydra::tests
