/// \file
/// The slip at which drag carries the buoyant weight: terminal velocity of an isolated particle (eps = 1), slip in a settling
/// or fluidised homogeneous suspension (eps < 1).
///
/// Balance of one particle, model A, no acceleration. In a homogeneous suspension grad p carries the weight of the
/// mixture, -dp/dz = [eps rho_f + (1 - eps) rho_p] g, so what is left for the drag is
///
///     Sp(u) u = eps V_p |rho_p - rho_f| g
///
/// and at eps = 1 the familiar isolated particle. With ErgunDrag, eps u at the bed's void fraction is exactly Ergun's U_mf.
#pragma once

#include "closures/particleInFluid.h"

#include <stdexcept>

namespace clepsydra::closures
{

struct SettlingParticle
{
    double diameter;               // m
    double particleDensity;        // kg/m3
    double fluidDensity;           // kg/m3
    double dynamicViscosity;       // Pa s
    double gravity = usualGravity; // m/s2
    double voidFraction = 1.0;     // 1: an isolated particle
};

/// Speed >= 0 of the particle relative to the fluid between the particles (interstitial): it sinks where it is the denser
/// one, rises where it is the lighter. Bisection, which needs only that the drag force rises with the slip: safe for
/// every law here. The result is exact to a relative 1e-12 (40-50 evaluations).
/// Throws std::invalid_argument on a value that is not positive, and std::domain_error if the law's force never
/// reaches the weight.
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

    // Start from Stokes' velocity; inertia and neighbours only lower it, but let the law decide.
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

/// Terminal velocity of an isolated particle in still fluid, whatever the void fraction given.
template<class DragLaw>
double terminalVelocity(const DragLaw& drag, SettlingParticle particle)
{
    particle.voidFraction = 1.0;
    return terminalSlip(drag, particle);
}

/// Velocity against the vessel of a suspension that settles in a closed one (no net flux: the fluid displaced flows
/// back between the particles), which is also the superficial velocity that fluidises it to this void fraction: eps u.
template<class DragLaw>
double hinderedSettlingVelocity(const DragLaw& drag, const SettlingParticle& particle)
{
    return particle.voidFraction * terminalSlip(drag, particle);
}

} // namespace clepsydra::closures
