#include "couplingStep/meanPressureGradient.h"

#include "couplingState.h"
#include "forces/forceFamily.h"
#include "runTimeSelection.h"
#include "vectors.h"

#include "fvcGrad.H"
#include "surfaceFields.H"
#include "volFields.H"

#include <algorithm>
#include <sstream>

namespace clepsydra
{

using namespace Foam;

namespace
{

const word entryName("meanPressureGradient");
const ModelLines meanPressureGradients(
    "meanPressureGradient", {{"none", "none along the periodic directions"},
                                {"balanceWeight", "that which carries the particles' weight less their buoyancy"}});

/// Whether a direction has a component along a periodic one.
bool actsAlong(const PeriodicBox& periodic, const Vector3d& direction)
{
    return direction.cwiseProduct(periodic.length).cwiseAbs().maxCoeff()
           > 1e-9 * direction.norm() * periodic.length.maxCoeff();
}

bool hasBuoyancy(const dictionary& couplingProperties)
{
    const wordList models = couplingProperties.getOrDefault<wordList>("forceModels", wordList());
    const wordList ofFamily = ForceLines::namesOf(ForceFamily::buoyancy);
    return std::any_of(models.begin(), models.end(), [&](const word& name) { return ofFamily.found(name); });
}

} // namespace

MeanPressureGradient::MeanPressureGradient(const dictionary& couplingProperties, const fvMesh& mesh,
    const PeriodicBox& periodic, const FluidProperties& fluid, ModelType modelType, bool actsOnParticles)
    : mesh_(mesh),
      periodic_(periodic),
      fluid_(fluid),
      meshVolume_(gSum(mesh.V().field())),
      onFluidOnly_(modelType == ModelType::A && !actsOnParticles),
      hasBuoyancy_(hasBuoyancy(couplingProperties))
{
    if (fluid_.stratification.isThere() && periodic_.isPeriodic() && actsAlong(periodic_, fluid_.gravity))
    {
        FatalIOErrorInFunction(couplingProperties)
            << "The mesh has cyclic patches along gravity, " << toFoam(fluid_.gravity)
            << " m/s2, and constant/transportProperties has a stratified liquid; allowed: one of them, because layers "
            << "do not repeat themselves" << exit(FatalIOError);
    }
    if (!couplingProperties.found(entryName))
    {
        if (periodic_.isPeriodic() && actsAlong(periodic_, fluid_.gravity))
        {
            FatalIOErrorInFunction(couplingProperties)
                << "Entry '" << entryName << "' is missing, but gravity in constant/g, " << toFoam(fluid_.gravity)
                << " m/s2, acts along a direction in which the mesh has cyclic patches, so that nothing carries the "
                << "particles; allowed: balanceWeight, where the mean pressure gradient carries them, a vector [Pa/m], "
                << "or none, where particles and fluid fall ever faster" << exit(FatalIOError);
        }
        return;
    }
    const ITstream& tokens = couplingProperties.lookup(entryName);
    if (tokens.empty() || !tokens.first().isPunctuation())
    {
        balancesWeight_ =
            selectedModel(couplingProperties, entryName, meanPressureGradients.names()) == "balanceWeight";
    }
    else
    {
        gradient_ = couplingProperties.get<vector>(entryName);
    }
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
        if (!periodic_.isPeriodic(axis) && gradient_[static_cast<direction>(axis)] != 0)
        {
            FatalIOErrorInFunction(couplingProperties)
                << "Entry '" << entryName << "' is " << gradient_ << ", but the mesh has no cyclic patches along "
                << "xyz"[axis] << "; allowed: 0 there, because p itself has the gradient" << exit(FatalIOError);
        }
    }
    if (balancesWeight_ && !(periodic_.isPeriodic() && actsAlong(periodic_, fluid_.gravity)))
    {
        FatalIOErrorInFunction(couplingProperties)
            << "Entry '" << entryName << "' is balanceWeight, but gravity, " << toFoam(fluid_.gravity)
            << " m/s2, acts along no direction in which the mesh has cyclic patches; allowed: none, or no such entry"
            << exit(FatalIOError);
    }
}

void MeanPressureGradient::addTo(const ParticlesView& particles, RankTotals& totals)
{
    if (!balancesWeight_)
    {
        return;
    }
    Vector3d weight = Vector3d::Zero();
    double solidVolume = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const double displaced = volumeInFluid(particles, particle);
        const double massInFluid = particles.state[particle].fluid.submergedFraction * particles.mass[particle];
        weight += (massInFluid - (hasBuoyancy_ ? fluid_.density * displaced : 0)) * fluid_.gravity;
        solidVolume += displaced;
    }
    RankNumbers ofRank;
    ofRank.addVector(weight);
    ofRank.sums.push_back(solidVolume);
    totals.add(ofRank, [this](const RankNumbers& all) {
        const double volume = meshVolume_ - (onFluidOnly_ ? all.sums[3] : 0);
        for (Eigen::Index axis = 0; axis < 3; ++axis)
        {
            gradient_[static_cast<direction>(axis)] =
                periodic_.isPeriodic(axis) ? all.sums[static_cast<std::size_t>(axis)] / volume : 0;
        }
    });
}

tmp<volVectorField> MeanPressureGradient::gradient(const volScalarField& p) const
{
    return isActive() ? fvc::grad(p) + value() : fvc::grad(p);
}

dimensionedVector MeanPressureGradient::value() const
{
    return {entryName, dimAcceleration, gradient_ / fluid_.density};
}

tmp<surfaceScalarField> MeanPressureGradient::throughFaces() const
{
    tmp<surfaceScalarField> through = value() & mesh_.Sf();
    for (fvsPatchScalarField& patch : through.ref().boundaryFieldRef())
    {
        if (!patch.coupled())
        {
            patch == 0;
        }
    }
    return through;
}

std::string MeanPressureGradient::description() const
{
    std::ostringstream text;
    if (balancesWeight_)
    {
        text << "balanceWeight: it carries the particles' weight less their buoyancy";
    }
    else
    {
        text << '(' << gradient_.x() << ' ' << gradient_.y() << ' ' << gradient_.z() << ") Pa/m";
    }
    return text.str();
}

} // namespace clepsydra
