/// \file
/// The velocity that a particle's own force gives the fluid at its place when the force is spread over a Gaussian.
///
/// A force F spread as F exp(-r2/b2)/(pi^1.5 b3), past which the fluid flows at U, through neighbours that resist with
/// beta [kg/(m3 s)]: Oseen's linear equations with Brinkman's term, unbounded,
///
///     rho U.grad u = -grad p + mu lap(u) - beta u + F exp(-r2/b2)/(pi^1.5 b3),   div u = 0
///
/// solved by Fourier transform. With R = rho U b/mu, B = beta b2/mu the velocity at the centre, along F || U, is
///
///     u = F/(2 pi^2 mu b) int_0^inf exp(-k2/4)/(1 + B/k2) g(a) dk,  a = (k + B/k)/R,
///     g(a) = a ((1 + a2) atan(1/a) - a)
///
/// R = B = 0: F/(3 pi^1.5 mu b), Stokes' flow; R -> inf, B = 0: F/(2 pi rho U b2), half the wake's momentum deficit.
/// The idea, a closed form of the velocity that a smeared force gives itself, is Balachandar, Liu & Lakhote's, J. Comput.
/// Phys. 376, 160 (2019); with Gaussian and Wendland kernels, and an Oseen factor for finite Re: arXiv 2503.03467; with
/// memory, which is not in here: arXiv 2405.08188. The integral above was worked out for this file.
#pragma once

#include "closures/constants.h"

#include <cmath>

namespace clepsydra::closures
{

/// The place and the fluid of a smeared force. SI units, all > 0 but speed and resistance >= 0.
struct SmearedForce
{
    double bandwidth;        // b of exp(-r2/b2), m
    double density;          // of the fluid, kg/m3
    double dynamicViscosity; // Pa s
    double speed;            // of the fluid past the force, m/s
    double resistance;       // of the neighbours, drag coefficient per volume, kg/(m3 s)
};

/// u/F [m/(N s)], to 1e-4.
inline double velocityPerForce(const SmearedForce& force) noexcept
{
    const double reynolds = force.density * force.speed * force.bandwidth / force.dynamicViscosity;
    const double screening = force.resistance * force.bandwidth * force.bandwidth / force.dynamicViscosity;
    const auto spread = [](double a) {
        // The series where the difference loses its digits.
        return a > 100 ? 2.0 / 3.0 - 2.0 / (15.0 * a * a) : a * ((1 + a * a) * std::atan(1 / a) - a);
    };
    // Trapezoidal rule in ln k: the integrand and all that happens at k = R or k2 = B is smooth there.
    constexpr double step = 0.2;
    constexpr int first = -50;
    constexpr int last = 12;
    double integral = 0;
    for (int i = first; i <= last; ++i)
    {
        const double k = std::exp(step * i);
        const double a = reynolds > 0 ? (k + screening / k) / reynolds : 1e30;
        integral += step * k * std::exp(-0.25 * k * k) / (1 + screening / (k * k)) * spread(a);
    }
    return integral / (2 * pi * pi * force.dynamicViscosity * force.bandwidth);
}

} // namespace clepsydra::closures
