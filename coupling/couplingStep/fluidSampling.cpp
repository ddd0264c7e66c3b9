#include "couplingStep/fluidSampling.h"

#include "couplingStep/checkpointedState.h"
#include "couplingStep/couplingField.h"
#include "couplingStep/particlesInFluid.h"
#include "vectors.h"

#include "fvcCurl.H"
#include "fvcGrad.H"

#include <cmath>

namespace clepsydra
{

using namespace Foam;

FluidSampling::FluidSampling(const fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
    const ForceNeeds& needs, const SmoothingModel& smoothing, const ViscousStress& viscousStress)
    : fluid_(fluid),
      needs_(needs),
      coarseGraining_(settings.coarseGraining()),
      selfInducedVelocityCorrection_(settings, fluid, smoothing),
      turbulentDispersion_(settings, fluid),
      viscousStress_(viscousStress)
{
    if (needs_.acceleration)
    {
        acceleration_.reset(
            new volVectorField(couplingField<vector>("fluidAcceleration", mesh, dimAcceleration, vector::zero)));
        centres_ = mesh.cellCentres();
    }
    if (selfInducedVelocityCorrection_.isActive())
    {
        resistance_.reset(
            new volScalarField(couplingField<scalar>("resistanceOfParticles", mesh, dimDensity / dimTime, 0)));
    }
}

void FluidSampling::updateAcceleration(const volVectorField& U, double couplingTimeStep)
{
    if (needs_.acceleration)
    {
        const tmp<volTensorField> gradient = fvc::grad(U);
        acceleration_->primitiveFieldRef() = (U.primitiveField() - U.oldTime().primitiveField()) / couplingTimeStep
                                             + (U.primitiveField() & gradient().primitiveField());
        if (!meshVelocity_.empty())
        {
            // The change in time is that in a cell, which moves.
            acceleration_->primitiveFieldRef() -= meshVelocity_ & gradient().primitiveField();
        }
        acceleration_->correctBoundaryConditions();
    }
}

void FluidSampling::meshMoved()
{
    if (needs_.acceleration)
    {
        const fvMesh& mesh = acceleration_->mesh();
        meshVelocity_ = (mesh.cellCentres() - centres_) / mesh.time().deltaTValue();
        centres_ = mesh.cellCentres();
    }
}

void FluidSampling::setResistance(const ConstRow& resistanceTime, double couplingTimeStep)
{
    columns(resistance_->primitiveFieldRef()) = resistanceTime / couplingTimeStep;
}

void FluidSampling::setSizes(const ConstRow& solidFraction, const ConstRow& volumePerDiameter)
{
    sizes_.resize(Eigen::NoChange, solidFraction.size());
    sizes_ << solidFraction, volumePerDiameter;
}

FluidAtParticles FluidSampling::sample(const AnticipatedParticles& particles, const volVectorField& U,
    const volScalarField& voidFraction, const Eigen::MatrixXd& pressureGradient) const
{
    SampledFields fields;
    fields.add(columns(voidFraction.primitiveField()),
        [](const ParticlesView& view, Eigen::Index particle, const double* value) {
            FluidAtParticle& fluid = view.state[particle].fluid;
            fluid.voidFraction = *value;
            fluid.logVoidFraction = std::log(*value);
        });
    fields.add(columns(U.primitiveField()), [](const ParticlesView& view, Eigen::Index particle, const double* value) {
        FluidAtParticle& fluid = view.state[particle].fluid;
        fluid.velocity = Eigen::Map<const Vector3d>(value);
        fluid.velocityInCells = fluid.velocity;
    });
    if (turbulentDispersion_.isActive())
    {
        const FluidTurbulence& turbulence = *viscousStress_.turbulence();
        Eigen::Matrix2Xd eddies(2, U.size());
        eddies << columns(turbulence.k()().primitiveField()), columns(turbulence.dissipation()().primitiveField());
        fields.add(eddies,
            [this, time = particles.timeStep](const ParticlesView& view, Eigen::Index particle, const double* value) {
                view.state[particle].fluid.velocity +=
                    turbulentDispersion_.velocity(view, particle, value[0], value[1], time);
            });
    }
    fields.add(pressureGradient, &FluidAtParticle::pressureGradient);
    if (needs_.viscousStress)
    {
        fields.add(fluid_.density * columns(viscousStress_.divergence(U)().primitiveField()),
            &FluidAtParticle::viscousStressDivergence);
    }
    if (needs_.acceleration)
    {
        fields.add(columns(acceleration_->primitiveField()), &FluidAtParticle::acceleration);
    }
    if (needs_.vorticity)
    {
        fields.add(columns(fvc::curl(U)().primitiveField()), &FluidAtParticle::vorticity);
    }
    if (needs_.sauterMeanDiameter)
    {
        fields.add(sizes_, [this](const ParticlesView& view, Eigen::Index particle, const double* value) {
            // A particle that has no volume in the fluid yet, and no others around it, has only its own diameter.
            view.state[particle].fluid.sauterMeanDiameter =
                value[1] > 0 ? value[0] / value[1] : 2 * view.radius[particle] / coarseGraining_;
        });
    }
    if (resistance_)
    {
        Eigen::Matrix2Xd surroundings(2, U.size());
        surroundings << columns(resistance_->primitiveField()),
            columns(U.mesh().V().field()).array().pow(1.0 / 3.0).matrix();
        fields.add(surroundings, [this](const ParticlesView& view, Eigen::Index particle, const double* value) {
            view.state[particle].fluid.selfMobility = selfInducedVelocityCorrection_.selfMobility(view.state[particle],
                view.position.col(particle), view.radius[particle], view.velocity.col(particle), value[0], value[1]);
        });
    }
    return fields.sampleAt(particles);
}

void FluidSampling::store(const ParticlesView& particles) const
{
    auto stored = checkpointedState::of(particles);
    for (Eigen::Index particle = 0; resistance_ && particle < particles.size(); ++particle)
    {
        checkpointedState::drag.of(stored).col(particle) = particles.state[particle].drag;
        checkpointedState::selfMobility.of(stored)(0, particle) = particles.state[particle].fluid.selfMobility;
    }
}

void FluidSampling::restore(const ParticlesView& particles) const
{
    const auto stored = checkpointedState::of(particles);
    for (Eigen::Index particle = 0; resistance_ && particle < particles.size(); ++particle)
    {
        particles.state[particle].drag = checkpointedState::drag.of(stored).col(particle);
        particles.state[particle].fluid.selfMobility = checkpointedState::selfMobility.of(stored)(0, particle);
    }
}

} // namespace clepsydra
