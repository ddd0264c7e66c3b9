#pragma once

#include "couplingStep/clippedVoidFraction.h"
#include "couplingStep/particleMapping.h"
#include "couplingStep/pressureOnParticles.h"
#include "couplingStep/semiImplicitSource.h"
#include "couplingStep/torqueReaction.h"
#include "couplingStep/voidFractionRate.h"
#include "forces/anticipatedMotion.h"

#include "surfaceFields.H"

#include <memory>
#include <optional>

namespace clepsydra
{

/// Particles whose cells are known, and the motion that is anticipated for each over the next coupling step.
struct AnticipatedParticles : LocatedParticles
{
    /// In the order of the engine's view.
    std::vector<AnticipatedMotion> motions;
    /// Length of the next coupling step [s].
    double timeStep;
};

/// The fields that the particles give the fluid's equations. They last as long as the run, and some are part of
/// checkpoints.
struct ParticleFields
{
    ClippedVoidFraction voidFraction;
    PressureOnParticles pressure;
    VoidFractionRate rate;
    SemiImplicitSource momentum;
    /// Null where no force has a torque.
    std::unique_ptr<TorqueReaction> torque;
};

class SolvedStep;

/// The particles in the fluid's equations of one coupling step: model A of Anderson & Jackson, divided by the fluid's
/// density,
///
///     d(eps)/dt + div(eps U) = 0
///     d(eps U)/dt + div(eps U U) = -pressureFactor grad p + div(tau) + momentumSource
///
/// p is kinematic and without its hydrostatic part. In model B grad p has the factor 1, see ModelType. Where the mesh is
/// periodic, grad p includes MeanPressureGradient.
///
/// With U = HbyA - pressureFactor rAU grad p, continuity becomes the equation of the pressure
///
///     laplacian(pressureCoefficient, p) = explicitContinuity
///
/// in which the particles' response to U and p is implicit, see VoidFractionRate.
class ParticlesInFluid : public AnticipatedParticles
{
public:
    /// \param received  what the particles of this rank received in the coupling step that is solved
    /// \param couplingTimeStep  its length [s]
    ParticlesInFluid(AnticipatedParticles anticipated, ParticleFields& fields, ConservationCheck& conservation,
        const ExchangedMomentum& received, double fluidDensity, double couplingTimeStep);
    ParticlesInFluid(const ParticlesInFluid&) = delete;
    ParticlesInFluid& operator=(const ParticlesInFluid&) = delete;

    const Foam::volScalarField& voidFraction() const
    {
        return fields_.voidFraction();
    }

    /// The void fraction on faces.
    const Foam::surfaceScalarField& voidFractionf() const
    {
        return voidFractionf_;
    }

    /// The particles' source in the momentum equation [m/s2 times volume], see SemiImplicitSource and TorqueReaction.
    Foam::tmp<Foam::fvVectorMatrix> momentumSource(Foam::volVectorField& U) const
    {
        return fields_.torque ? fields_.momentum.source(U) + fields_.torque->source() : fields_.momentum.source(U);
    }

    /// Factor of grad p in the momentum equation, see PressureOnParticles.
    const Foam::volScalarField& pressureFactor() const
    {
        return fields_.pressure.factor();
    }

    /// grad p [m/s2].
    Foam::tmp<Foam::volVectorField> pressureGradient(const Foam::volScalarField& p) const
    {
        return fields_.pressure.mean().gradient(p);
    }

    /// The part of the pressure term that acts on the particles [m/s2], see PressureOnParticles.
    Foam::tmp<Foam::volVectorField> sourceOfPressure(const Foam::volScalarField& p) const
    {
        return fields_.pressure.source(voidFraction(), p);
    }

    /// Subtracts the part of the mean pressure gradient along periodic directions from the flux of U without the
    /// pressure's part.
    /// \param rAUf  coefficient of grad p in U, on faces [s]
    void addMeanPressureGradient(Foam::surfaceScalarField& phiHbyA, const Foam::surfaceScalarField& rAUf) const;

    /// Makes continuity solvable where p is fixed nowhere: distributes the volume imbalance of a closed tank over its
    /// cells, see VoidFractionRate::spreadImbalance(). Collective.
    /// \param outflow  of fluid through the boundary of this rank without a correction of p [m3/s]
    void spreadImbalance(double outflow);

    /// The same where nothing can pass the boundary of any rank. Local.
    void spreadImbalance();

    /// \param rAUf  coefficient of grad p in U, on faces [s]
    Foam::tmp<Foam::surfaceScalarField> pressureCoefficient(const Foam::surfaceScalarField& rAUf) const;

    /// \param phiHbyA  flux of U without the part of p [m3/s]
    Foam::tmp<Foam::volScalarField> explicitContinuity(const Foam::surfaceScalarField& phiHbyA) const;

    /// Sets the flux that the pressure equation has given. The last one counts.
    /// \param phi  flux of U [m3/s]
    /// \param gradient  of p across the faces without its mean, times their areas
    void setFlux(const Foam::surfaceScalarField& phi, const Foam::surfaceScalarField& gradient);

    /// The void fraction whose change the continuity equation holds, see VoidFractionRate; oldTime() is that of the step
    /// before. \pre record() has been called
    const Foam::volScalarField& voidFractionInContinuity() const
    {
        return fields_.rate.integral();
    }

    /// Sets the heat of the coupling step on this rank, which the conservation check then records. A step without a
    /// temperature has none.
    void setHeat(const HeatOfStep& ofRank)
    {
        heat_ = ofRank;
    }

    /// Ends the solution of the equations: completes d(eps)/dt. The result has what the conservation check compares, of
    /// the equation that was solved.
    /// \param source  momentumSource() as it was in the last momentum equation
    /// \param alphaPhi  flux of fluid [m3/s]
    SolvedStep record(const Foam::fvVectorMatrix& source, const Foam::volVectorField& U, const Foam::volScalarField& p,
        const Foam::surfaceScalarField& alphaPhi);

private:
    friend class SolvedStep;

    ParticleFields& fields_;
    ConservationCheck& conservation_;
    const ExchangedMomentum received_;
    const double fluidDensity_;
    const double couplingTimeStep_;
    const Foam::surfaceScalarField voidFractionf_;
    /// Volume fraction whose flux follows U: the fluid, and the particles as far as they respond to it.
    const Foam::surfaceScalarField movingf_;
    /// Flux of the implicit part of d(eps)/dt [m3/s].
    Foam::tmp<Foam::surfaceScalarField> anticipatedFlux_;
    std::optional<HeatOfStep> heat_;
};

/// A coupling step whose fluid has been solved. Only ParticlesInFluid::record() makes one, and it refers to that object.
class SolvedStep
{
public:
    const AnticipatedParticles& particles() const
    {
        return particles_;
    }

    /// Compares what the fluid lost with what the particles received, heat and momentum, and checks continuity, when the
    /// totals are reduced. Collective.
    /// \param semiImplicit  of this rank, see ConservationCheck::recordMomentum()
    void checkConservation(const ExchangedMomentum& semiImplicit, RankTotals& totals) const;

private:
    friend class ParticlesInFluid;
    SolvedStep(const ParticlesInFluid& particles, const Foam::vector& sourceOfParticles,
        const Foam::tmp<Foam::volScalarField>& continuityError)
        : particles_(particles),
          sourceOfParticles_(sourceOfParticles),
          continuityError_(continuityError)
    {}

    const ParticlesInFluid& particles_;
    /// Integral of the particles' source over this rank's cells [m4/s2].
    const Foam::vector sourceOfParticles_;
    /// d(eps)/dt + div(eps U) [1/s].
    const Foam::tmp<Foam::volScalarField> continuityError_;
};

} // namespace clepsydra
