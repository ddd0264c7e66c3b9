/// \file
/// Velocity that a particle's own force induces in the fluid at the particle's centre where the force is spread by a
/// Gaussian kernel (self-induced velocity).
///
/// The force F is spread as F exp(-r2/b2)/(pi^1.5 b3). Fluid flows past it at U, through neighbours with the drag
/// coefficient per volume beta [kg/(m3 s)]. The equations are Oseen's with Brinkman's term, in unbounded fluid:
///
///     rho U.grad u = -grad p + mu lap(u) - beta u + F exp(-r2/b2)/(pi^1.5 b3),   div u = 0
///
/// They are solved by Fourier transform. With R = rho U b/mu and B = beta b2/mu the velocity at the centre, for F
/// parallel to U, is
///
///     u = F/(2 pi^2 mu b) int_0^inf exp(-k2/4)/(1 + B/k2) g(a) dk,  a = (k + B/k)/R,
///     g(a) = a ((1 + a2) atan(1/a) - a)
///
/// Limits: R = B = 0 gives F/(3 pi^1.5 mu b), Stokes flow; R -> inf, B = 0 gives F/(2 pi rho U b2), half of the wake's
/// momentum deficit. A closed form of the self-induced velocity was proposed by Balachandar, Liu & Lakhote, J. Comput.
/// Phys. 376, 160 (2019). arXiv 2503.03467 has Gaussian and Wendland kernels and an Oseen factor for finite Re; arXiv
/// 2405.08188 adds unsteadiness, which is not included here. The integral above was derived for this file.
#pragma once

#include "closures/constants.h"

#include <cmath>

namespace clepsydra::closures
{

/// A force that is spread by a Gaussian kernel, and the fluid around it. SI units; all values > 0 except speed and
/// resistance >= 0.
struct SmearedForce
{
    double bandwidth;        // b of exp(-r2/b2), m
    double density;          // of the fluid, kg/m3
    double dynamicViscosity; // Pa s
    double speed;            // of the fluid past the force, m/s
    double resistance;       // of the neighbours, drag coefficient per volume, kg/(m3 s)
};

/// Self-induced velocity per force u/F [m/(N s)], to a relative 1e-4.
inline double velocityPerForce(const SmearedForce& force) noexcept
{
    const double reynolds = force.density * force.speed * force.bandwidth / force.dynamicViscosity;
    const double screening = force.resistance * force.bandwidth * force.bandwidth / force.dynamicViscosity;
    const auto spread = [](double a) {
        // The series replaces the difference where that loses its digits.
        return a > 100 ? 2.0 / 3.0 - 2.0 / (15.0 * a * a) : a * ((1 + a * a) * std::atan(1 / a) - a);
    };
    // Trapezoidal rule in ln k. In this variable the integrand is smooth, also at k = R and k2 = B.
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
