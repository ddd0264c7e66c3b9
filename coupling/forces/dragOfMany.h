#pragma once

#include "closures/particleInFluid.h"

#include <array>
#include <cstddef>
#include <string>

namespace clepsydra
{

/// Data of closures::ParticleInFluid for many particles, as arrays for vector units. SI units.
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

/// A drag law that is evaluated for many particles at once by vector units, in a sixth of the time of single
/// evaluations. Exponentials and logarithms are accurate to 4 units in the last place instead of one.
using DragOfMany = void (*)(const ManyParticlesInFluid& particles, ManyCoefficients& coefficients);

/// \param name  of one of closures::DragLaws
/// \throws std::invalid_argument for another name
DragOfMany dragOfMany(const std::string& name);

} // namespace clepsydra
