/// \file
/// Heat between a particle and the fluid around it, whose temperature is held: the temperature of the particle is uniform
/// (Biot number h d/k_p below about 0.1) and obeys
///
///     m Cp dT_p/dt = h A (T_f - T_p),     h = Nu k/d,     A = pi d^2
///
/// so that T_f - T_p decreases by exp(-h A t/(m Cp)) in the time t, whatever the time.
#pragma once

#include "closures/constants.h"

#include <cmath>

namespace clepsydra::closures
{

/// h A [W/K].
/// \param nusselt  h d/k
/// \param conductivity  k of the fluid [W/(m K)]
/// \param diameter  of the particle [m]
inline double heatConductance(double nusselt, double conductivity, double diameter) noexcept
{
    return nusselt * pi * conductivity * diameter;
}

/// Heat that the particle takes in a time per difference T_f - T_p at its beginning [J/K]. It is below h A t, and below
/// the heat capacity, with which a particle reaches the temperature of the fluid.
/// \param heatCapacity  m Cp [J/K], > 0
/// \param conductance  h A [W/K], >= 0
/// \param time  [s], >= 0
inline double heatTaken(double heatCapacity, double conductance, double time) noexcept
{
    return -heatCapacity * std::expm1(-conductance * time / heatCapacity);
}

} // namespace clepsydra::closures
