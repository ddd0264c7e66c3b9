#pragma once

#include "couplingState.h"
#include "couplingStep/particleMapping.h"

#include <functional>
#include <utility>
#include <vector>

namespace clepsydra
{

/// What the fluid gives back: quantities of the fluid at each particle of this rank, in the order of the engine's view.
class FluidAtParticles
{
public:
    /// Puts one quantity into a particle's state, from its values at the particle.
    using Store = std::function<void(const ParticlesView& particles, Eigen::Index particle, const double* values)>;

    /// Stores all quantities in the particles' states, where the forces read them during the next DEM steps. A particle
    /// outside the mesh has no fluid around it.
    void storeIn(const ParticlesView& particles) const;

private:
    friend class SampledFields;

    Eigen::MatrixXd values_;
    std::vector<std::pair<Eigen::Index, Store>> quantities_;
};

/// Fields of the fluid that are sampled at the particles together.
class SampledFields
{
public:
    /// \param values  rows x cells
    /// \param store  called for each particle in the mesh, after those that were added before
    template<class Values>
    void add(const Values& values, FluidAtParticles::Store store)
    {
        inCells_.emplace_back(values);
        quantities_.emplace_back(values.rows(), std::move(store));
    }

    /// \param values  3 x cells
    template<class Values>
    void add(const Values& values, Vector3d FluidAtParticle::*member)
    {
        add(values, [member](const ParticlesView& particles, Eigen::Index particle, const double* value) {
            particles.state[particle].fluid.*member = Eigen::Map<const Vector3d>(value);
        });
    }

    /// Collective.
    FluidAtParticles sampleAt(const LocatedParticles& particles) const;

private:
    std::vector<Eigen::MatrixXd> inCells_;
    std::vector<std::pair<Eigen::Index, FluidAtParticles::Store>> quantities_;
};

} // namespace clepsydra
