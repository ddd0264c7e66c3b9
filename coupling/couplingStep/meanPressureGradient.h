#pragma once

#include "engine/periodicBox.h"
#include "forces/fluidProperties.h"
#include "forces/modelType.h"
#include "rankTotals.h"

#include "dimensionedVector.H"
#include "fvMesh.H"
#include "surfaceFieldsFwd.H"
#include "volFieldsFwd.H"

#include <string>

namespace clepsydra
{

/// Mean of the pressure gradient along the directions in which the mesh is periodic, where the field p has the mean 0:
/// p is periodic there, and the pressure is p plus the mean gradient times the position. It acts wherever the gradient
/// of p does, on the fluid and on the particles.
///
///     meanPressureGradient  balanceWeight;    // or none, or a vector [Pa/m]
///
/// With `balanceWeight` it carries the weight of the particles, each times its submerged fraction, less their buoyancy,
/// so that particles and fluid together keep their momentum, as in a suspension that settles in a vessel with a bottom.
/// FatalIOError where the entry is missing and gravity acts along a periodic direction: nothing would carry the weight,
/// and particles and fluid would fall ever faster.
class MeanPressureGradient
{
public:
    /// \param actsOnParticles  false where the particles do not feel the pressure gradient and the fluid has only its own
    /// part of it
    MeanPressureGradient(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh,
        const PeriodicBox& periodic, const FluidProperties& fluid, ModelType modelType, bool actsOnParticles);

    /// False where it is always zero.
    bool isActive() const
    {
        return balancesWeight_ || gradient_ != Foam::vector::zero;
    }

    /// Adds what it depends on of the particles; it is that of these particles when the totals have been reduced. Local.
    void addTo(const ParticlesView& particles, RankTotals& totals);

    /// Gradient of the kinematic pressure, that of its periodic part p and the mean [m/s2].
    Foam::tmp<Foam::volVectorField> gradient(const Foam::volScalarField& p) const;

    /// Component of the mean along the normal of each face times the face's area; zero where the mesh ends [m3/s2].
    Foam::tmp<Foam::surfaceScalarField> throughFaces() const;

    /// One line for the report at the start of the log.
    std::string description() const;

private:
    /// Divided by the fluid's density, as p is [m/s2].
    Foam::dimensionedVector value() const;

    const Foam::fvMesh& mesh_;
    const PeriodicBox periodic_;
    const FluidProperties fluid_;
    /// Of the cells of all ranks [m3].
    const double meshVolume_;
    /// Whether the fluid has the gradient in its own volume only, without that of the particles.
    const bool onFluidOnly_;
    bool balancesWeight_ = false;
    bool hasBuoyancy_ = false;
    Foam::vector gradient_ = Foam::vector::zero; // [Pa/m]
};

} // namespace clepsydra
