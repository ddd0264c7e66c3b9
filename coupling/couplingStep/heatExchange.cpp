#include "couplingStep/heatExchange.h"

#include "closures/heatExchange.h"
#include "closures/parcelScaling.h"
#include "couplingState.h"
#include "couplingStep/couplingField.h"
#include "vectors.h"

#include "fvmSup.H"

namespace clepsydra
{

using namespace Foam;

HeatExchange::HeatExchange(const fvMesh& mesh, const Energy& energy, const FluidProperties& fluid)
    : fluid_(fluid),
      thermal_(energy.fluid),
      coarseGraining_(energy.coarseGraining),
      capacityPerVolume_(fluid.density * energy.fluid.specificHeat),
      model_(HeatTransferModel::New(energy.dict)),
      coefficient_(temporaryField<volScalarField>("heatCoefficient", mesh, dimless / dimTime)),
      particleSource_(temporaryField<volScalarField>("heatOfParticles", mesh, dimTemperature / dimTime)),
      given_(couplingField<scalar>("semiImplicitHeat", mesh, dimTemperature, 0)),
      deferred_(couplingField<scalar>("deferredHeat", mesh, dimTemperature, 0))
{}

double HeatExchange::conductance(const ParticlesView& particles, Eigen::Index particle) const
{
    const FluidAtParticle& at = particles.state[particle].fluid;
    const double diameter = 2 * particles.radius[particle] / coarseGraining_;
    const double viscosity = fluid_.viscosityAt(particles.position.col(particle), diameter);
    const double slip = (at.velocity - particles.velocity.col(particle)).norm();
    const double nusselt = model_->nusselt(fluid_.density * slip * diameter / viscosity,
        viscosity * thermal_.specificHeat / thermal_.conductivity, at.voidFraction);
    return closures::particlesPerParcel(coarseGraining_) * at.submergedFraction
           * closures::heatConductance(nusselt, thermal_.conductivity, diameter);
}

void HeatExchange::update(const LocatedParticles& located, const ParticlesView& particles,
    const TemperaturesView& temperatures, double timeStep)
{
    timeStep_ = timeStep;
    coefficients_.resize(particles.size());
    Eigen::MatrixXd amounts(2, particles.size());
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        coefficients_[particle] =
            closures::heatTaken(temperatures.heatCapacity[particle], conductance(particles, particle), timeStep);
        amounts.col(particle) << coefficients_[particle], coefficients_[particle] * temperatures.temperature[particle];
    }
    Eigen::MatrixXd densities = located.densitiesOf(amounts);
    densities.row(1) -= capacityPerVolume_ * columns(deferred_.primitiveField());
    located.smooth(densities);
    const double perCapacityAndTime = 1 / (capacityPerVolume_ * timeStep);
    columns(coefficient_.primitiveFieldRef()) = perCapacityAndTime * densities.row(0);
    columns(particleSource_.primitiveFieldRef()) =
        perCapacityAndTime * densities.row(1) + columns(given_.primitiveField()) / timeStep;
}

tmp<fvScalarMatrix> HeatExchange::source(volScalarField& T) const
{
    return particleSource_ - fvm::Sp(coefficient_, T);
}

void HeatExchange::meshMoved()
{
    const fvMesh& mesh = given_.mesh();
    const scalarField ratio(mesh.V0().field() / mesh.V().field());
    for (volScalarField* const held : {&given_, &deferred_})
    {
        held->primitiveFieldRef() *= ratio;
        held->correctBoundaryConditions();
    }
}

double HeatExchange::pending() const
{
    return capacityPerVolume_ * sum(given_.mesh().V().field() * (given_.primitiveField() - deferred_.primitiveField()));
}

HeatOfStep HeatExchange::exchange(
    const LocatedParticles& located, TemperaturesView temperatures, const volScalarField& T)
{
    HeatOfStep heat;
    heat.pendingBefore = pending();
    const scalarField& volumes = T.mesh().V().field();
    const scalarField sourceInCells(
        particleSource_.primitiveField() - coefficient_.primitiveField() * T.primitiveField());
    heat.fluidLost = -timeStep_ * capacityPerVolume_ * sum(volumes * sourceInCells);
    heat.magnitudes =
        timeStep_ * capacityPerVolume_ * sum(volumes * mag(coefficient_.primitiveField() * T.primitiveField()));

    const Eigen::RowVectorXd ofFluid = located.sample(columns(T.primitiveField()));
    const Eigen::RowVectorXd assigned = coefficients_.cwiseProduct(ofFluid);
    for (Eigen::Index particle = 0; particle < coefficients_.size(); ++particle)
    {
        double& temperature = temperatures.temperature[particle];
        const double capacity = temperatures.heatCapacity[particle];
        const double before = temperature;
        temperature += coefficients_[particle] * (ofFluid[particle] - temperature) / capacity;
        heat.received += capacity * (temperature - before);
        heat.inParticles += capacity * temperature;
    }

    given_.primitiveFieldRef() = timeStep_ * coefficient_.primitiveField() * T.primitiveField();
    given_.correctBoundaryConditions();
    columns(deferred_.primitiveFieldRef()) = located.densitiesOf(assigned) / capacityPerVolume_;
    deferred_.correctBoundaryConditions();
    heat.pending = pending();
    return heat;
}

} // namespace clepsydra
