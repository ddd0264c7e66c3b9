// The reaction of the fluid's torque on particles is a force density f = 1/2 curl(m) in the fluid. What the particles
// receive as angular momentum the fluid must lose: its forces sum up to nothing and their moments to the couples.

#include "couplingStep/torqueReaction.h"

#include "support/boxMesh.h"
#include "support/temporaryCase.h"
#include "vectors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clepsydra::tests
{

namespace
{

using namespace Foam;

/// A couple per volume that has another direction and size in each cell, zero in those at the boundary.
volVectorField couplesAwayFromWalls(const fvMesh& mesh)
{
    volVectorField couple(IOobject("couple", mesh.time().timeName(), mesh), mesh,
        dimensionedVector("couple", sqr(dimVelocity), vector::zero), "zeroGradient");
    forAll (couple, cell)
    {
        couple[cell] = vector(std::sin(1.3 * cell), std::cos(2.1 * cell), std::sin(0.7 * cell + 1));
    }
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        for (const label cell : patch.faceCells())
        {
            couple[cell] = vector::zero;
        }
    }
    couple.correctBoundaryConditions();
    return couple;
}

/// Cells that grow along each axis by another factor, or equal ones.
std::unique_ptr<fvMesh> meshOf(const Time& time, bool graded)
{
    auto mesh = boxMesh(time, point::zero, point(0.6, 1, 1.4), {6, 7, 8});
    if (graded)
    {
        pointField points(mesh->points());
        for (point& at : points)
        {
            at = point(std::pow(at.x(), 1.5), std::pow(at.y(), 0.6), 1.4 * std::pow(at.z() / 1.4, 2.0));
        }
        mesh->movePoints(points);
        mesh->moving(false);
    }
    return mesh;
}

class CellsOf : public testing::TestWithParam<bool>
{};

vector integral(const fvMesh& mesh, const vectorField& perVolume)
{
    return sum(mesh.V().field() * perVolume);
}

} // namespace

/// Also on cells of unequal width, where linear interpolation onto the faces would lose some per cent of the couple.
TEST_P(CellsOf, ForcesSumUpToNothingAndTheirMomentsToTheCouples)
{
    TemporaryCase folder;
    const auto mesh = meshOf(folder.time(), GetParam());
    const volVectorField couple(couplesAwayFromWalls(*mesh));
    const volVectorField force(forceOfCouples(couple));

    const scalar magnitudes = sum(mesh->V().field() * mag(force.primitiveField())());
    EXPECT_LT(mag(integral(*mesh, force.primitiveField())), 1e-13 * magnitudes);
    EXPECT_GT(magnitudes, 1);
    const vector moment = integral(*mesh, mesh->C().primitiveField() ^ force.primitiveField());
    const vector couples = integral(*mesh, couple.primitiveField());
    EXPECT_LT(mag(moment - couples), 1e-12 * magnitudes);
    EXPECT_GT(mag(couples), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(EqualAndGraded, CellsOf, testing::Bool(),
    [](const testing::TestParamInfo<bool>& graded) { return graded.param ? "graded" : "equal"; });

/// m = (0, 0, x^2/2) in the middle of the box has 1/2 curl(m) = (0, -x/2, 0): direction, sign and factor. Without the half it
/// would be twice that.
TEST(TorqueReaction, IsHalfTheCurl)
{
    TemporaryCase folder;
    const auto mesh = boxMesh(folder.time(), point::zero, point::one, {10, 10, 10});
    volVectorField couple(IOobject("couple", folder.time().timeName(), *mesh), *mesh,
        dimensionedVector("couple", sqr(dimVelocity), vector::zero), "zeroGradient");
    forAll (couple, cell)
    {
        couple[cell].z() = 0.5 * sqr(mesh->C()[cell].x());
    }
    const volVectorField force(forceOfCouples(couple));
    const label middle = mesh->findCell(point(0.55, 0.55, 0.55));
    ASSERT_GE(middle, 0);
    EXPECT_NEAR(force[middle].y(), -0.5 * 0.55, 1e-12);
    EXPECT_NEAR(force[middle].x(), 0, 1e-12);
    EXPECT_NEAR(force[middle].z(), 0, 1e-12);
}

/// In a cell at a wall a quarter of the couple along the wall is lost, and the forces still sum up to nothing.
TEST(TorqueReaction, LosesAQuarterOfTheCoupleAtAWall)
{
    TemporaryCase folder;
    const auto mesh = boxMesh(folder.time(), point::zero, point(1, 1, 1), {5, 5, 5});
    volVectorField couple(IOobject("couple", folder.time().timeName(), *mesh), *mesh,
        dimensionedVector("couple", sqr(dimVelocity), vector::zero), "zeroGradient");
    const label atFloor = mesh->findCell(point(0.5, 0.5, 0.1));
    couple[atFloor] = vector(3, 0, 5);
    const volVectorField force(forceOfCouples(couple));
    EXPECT_LT(mag(integral(*mesh, force.primitiveField())), 1e-14);
    const vector moment = integral(*mesh, mesh->C().primitiveField() ^ force.primitiveField());
    EXPECT_LT(mag(moment - mesh->V()[atFloor] * vector(0.75 * 3, 0, 5)), 1e-14);
}

} // namespace clepsydra::tests
