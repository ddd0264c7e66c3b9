#pragma once

#include "engine/particles.h"

#include <optional>

namespace clepsydra
{

/// What the engine's script does not state of the particles' heat.
struct HeatOfParticles
{
    /// Temperature of a particle that is created or inserted, or read from a file without temperatures [K].
    std::optional<double> temperature;
    /// [J/(kg K)].
    std::optional<double> specificHeat;
};

/// The particles that this rank owns, in the order of DemEngine::particles(), and valid as long.
struct TemperaturesView
{
    /// Writable [K]. They travel with the particle and are part of checkpoints.
    View<double> temperature;
    /// Mass times specific heat [J/K].
    ConstView<double> heatCapacity;
};

/// An engine implements this beside DemEngine where its particles may have temperatures. The engine may change them by
/// itself, as by conduction at contacts.
class ParticleTemperatures
{
public:
    virtual ~ParticleTemperatures() = default;

    /// Requests temperatures(). \pre DemEngine::initialise() has not been called
    /// \param heat  has a value exactly where the engine's script states none
    virtual void requestTemperatures(const HeatOfParticles& heat) = 0;

    /// Local. \pre requested, and DemEngine::initialise() has been called
    virtual TemperaturesView temperatures() = 0;
};

} // namespace clepsydra
