#include "forces/particleForces.h"

#include "forces/coarseGraining.h"
#include "vectors.h"

#include "wordList.H"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace clepsydra
{

namespace
{

constexpr Eigen::Index particlesAtATime = 64;

/// DEM step over the relaxation time by drag, at which an explicit step turns the slip velocity into its opposite.
constexpr double longestDemStep = 2;

/// Prefetches the part of the states of particles `first` to `end` that every force needs; the evaluation of contacts
/// has displaced it from the caches.
void prefetch(const ParticlesView& particles, Eigen::Index first, Eigen::Index end)
{
    constexpr std::size_t cacheLine = 64;
    for (Eigen::Index particle = first; particle < end; ++particle)
    {
        const char* const state = reinterpret_cast<const char*>(particles.state + particle);
        for (std::size_t byte = 0; byte <= offsetof(CouplingState, fluid.velocityInCells); byte += cacheLine)
        {
            __builtin_prefetch(state + byte, 1);
        }
    }
}

/// View of the particles `first` to `first + count`, with all pairs.
ParticlesView segmentOf(const ParticlesView& particles, Eigen::Index first, Eigen::Index count)
{
    const auto values = [&](const auto& all) { return std::decay_t<decltype(all)>(all.data() + first, count); };
    const auto vectors = [&](const ConstVectors& all) { return ConstVectors(all.data() + 3 * first, 3, count); };
    return {values(particles.id), vectors(particles.position), vectors(particles.velocity),
        vectors(particles.angularVelocity), values(particles.radius), values(particles.mass), particles.state + first,
        vectors(particles.otherForce), particles.pairs, particles.memory + first * particles.memorySize,
        particles.memorySize, particles.advancesMemory, values(particles.fixed), nullptr,
        Vectors(const_cast<double*>(particles.torque.data()) + 3 * first, 3, count)};
}

/// "(WenYuDrag StokesDrag noDrag)": the models of a family, and the word that leaves it out.
std::string allowedFor(ForceFamily family)
{
    Foam::wordList names = ForceLines::namesOf(family);
    if (const Foam::word leftOutBy(textOf(family).leftOutBy); !leftOutBy.empty())
    {
        names.append(leftOutBy);
    }
    std::string text;
    for (const Foam::word& name : names)
    {
        text += (text.empty() ? "(" : " ") + name;
    }
    return text + ')';
}

} // namespace

ParticleForces::ParticleForces(
    const Foam::dictionary& couplingProperties, ModelType modelType, const FluidProperties& fluid, PhaseTimers& timers)
    : timers_(timers),
      modelType_(modelType),
      coarseGraining_(readCoarseGraining(couplingProperties)),
      script_(couplingProperties.subOrEmptyDict("DEM").getOrDefault<Foam::fileName>("script", Foam::fileName::null))
{
    for (const Foam::word& name : couplingProperties.get<Foam::wordList>("forceModels"))
    {
        if (names_.found(name))
        {
            FatalIOErrorInFunction(couplingProperties)
                << "Entry 'forceModels' lists '" << name << "' twice; allowed: each force once"
                << Foam::exit(Foam::FatalIOError);
        }
        models_.append(ForceModel::New(name, couplingProperties, fluid).ptr());
        names_.append(name);
        checkLastModel(couplingProperties);
    }
    checkWalls(couplingProperties);
    pairs_ = needs().pairReach > 0;
    torque_ = needs().torque;
}

void ParticleForces::checkWalls(const Foam::dictionary& couplingProperties) const
{
    std::vector<WallPlane> walls;
    for (const ForceModel& model : models_)
    {
        const std::vector<WallPlane> ofModel = model.resistingWalls();
        for (const WallPlane& wall : ofModel)
        {
            if (std::any_of(walls.begin(), walls.end(), [&](const WallPlane& other) { return wall.isSameAs(other); }))
            {
                FatalIOErrorInFunction(couplingProperties)
                    << "Two models of entry 'forceModels' contain the resistance of the wall at " << toFoam(wall.point)
                    << " m, so it would be counted twice; allowed: one of wallCorrection of the drag law, and a "
                    << "wallReach (or reach) above 0.1 of lubricationForce" << Foam::exit(Foam::FatalIOError);
            }
        }
        walls.insert(walls.end(), ofModel.begin(), ofModel.end());
    }
}

void ParticleForces::checkLastModel(const Foam::dictionary& couplingProperties) const
{
    const Foam::word& name = names_.last();
    const ForceModel& last = models_.last();
    if (modelType_ == ModelType::B && last.onlyInModelA())
    {
        FatalIOErrorInFunction(couplingProperties)
            << "Entry 'forceModels' lists '" << name << "' and entry 'modelType' is B; allowed: without it, because in "
            << "model B the fluid has the whole pressure gradient and viscous stress, and the particles' part of "
            << "them is in their drag, which is divided by the void fraction" << Foam::exit(Foam::FatalIOError);
    }
    if (coarseGraining_ != 1 && !last.scalesToParcels())
    {
        FatalIOErrorInFunction(couplingProperties)
            << "Entry 'coarseGraining' is " << coarseGraining_ << ", and the force on a parcel of particles is not "
            << "defined for '" << name << "' of entry 'forceModels' (" << last.description().c_str()
            << "); allowed: without it, or coarseGraining 1" << Foam::exit(Foam::FatalIOError);
    }
    for (Foam::label other = 0; other < models_.size() - 1; ++other)
    {
        const ForceModel& before = models_[other];
        if (last.family() != ForceFamily::other && before.family() == last.family())
        {
            const bool oneIsLeftOut = before.isLeftOut() || last.isLeftOut();
            FatalIOErrorInFunction(couplingProperties)
                << "Entry 'forceModels' lists '" << names_[other] << "' and '" << name << "', which are both for the "
                << textOf(last.family()).name
                << (oneIsLeftOut ? ": one is the force, the other one leaves it out" : ": their forces would add up")
                << "; allowed: one of " << allowedFor(last.family()).c_str() << Foam::exit(Foam::FatalIOError);
        }
        if (last.needs().memory > 0 && before.needs().memory > 0)
        {
            FatalIOErrorInFunction(couplingProperties)
                << "Entry 'forceModels' lists a second force that stores values per particle, '" << name
                << "'; allowed: one such force" << Foam::exit(Foam::FatalIOError);
        }
    }
}

void ParticleForces::requireAllTerms(const Foam::dictionary& couplingProperties) const
{
    std::vector<ForceFamily> terms = {ForceFamily::drag, ForceFamily::buoyancy};
    if (modelType_ == ModelType::A)
    {
        terms.insert(terms.end(), {ForceFamily::pressureGradient, ForceFamily::viscousStress});
    }
    std::vector<ForceFamily> chosen;
    for (const ForceModel& model : models_)
    {
        chosen.push_back(model.family());
    }
    std::ostringstream faults;
    for (const ForceFamily term : terms)
    {
        if (std::count(chosen.begin(), chosen.end(), term) == 0)
        {
            const ForceFamilyText& text = textOf(term);
            faults << "Entry 'forceModels' has no model of the " << text.name << ", " << text.term
                   << ", which the equations of model " << (modelType_ == ModelType::A ? 'A' : 'B')
                   << " contain; allowed: " << allowedFor(term) << ", where " << text.leftOutBy
                   << " solves the equations without this term\n";
        }
    }
    if (!faults.str().empty())
    {
        FatalIOErrorInFunction(couplingProperties) << faults.str().c_str() << Foam::exit(Foam::FatalIOError);
    }
}

ForceNeeds ParticleForces::needs() const
{
    ForceNeeds needs;
    for (const ForceModel& model : models_)
    {
        needs.pressureGradient = needs.pressureGradient || model.needs().pressureGradient;
        needs.acceleration = needs.acceleration || model.needs().acceleration;
        needs.vorticity = needs.vorticity || model.needs().vorticity;
        needs.viscousStress = needs.viscousStress || model.needs().viscousStress;
        needs.sauterMeanDiameter = needs.sauterMeanDiameter || model.needs().sauterMeanDiameter;
        needs.torque = needs.torque || model.needs().torque;
        needs.pairReach = std::max(needs.pairReach, model.needs().pairReach);
        needs.memory = std::max(needs.memory, model.needs().memory);
    }
    return needs;
}

void ParticleForces::evaluate(const ParticlesView& particles, double timeStep, Vectors force)
{
    const PhaseTimers::Scope timing = timers_.time("forces");
    // Pairs may consist of any two particles; everything else is evaluated for a few particles at a time, so that their
    // states stay in the cache.
    const Eigen::Index most = pairs_ ? particles.size() : particlesAtATime;
    for (Eigen::Index first = 0; first < particles.size(); first += most)
    {
        const Eigen::Index count = std::min(most, particles.size() - first);
        prefetch(particles, first + count, std::min(first + 2 * count, particles.size()));
        evaluatePart(segmentOf(particles, first, count), timeStep, Vectors(force.data() + 3 * first, 3, count));
    }
}

void ParticleForces::evaluatePart(const ParticlesView& particles, double timeStep, Vectors force)
{
    sum_.setZero(particles.size());
    sum_.timeStep = timeStep;
    if (torque_)
    {
        sum_.torqueCoefficient.setZero(particles.size());
    }
    removeSelfInducedVelocity(particles);
    addModels(particles);
    Vector3d pressureForce = Vector3d::Zero();
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        CouplingState& state = particles.state[particle];
        const double submergedFraction = state.fluid.submergedFraction;
        const double ofModel =
            modelType_ == ModelType::B ? submergedFraction / state.fluid.voidFraction : submergedFraction;
        const double coefficient = ofModel * sum_.implicitCoefficient[particle];
        const double addedMass = ofModel * sum_.addedMass[particle];
        const double inertia = particles.mass[particle] + addedMass;
        if (timeStep * coefficient > longestDemStep * inertia && !particles.fixed[particle])
        {
            reportStiffDrag(particles, particle, inertia / coefficient, timeStep);
        }
        Vector3d withReaction = coefficient * (state.fluid.velocity - particles.velocity.col(particle))
                                + ofModel * sum_.source.col(particle);
        const Vector3d withoutReaction =
            submergedFraction * (sum_.pressure.col(particle) + sum_.shared.col(particle)) + sum_.mutual.col(particle);
        pressureForce += submergedFraction * sum_.pressure.col(particle);
        if (addedMass > 0)
        {
            state.received.addedMassTime += timeStep * addedMass;
            // The particle's acceleration solves m dv/dt = all other forces + m_a (DU/Dt - dv/dt), which is stable for
            // any m_a/m.
            const Vector3d others = particles.otherForce.col(particle) + withReaction + withoutReaction;
            const Vector3d free = (others + addedMass * state.fluid.acceleration) / inertia;
            const Vector3d acceleration = particles.fixed[particle] ? Vector3d(Vector3d::Zero()) : free;
            withReaction += addedMass * (state.fluid.acceleration - acceleration);
        }
        force.col(particle) = withReaction + withoutReaction;
        if (state.fluid.selfMobility > 0)
        {
            state.drag = coefficient * (state.fluid.velocity - particles.velocity.col(particle));
        }
        state.received.impulse += timeStep * withReaction;
        state.received.implicitCoefficientTime += timeStep * coefficient;
    }
    pressureImpulse_ += timeStep * pressureForce;
    if (torque_)
    {
        addTorques(particles, timeStep);
    }
}

void ParticleForces::reportStiffDrag(
    const ParticlesView& particles, Eigen::Index particle, double relaxationTime, double timeStep) const
{
    FatalErrorInFunction << "Drag brings particle " << particles.id[particle] << " with a diameter of "
                         << 2 * particles.radius[particle] << " m to the fluid's velocity in " << relaxationTime
                         << " s, but the DEM step is " << timeStep << " s; allowed: a timestep in " << script_.c_str()
                         << " of at most " << longestDemStep * relaxationTime << " s, and better a fifth of that"
                         << Foam::exit(Foam::FatalError);
    std::abort();
}

ParticlesView ParticleForces::realParticles(const ParticlesView& parcels)
{
    realRadius_ = parcels.radius / coarseGraining_;
    realMass_ = parcels.mass / closures::particlesPerParcel(coarseGraining_);
    const auto values = [](const Eigen::ArrayXd& all) { return ConstView<double>(all.data(), all.size()); };
    return {parcels.id, parcels.position, parcels.velocity, parcels.angularVelocity, values(realRadius_),
        values(realMass_), parcels.state};
}

void ParticleForces::addModels(const ParticlesView& particles)
{
    if (coarseGraining_ == 1)
    {
        for (const ForceModel& model : models_)
        {
            model.add(particles, sum_);
        }
        return;
    }
    const ParticlesView real = realParticles(particles);
    for (const ForceModel& model : models_)
    {
        model.add(real, sum_);
    }
    sum_.multiplyBy(closures::particlesPerParcel(coarseGraining_));
}

void ParticleForces::addTorques(const ParticlesView& particles, double timeStep) const
{
    Vectors all = particles.torque;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        CouplingState& state = particles.state[particle];
        const double coefficient = state.fluid.submergedFraction * sum_.torqueCoefficient[particle];
        Vector3d torque = coefficient * (0.5 * state.fluid.vorticity - particles.angularVelocity.col(particle));
        if (!particles.fixed[particle])
        {
            // The mean over the step of the solution of I domega/dt = others + C_t (curl(U)/2 - omega) with constant
            // coefficients. It is stable for any DEM step, and exact without other torques and in equilibrium with
            // them.
            const double inertia =
                0.4 * particles.mass[particle] * particles.radius[particle] * particles.radius[particle];
            const double exponent = timeStep * coefficient / inertia;
            const double mean = exponent > 0 ? -std::expm1(-exponent) / exponent : 1;
            torque = mean * torque + (mean - 1) * Vector3d(all.col(particle));
            all.col(particle) += torque;
        }
        state.angularImpulse += timeStep * torque;
    }
}

Vector3d ParticleForces::takePressureImpulse()
{
    return std::exchange(pressureImpulse_, Vector3d::Zero());
}

void ParticleForces::removeSelfInducedVelocity(const ParticlesView& particles)
{
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        FluidAtParticle& fluid = particles.state[particle].fluid;
        if (fluid.selfMobility > 0)
        {
            // The reaction of the particle's drag acts on the fluid. The drag of the last DEM step is used, because it
            // changes little from step to step. Only the drag is used, because the self-induced velocity is that of a
            // steady force: added mass and history force respond to a change of the fluid's velocity with so large a
            // force that each step would increase the change.
            fluid.velocity = fluid.velocityInCells + fluid.selfMobility * particles.state[particle].drag;
        }
    }
}

} // namespace clepsydra
