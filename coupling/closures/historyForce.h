/// \file
/// History force: the effect of the boundary layer and wake that earlier accelerations of the particle have left in the
/// fluid.
///
///     F = -C int_-inf^t K(t - s) d(v - U)/ds ds,     C = 3/2 d2 sqrt(pi rho mu)
///
/// Basset (1888), for creeping flow and for any flow at short times: K = tau^-1/2. R. Mei & R. J. Adrian, J. Fluid
/// Mech. 237, 323 (1992), for finite Re, where K decays faster, with the present speed V:
///
///     K = tau^-1/2 (1 + (tau/tau_M)^3/4)^-2
///     tau_M^3/4 = (pi nu/R2)^1/4/(pi/2 V3/(R nu f3))^1/2,  f = 0.75 + 0.105 Re
///
/// The memory per particle is constant, as in M. A. T. van Hinsberg, J. H. M. ten Thije Boonkkamp & H. J. H. Clercx, J.
/// Comput. Phys. 230, 1465 (2011): the kernel is a sum of exponentials, each of which needs only its own last value.
/// Theirs are fitted. Here tau^-1/2 = 1/sqrt(pi) int exp(-tau r) r^1/2 d(ln r) is summed by the trapezoidal rule in
/// ln r with steps of 1, whose relative error is 2.8 exp(-pi^2) = 1.5e-4 (G. Beylkin & L. Monzon, Appl. Comput. Harmon.
/// Anal. 28, 131 (2010)). Mei & Adrian's kernel is the same sum, with each weight multiplied by a factor that depends
/// on its rate times tau_M. The contribution of the last step, where the kernel is singular, is exact and is implicit
/// in the particle's inertia, like an added mass.
///
/// Range: time steps from 1e-7 s, motion of up to 100 s. Mei & Adrian: Re up to 100 and small changes of speed. After a
/// reversal the particle meets its own wake, and neither kernel is known to hold.
#pragma once

#include "closures/constants.h"

#include <array>
#include <cmath>

namespace clepsydra::closures
{

inline constexpr int historyModes = 28;
inline constexpr int slowestLogRate = -7;

/// ln of the rate of a mode [1/s]; mode 0 is the slowest.
constexpr double historyLogRate(int mode) noexcept
{
    return slowestLogRate + mode;
}

/// Weight of a mode in tau^-1/2 [s^-1/2]. The weight of the slowest mode includes those of all modes that are slower
/// still.
inline double historyWeight(int mode) noexcept
{
    const double own = std::sqrt(std::exp(historyLogRate(mode)) / pi);
    return mode > 0 ? own : own / (1.0 - std::exp(-0.5));
}

/// C [kg s^-1/2].
inline double historyCoefficient(double diameter, double density, double dynamicViscosity) noexcept
{
    return 1.5 * diameter * diameter * std::sqrt(pi * density * dynamicViscosity);
}

/// Effect of one step of constant acceleration on the modes, and of the modes on the force.
struct HistoryStep
{
    /// The step's own contribution, an added mass after multiplication by C: mean over the step of 2 tau^1/2 [s^1/2].
    double ownPart;
    /// A mode after the step equals the mode before times `fades` plus the change of velocity times `mean`.
    std::array<double, historyModes> fades{};
    /// Mean over the step of a mode that is 1 at its start.
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

/// ln of tau_M [s]; very large at zero slip.
/// \param speed  of the particle relative to the fluid [m/s]
/// \param viscosity  kinematic [m2/s]
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

/// Factor of a mode's weight in Mei & Adrian's kernel: 1 for fast modes, 0 for slow ones.
///
/// With s = tau/tau_M, phi(s) = s^-1/2 (1 + s^3/4)^-2 is written as int exp(-s x) m(x) dx. m follows from phi's jump
/// across the negative axis; q = u^3/4:
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
        // Trapezoidal rule in ln u.
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
