#include "couplingStep/torqueReaction.h"

#include "couplingStep/couplingField.h"
#include "vectors.h"

#include "fvcSurfaceIntegrate.H"
#include "surfaceInterpolationScheme.H"

namespace clepsydra
{

using namespace Foam;

tmp<volVectorField> forceOfCouples(const volVectorField& couplePerVolume)
{
    const fvMesh& mesh = couplePerVolume.mesh();
    // Between two cells: the weight of each cell is that which linear interpolation gives to the other one.
    const tmp<surfaceScalarField> weights = 1 - mesh.weights();
    surfaceVectorField onFaces(surfaceInterpolationScheme<vector>::interpolate(couplePerVolume, weights));
    for (fvsPatchVectorField& onPatch : onFaces.boundaryFieldRef())
    {
        if (!onPatch.coupled())
        {
            onPatch = vector::zero;
        }
    }
    return 0.5 * fvc::surfaceIntegrate(mesh.Sf() ^ onFaces);
}

TorqueReaction::TorqueReaction(const fvMesh& mesh, double fluidDensity)
    : fluidDensity_(fluidDensity),
      couple_(temporaryField<volVectorField>(
          "coupleOfParticles", mesh, sqr(dimVelocity), vector::zero, zeroGradientFvPatchVectorField::typeName)),
      source_(temporaryField<volVectorField>("torqueReaction", mesh, dimAcceleration))
{}

void TorqueReaction::update(
    const LocatedParticles& particles, const Eigen::Matrix3Xd& angularImpulses, double couplingTimeStep)
{
    Eigen::MatrixXd densities = particles.densitiesOf(angularImpulses);
    particles.smooth(densities);
    columns(couple_.primitiveFieldRef()) = -1 / (fluidDensity_ * couplingTimeStep) * densities;
    couple_.correctBoundaryConditions();
    source_ = forceOfCouples(couple_);
}

} // namespace clepsydra
