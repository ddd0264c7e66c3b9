// The viscous force on a particle is V_p div(tau) with the very stress that the fluid's equation has.

#include "couplingStep/viscousStress.h"

#include "couplingStep/couplingStep.h"
#include "support/boxMesh.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"

#include "fvcFlux.H"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

using namespace Foam;

namespace
{

/// A box of fluid, 1 m wide, in which only the gradients of pressure and stress act on particles.
auto boxWithViscousForce(TemporaryCase& folder, int cells)
{
    folder.writeDictionary("constant/couplingProperties",
        "fluid incompressible; modelType A; couplingTimeStep 0.01; voidFractionModel divided; smoothingModel off; "
        "forceModels (noDrag gradPForce viscForce noBuoyancy); momCoupleModels (explicitCouple); "
        "DEM { engine liggghts; script none; }");
    auto mesh = boxMesh(folder.time(), point::zero, point::one, {cells, cells, cells});
    readFromCase<fvSchemes>(*mesh);
    return mesh;
}

} // namespace

// U = (a x2, 0, 0) has div U = 2 a x, so div(tau) = mu (2 a + 2 a - 2/3 2 a) = 8/3 a mu along x, of which the Laplacian of
// U is 2 a mu only. Second differences have both exactly, away from the walls. A force without the transpose is off by a
// quarter; one that does not reach the particle is zero.
TEST(ViscousStress, OfAParticleIsThatOfTheEquationWhereDivergenceIsNotZero)
{
    constexpr double density = 1000;
    constexpr double viscosity = 0.7;
    constexpr double a = 3;
    constexpr int cells = 12;
    TemporaryCase folder;
    const auto mesh = boxWithViscousForce(folder, cells);
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
    engine.addParticle(1, Vector3d(0.52, 0.47, 0.55), 0.02);
    const FluidProperties fluid{density, viscosity, Vector3d::Zero()};
    const CouplingSettings settings(folder.time());
    PhaseTimers timers;
    FluidModels models(*mesh, settings, fluid, timers);
    CouplingStep interval(*mesh, settings, fluid, engine, &models, timers, false);
    interval.start(U, fvc::flux(U), p);
    const Vector3d atParticle = engine.particles().state[0].fluid.viscousStressDivergence;
    EXPECT_NEAR(atParticle.x(), 8.0 / 3 * a * viscosity, 1e-9);
    EXPECT_NEAR(atParticle.tail<2>().norm(), 0, 1e-9);

    const ViscousStress stress(*mesh, fluid);
    const volVectorField explicitly(stress.divergence(U));
    const volVectorField implicitly(stress.implicitDivergence(U) & U);
    EXPECT_GT(gMax(mag(explicitly.primitiveField())()), a * viscosity / density);
    EXPECT_LT(gMax(mag(explicitly.primitiveField() - implicitly.primitiveField())()), 1e-12);
}

// U = (a z, 0, 0) in a liquid with nu = nu_0 exp(k z): div(tau)/rho = a k nu along x, which central differences miss by
// (k dz)2/6 = .0012, beside walls by k dz/8 = .0104. With one viscosity in all cells it is zero, with the cells' own on the
// walls it is half of it there.
TEST(ViscousStress, OfAStratifiedLiquidHasTheGradientOfViscosity)
{
    constexpr double a = 3;
    constexpr int cells = 12;
    const FluidProperties fluid{1000, 0.7, {0, 0, -9.81}, {0, 0, 1, 0, 1.0}};
    TemporaryCase folder;
    const auto mesh = boxMesh(folder.time(), point::zero, point::one, {cells, cells, cells});
    readFromCase<fvSchemes>(*mesh);
    volVectorField U(IOobject("U", folder.time().timeName(), *mesh), *mesh,
        dimensionedVector("U", dimVelocity, vector::zero), "calculated");
    U.primitiveFieldRef().replace(vector::X, a * mesh->C().primitiveField().component(vector::Z));
    forAll (mesh->boundary(), patch)
    {
        U.boundaryFieldRef()[patch].replace(vector::X, a * mesh->boundary()[patch].Cf().component(vector::Z)());
    }
    const ViscousStress stress(*mesh, fluid);
    const volVectorField found(stress.divergence(U));
    forAll (found, cell)
    {
        const double z = mesh->C()[cell].z();
        const bool atWall = z < 1.0 / cells || z > 1 - 1.0 / cells;
        EXPECT_NEAR(found[cell].x() / (a * 7e-4 * std::exp(z)), 1, atWall ? 0.012 : 0.002) << z;
        EXPECT_NEAR(mag(found[cell] - vector(found[cell].x(), 0, 0)), 0, 1e-12);
    }
}

namespace
{

/// A turbulence model with an eddy viscosity that does not change.
class EddiesAsGiven : public FluidTurbulence
{
public:
    explicit EddiesAsGiven(const volScalarField& nut)
        : nut_(nut)
    {}

    void correct(const surfaceScalarField&) override
    {}

    const volScalarField& eddyViscosity() const override
    {
        return nut_;
    }

    tmp<volScalarField> k() const override
    {
        return tmp<volScalarField>();
    }

    tmp<volScalarField> dissipation() const override
    {
        return tmp<volScalarField>();
    }

private:
    const volScalarField& nut_;
};

} // namespace

// U = (a z, 0, 0) with an eddy viscosity nut = c z: div(tau)/rho = a c along x, exactly, for the fluid and for the particle,
// whatever the fluid's own uniform viscosity. A stress that leaves the eddy viscosity out is zero, one that takes it for
// uniform, too; one that has it in the fluid's equation only leaves the particle's force at zero.
TEST(ViscousStress, HasTheEddyViscosityInTheEquationAndOnAParticle)
{
    constexpr double density = 1000;
    constexpr double a = 3;
    constexpr double c = 0.02;
    constexpr int cells = 12;
    TemporaryCase folder;
    const auto mesh = boxWithViscousForce(folder, cells);
    volVectorField U(IOobject("U", folder.time().timeName(), *mesh), *mesh,
        dimensionedVector("U", dimVelocity, vector::zero), "fixedValue");
    volScalarField nut(IOobject("nut", folder.time().timeName(), *mesh), *mesh,
        dimensionedScalar("nut", dimViscosity, 0), "calculated");
    U.primitiveFieldRef().replace(vector::X, a * mesh->C().primitiveField().component(vector::Z));
    nut.primitiveFieldRef() = c * mesh->C().primitiveField().component(vector::Z);
    forAll (mesh->boundary(), patch)
    {
        const scalarField z(mesh->boundary()[patch].Cf().component(vector::Z));
        U.boundaryFieldRef()[patch].replace(vector::X, a * z);
        nut.boundaryFieldRef()[patch] = c * z;
    }
    const volScalarField p(IOobject("p", folder.time().timeName(), *mesh), *mesh,
        dimensionedScalar("p", dimPressure / dimDensity, 0), "zeroGradient");

    FakeEngine engine(1e-3, Vector3d::Zero());
    engine.addParticle(1, Vector3d(0.52, 0.47, 0.55), 0.02);
    const FluidProperties fluid{density, 0.7, Vector3d::Zero()};
    const CouplingSettings settings(folder.time());
    PhaseTimers timers;
    FluidModels models(*mesh, settings, fluid, timers);
    CouplingStep step(*mesh, settings, fluid, engine, &models, timers, false);
    const EddiesAsGiven turbulence(nut);
    const ViscousStress& stress = models.viscousStress;
    models.viscousStress.add(turbulence);
    const volVectorField explicitly(stress.divergence(U));
    const volVectorField implicitly(stress.implicitDivergence(U) & U);
    EXPECT_LT(gMax(mag(explicitly.primitiveField() - vector(a * c, 0, 0))()), 1e-12);
    EXPECT_LT(gMax(mag(implicitly.primitiveField() - vector(a * c, 0, 0))()), 1e-12);

    step.start(U, fvc::flux(U), p);
    const Vector3d atParticle = engine.particles().state[0].fluid.viscousStressDivergence;
    EXPECT_NEAR(atParticle.x(), density * a * c, 1e-9);
    EXPECT_NEAR(atParticle.tail<2>().norm(), 0, 1e-9);

    // The viscosity is the one that the field has now, and a stratified liquid has its own on top.
    nut *= 2;
    EXPECT_NEAR(stress.divergence(U)()[0].x(), 2 * a * c, 1e-12);
    const FluidProperties layered{density, 0.7, {0, 0, -9.81}, {0, 0, 1, 0, 1.0}};
    ViscousStress ofBoth(*mesh, layered);
    const vector withoutEddies = ofBoth.divergence(U)()[cells * cells * cells / 2];
    ofBoth.add(turbulence);
    EXPECT_GT(withoutEddies.x(), 7e-4);
    EXPECT_NEAR(ofBoth.divergence(U)()[cells * cells * cells / 2].x() - withoutEddies.x(), 2 * a * c, 1e-12);
}

} // namespace clepsydra::tests
