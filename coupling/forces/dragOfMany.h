#pragma once

#include "closures/particleInFluid.h"

#include <array>
#include <cstddef>
#include <string>

namespace clepsydra
{

/// What closures::ParticleInFluid holds, of many particles. SI units.
struct ManyParticlesInFluid
{
    static constexpr std::size_t most = 256;

    std::size_t count = 0;
    std::array<double, most> diameter;
    std::array<double, most> voidFraction;
    std::array<double, most> logVoidFraction;
    std::array<double, most> slipSpeed;
    double density = 0;
    double dynamicViscosity = 0;
};

using ManyCoefficients = std::array<double, ManyParticlesInFluid::most>;

/// A drag law for many particles at once, in vector units: a sixth of the time of one particle after the other. Exponentials and
/// logarithms are good to 4 units in the last place, not to one.
using DragOfMany = void (*)(const ManyParticlesInFluid& particles, ManyCoefficients& coefficients);

/// \param name  of one of closures::DragLaws; \throws std::invalid_argument for another
DragOfMany dragOfMany(const std::string& name);

} // namespace clepsydra
