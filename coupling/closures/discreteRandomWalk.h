/// \file
/// Discrete random walk of a particle through eddies: A. D. Gosman & E. Ioannides, J. Energy 7, 482 (1983). SI units
/// throughout.
///
/// A particle is in one eddy at a time, whose velocity u' differs from the mean by normal numbers with the variance 2 k/3
/// along each axis. It leaves the eddy when that has decayed, or when it has crossed it:
///
///     size           l   = C_mu^(3/4) k^(3/2)/epsilon
///     lifetime       t_e = l/|u'|
///     crossing time  t_c = -tau ln(1 - l/(tau |U_r|)),  infinite where l >= tau |U_r|
///
/// with the particle's relaxation time tau and its slip U_r. For particles without inertia and slip in a uniform field the
/// diffusion coefficient is l sqrt(2 k/3)/(6 sqrt(2/pi)), from E[(u_i' t_e)^2]/(2 E[t_e]).
///
/// Range: particles smaller than the eddies. In a field that is not uniform particles without inertia gather where k is
/// small, as in all such walks without a correction of drift (MacInnes & Bracco, Phys. Fluids A 4, 2809 (1992)).
#pragma once

#include "closures/constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace clepsydra::closures
{

/// Mixes the bits of a number such that each bit of the result depends on all of them: the last steps of splitmix64, by S.
/// Vigna after Steele, Lea & Flood, OOPSLA (2014).
inline std::uint64_t mixedBits(std::uint64_t number) noexcept
{
    number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9ULL;
    number = (number ^ (number >> 27)) * 0x94d049bb133111ebULL;
    return number ^ (number >> 31);
}

/// Three independent random numbers of the standard normal distribution that are a function of the arguments: nothing is
/// stored, so a resumed run and a run on other ranks draw the same numbers.
/// \param particle, count  for instance the id of a particle and the number of its eddy
inline std::array<double, 3> normalNumbers(std::uint64_t seed, std::uint64_t particle, std::uint64_t count) noexcept
{
    constexpr std::uint64_t goldenRatio = 0x9e3779b97f4a7c15ULL;
    std::uint64_t state = mixedBits(mixedBits(mixedBits(seed + goldenRatio) ^ particle) + goldenRatio * count);
    const auto uniform = [&state] {
        state += goldenRatio;
        // 53 bits, in the middle of their interval, so that the logarithm is finite.
        return (static_cast<double>(mixedBits(state) >> 11) + 0.5) * 0x1p-53;
    };
    // Box & Muller, Ann. Math. Stat. 29, 610 (1958).
    const double radius = std::sqrt(-2 * std::log(uniform()));
    const double angle = 2 * pi * uniform();
    const double other = std::sqrt(-2 * std::log(uniform()));
    return {radius * std::cos(angle), radius * std::sin(angle), other * std::cos(2 * pi * uniform())};
}

/// Size l of the eddies [m]. \param k  kinetic energy [m2/s2]  \param dissipation  epsilon [m2/s3]
inline double eddySize(double k, double dissipation) noexcept
{
    constexpr double cmuToThreeQuarters = 0.16431676725; // C_mu = 0.09
    return cmuToThreeQuarters * k * std::sqrt(k) / dissipation;
}

/// Time for which a particle is in an eddy, the smaller of t_e and t_c [s].
/// \param size  l [m]  \param fluctuation  |u'| [m/s]  \param relaxationTime  tau [s]  \param slip  |U_r| [m/s]
inline double timeInEddy(double size, double fluctuation, double relaxationTime, double slip) noexcept
{
    const double lifetime = size / fluctuation;
    const double stoppingDistance = relaxationTime * slip;
    const double crossing = size < stoppingDistance ? -relaxationTime * std::log1p(-size / stoppingDistance)
                                                    : std::numeric_limits<double>::infinity();
    return std::min(lifetime, crossing);
}

} // namespace clepsydra::closures
