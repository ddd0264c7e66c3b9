#pragma once

#include "conservation/conservationCheck.h"
#include "couplingStep/meanPressureGradient.h"
#include "couplingStep/rows.h"
#include "engine/particles.h"
#include "forces/modelType.h"

#include "volFields.H"

namespace clepsydra
{

/// How particles and fluid share the pressure gradient, and the check that the force on the particles is the one whose
/// reaction is in the fluid's equation.
class PressureOnParticles
{
public:
    /// \param isForce  whether a force of the particles is that of the pressure gradient
    /// \param mean  part of all gradients of the pressure here
    PressureOnParticles(const Foam::fvMesh& mesh, ModelType modelType, bool isForce, double fluidDensity,
        const MeanPressureGradient& mean, ConservationCheck& conservation);

    /// Whether the pressure gradient acts on the particles: in model A, unless it is left out.
    bool acts() const
    {
        return acts_;
    }

    const MeanPressureGradient& mean() const
    {
        return mean_;
    }

    /// Factor of grad p in the fluid's equation. In model A it is eps plus the part of the particles' pressure force
    /// that drag will transfer to the fluid in the next coupling step; in model B it is 1.
    const Foam::volScalarField& factor() const
    {
        return factor_;
    }

    /// \param velocityResponse  volume of particles that follows the fluid's response to the pressure, per
    /// volume of each cell
    void updateFactor(const Foam::volScalarField& voidFraction, const ConstRow& velocityResponse);

    /// The part of the pressure term in the fluid's equation that acts on the particles [m/s2], see factor().
    Foam::tmp<Foam::volVectorField> source(
        const Foam::volScalarField& voidFraction, const Foam::volScalarField& p) const;

    /// Gradient of the pressure that acts on the particles [Pa/m], 3 x cells, not smoothed; zero in model B. Its force on
    /// the solid fraction is what check() compares.
    Eigen::MatrixXd gradient(const Foam::volScalarField& p, const Foam::scalarField& solidFraction);

    /// Sums up the magnitudes of the forces that the gradient at the particles amounts to. Local.
    void sampledAt(const ParticlesView& particles);

    /// Compares the force of the pressure gradient on the particles with its reaction in the fluid's equation when the
    /// totals are reduced. Local.
    /// \param onParticles  mean since sampledAt(), of this rank's particles [N]
    void check(const Vector3d& onParticles, RankTotals& totals) const;

private:
    const ModelType modelType_;
    const bool acts_;
    const double fluidDensity_;
    const MeanPressureGradient& mean_;
    ConservationCheck& conservation_;
    Foam::volScalarField factor_;
    /// Force whose reaction to the particles is in the fluid's equation, and the sum of the magnitudes of the forces on
    /// the particles in the next coupling step, of this rank [N]; model A only.
    Foam::vector forceInFluid_ = Foam::vector::zero;
    double sumOfMagnitudes_ = 0;
};

} // namespace clepsydra
