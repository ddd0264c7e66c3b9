/// \file
/// History force: the boundary layer and wake that a particle's earlier accelerations have left in the fluid.
///
///     F = -C int_-inf^t K(t - s) d(v - U)/ds ds,     C = 3/2 d2 sqrt(pi rho mu)
///
/// Basset (1888), creeping flow, and any flow at short lags: K = tau^-1/2. Finite Re, forgets faster: R. Mei & R. J.
/// Adrian, J. Fluid Mech. 237, 323 (1992), with the speed V of now:
///
///     K = tau^-1/2 (1 + (tau/tau_M)^3/4)^-2,     tau_M^3/4 = (pi nu/R2)^1/4/(pi/2 V3/(R nu f3))^1/2,  f = .75 + .105 Re
///
/// Constant memory per particle, as M. A. T. van Hinsberg, J. H. M. ten Thije Boonkkamp & H. J. H. Clercx, J. Comput. Phys.
/// 230, 1465 (2011) do it: the kernel is a sum of exponentials, each of which needs its own last value only. Theirs are
/// fitted; here tau^-1/2 = 1/sqrt(pi) int exp(-tau r) r^1/2 d(ln r) is summed by the trapezoidal rule in ln r at steps of
/// 1, which is off by 2.8 exp(-pi^2) = 1.5e-4 (G. Beylkin & L. Monzon, Appl. Comput. Harmon. Anal. 28, 131 (2010)). Mei
/// & Adrian's kernel is the same sum with each weight times a share of its rate and tau_M. The last step's part, where the
/// kernel is singular, is exact and implicit in the particle's inertia, as an added mass is.
///
/// Range: steps from 1e-7 s, motion of up to 100 s. Mei & Adrian: Re to 100, small changes of speed; after a reversal,
/// when the particle meets its own wake, neither is known to hold.
#pragma once

#include "closures/constants.h"

#include <array>
#include <cmath>

namespace clepsydra::closures
{

inline constexpr int historyModes = 28;
inline constexpr int slowestLogRate = -7;

/// ln of the rate [1/s] of a mode, from the slowest on.
constexpr double historyLogRate(int mode) noexcept
{
    return slowestLogRate + mode;
}

/// Of a mode in tau^-1/2 [s^-1/2]. The slowest one has the weights of all that are slower still.
inline double historyWeight(int mode) noexcept
{
    const double own = std::sqrt(std::exp(historyLogRate(mode)) / pi);
    return mode > 0 ? own : own / (1.0 - std::exp(-0.5));
}

/// C [kg s^-1/2]
inline double historyCoefficient(double diameter, double density, double dynamicViscosity) noexcept
{
    return 1.5 * diameter * diameter * std::sqrt(pi * density * dynamicViscosity);
}

/// What one step of constant acceleration does to the modes, and they to the force.
struct HistoryStep
{
    /// Of the step itself, C times this is an added mass: mean over the step of 2 tau^1/2 [s^1/2].
    double ownPart;
    /// A mode after the step: before times `fades`, plus the change of velocity times `mean`.
    std::array<double, historyModes> fades{};
    /// Mean over the step of a mode that begins at 1.
    std::array<double, historyModes> mean{};

    explicit HistoryStep(double timeStep) noexcept
        : ownPart(4.0 / 3.0 * std::sqrt(timeStep))
    {
        for (int mode = 0; mode < historyModes; ++mode)
        {
            const auto i = static_cast<std::size_t>(mode);
            const double exponent = std::exp(historyLogRate(mode)) * timeStep;
            fades[i] = std::exp(-exponent);
            mean[i] = -std::expm1(-exponent) / exponent;
        }
    }
};

/// ln of tau_M [s]; very large at rest. \param speed  of the particle past the fluid \param viscosity  kinematic
inline double meiAdrianLogTime(double diameter, double speed, double viscosity) noexcept
{
    const double radius = 0.5 * diameter;
    const double f = 0.75 + 0.105 * speed * diameter / viscosity;
    const double slowest = 1e-30; // (m/s)^3
    const double speedCubed = std::fmax(speed * speed * speed, slowest);
    return 4.0 / 3.0
           * (0.25 * std::log(pi * viscosity / (radius * radius))
               - 0.5 * std::log(0.5 * pi * speedCubed / (radius * viscosity * f * f * f)));
}

/// What is left of a mode's weight in Mei & Adrian's kernel: 1 for fast modes, 0 for slow ones.
///
/// With s = tau/tau_M and phi(s) = s^-1/2 (1 + s^3/4)^-2 = int exp(-s x) m(x) dx, m from phi's jump across the negative
/// axis, q = u^3/4:
///
///     share(x) = m(x) sqrt(pi x),   m(x) = 1/pi int_0^inf exp(-x u) u^-1/2 (1 - 2^1/2 q)/(1 - 2^1/2 q + q2)^2 du
class MeiAdrianShare
{
public:
    MeiAdrianShare() noexcept
    {
        for (int i = 0; i < points; ++i)
        {
            table_[static_cast<std::size_t>(i)] = computed(std::exp(lowest + spacing * i));
        }
    }

    /// \param logRate  ln(rate tau_M)
    double operator()(double logRate) const noexcept
    {
        const double place = (logRate - lowest) / spacing;
        if (place <= 0.0)
        {
            return 0.0;
        }
        if (place >= points - 1)
        {
            return 1.0;
        }
        const auto i = static_cast<std::size_t>(place);
        return table_[i] + (place - static_cast<double>(i)) * (table_[i + 1] - table_[i]);
    }

private:
    static constexpr double lowest = -12.0;
    static constexpr double spacing = 0.1;
    static constexpr int points = 241;

    static double computed(double x) noexcept
    {
        // trapezoidal rule in ln u
        constexpr double step = 0.05;
        double sum = 0.0;
        for (double logU = -40.0; logU < 40.0; logU += step)
        {
            const double u = std::exp(logU);
            const double q = std::pow(u, 0.75);
            const double real = 1.0 - std::sqrt(2.0) * q;
            const double square = (real + q * q) * (real + q * q);
            sum += step * std::sqrt(u) * std::exp(-x * u) * real / square;
        }
        return sum * std::sqrt(x / pi);
    }

    std::array<double, points> table_{};
};

} // namespace clepsydra::closures
