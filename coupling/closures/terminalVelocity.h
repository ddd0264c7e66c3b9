/// \file
/// The slip velocity at which drag balances the buoyant weight: the terminal velocity of an isolated particle
/// (eps = 1), and the slip in a settling or fluidised homogeneous suspension (eps < 1).
///
/// Force balance of one particle in model A, without acceleration. In a homogeneous suspension grad p carries the
/// weight of the mixture, -dp/dz = [eps rho_f + (1 - eps) rho_p] g, so the remaining force on the particle is
///
///     Sp(u) u = eps V_p |rho_p - rho_f| g
///
/// which at eps = 1 is the balance of an isolated particle. With ErgunDrag, eps u at the bed's void fraction equals
/// Ergun's U_mf.
#pragma once

#include "closures/particleInFluid.h"

#include <stdexcept>

namespace clepsydra::closures
{

struct SettlingParticle
{
    double diameter;                 // m
    double particleDensity;          // kg/m3
    double fluidDensity;             // kg/m3
    double dynamicViscosity;         // Pa s
    double gravity = defaultGravity; // m/s2
    double voidFraction = 1.0;       // 1: an isolated particle
};

/// Speed of the particle relative to the fluid between the particles (interstitial) [m/s], >= 0. The particle sinks
/// where it is denser than the fluid and rises where it is lighter. The root is found by bisection, which only needs a
/// drag force that increases with the slip, as that of every law here does; the relative error is below 1e-12 (40-50
/// evaluations).
/// \throws std::invalid_argument for a value that is not positive, std::domain_error where the law's force never
/// reaches the weight
template<class DragLaw>
double terminalSlip(const DragLaw& drag, const SettlingParticle& s)
{
    if (!(s.diameter > 0 && s.particleDensity > 0 && s.fluidDensity > 0 && s.dynamicViscosity > 0 && s.gravity > 0
            && s.voidFraction > 0 && s.voidFraction <= 1))
    {
        throw std::invalid_argument("terminalSlip: diameter, densities, viscosity and gravity must be positive and "
                                    "the void fraction within (0, 1]");
    }

    const double volume = pi / 6.0 * s.diameter * s.diameter * s.diameter;
    const double load = s.voidFraction * volume * std::abs(s.particleDensity - s.fluidDensity) * s.gravity;
    if (load == 0.0)
    {
        return 0.0;
    }

    ParticleInFluid particle = makeParticleInFluid(s.diameter, s.voidFraction, 0.0, s.fluidDensity, s.dynamicViscosity);
    const auto carries = [&](double slip) {
        particle.slipSpeed = slip;
        return drag(particle) * slip >= load;
    };

    // The search starts from Stokes' velocity. Inertia and neighbours usually lower the slip, but the law decides.
    double high = load / stokesCoefficient(particle);
    for (int i = 0; !carries(high); ++i)
    {
        if (i == 100)
        {
            throw std::domain_error("terminalSlip: the drag force never reaches the particle's weight");
        }
        high *= 2.0;
    }
    double low = 0.0;
    while (high - low > 1e-12 * high)
    {
        const double middle = 0.5 * (low + high);
        (carries(middle) ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

/// Terminal velocity of an isolated particle in fluid at rest, whatever void fraction is given [m/s].
template<class DragLaw>
double terminalVelocity(const DragLaw& drag, SettlingParticle particle)
{
    particle.voidFraction = 1.0;
    return terminalSlip(drag, particle);
}

/// Settling velocity of a suspension relative to a closed vessel, where the displaced fluid flows back between the
/// particles and the net flux is zero [m/s]. It is also the superficial velocity that fluidises a bed to this void
/// fraction: eps u.
template<class DragLaw>
double hinderedSettlingVelocity(const DragLaw& drag, const SettlingParticle& particle)
{
    return particle.voidFraction * terminalSlip(drag, particle);
}

} // namespace clepsydra::closures
