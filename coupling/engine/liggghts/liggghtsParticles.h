#pragma once

#include "engine/liggghts/particleProperty.h"
#include "engine/particleTemperatures.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace clepsydra
{

/// The particles of this rank in LIGGGHTS' arrays, and what is stored with each for others.
class LiggghtsParticles
{
public:
    explicit LiggghtsParticles(LiggghtsProgram& program)
        : program_(program)
    {}

    /// As the members of DemEngine with these names.
    void requestPairs(double reach, std::size_t ofState);
    void requestState(const std::vector<double>& ofNewParticle);
    void requestMemory(int numbers);

    /// As the members of ParticleTemperatures with these names.
    void requestTemperatures(const HeatOfParticles& heat);
    TemperaturesView temperatures();

    /// Adds what was requested to LIGGGHTS, and the insertion ramp. The memory continues in a resumed run only; in
    /// another run that starts from a file of particles it is zero.
    /// \throws DemEngineError where the checkpoint of a resumed run holds no memory of this size
    void addProperties(bool resumed);

    ParticlesView view(const ParticlePairs& pairs = {}, bool advancesMemory = true,
        const ConstView<bool>& fixed = ConstView<bool>(nullptr, 0)) const;

    /// See DemEngine::unwrappedPosition().
    Vector3d unwrappedPosition(Eigen::Index particle) const;

    /// LIGGGHTS' own list. It is a half list; with `newton off`, pairs across ranks are on both ranks. Without
    /// ParticlePairs::ofState. Local.
    ParticlePairs pairs();

    /// With ParticlePairs::ofState, which other ranks' particles send to their copies. Collective. \pre pairsRequested()
    ParticlePairs pairsWithState();

    bool pairsRequested() const
    {
        return indexInState_.has_value();
    }

    /// Which particles have been inserted since their states were last changed.
    std::vector<bool> areNew() const;

private:
    void addMemory(bool resumed);
    void addTemperatures(bool resumed);
    /// Where a file of particles has other temperatures than `energy` states for all particles. Collective.
    void warnOfStoredTemperatures();

    LiggghtsProgram& program_;
    std::vector<double> stateOfNewParticle_;
    int memorySize_ = 0;
    /// Index in the states of what ParticlePairs::ofState has.
    std::optional<std::size_t> indexInState_;
    std::optional<ParticleProperty> state_;
    std::optional<ParticleProperty> ofState_;
    std::optional<ParticleProperty> memory_;
    std::optional<ParticleProperty> insertionRamp_;
    std::optional<HeatOfParticles> heat_;
    std::optional<ParticleProperty> temperature_;
    /// By material [J/(kg K)].
    std::vector<double> specificHeats_;
    /// Of the particles when temperatures() was called last.
    std::vector<double> heatCapacities_;
    std::vector<std::array<int, 2>> pairList_;
};

} // namespace clepsydra
