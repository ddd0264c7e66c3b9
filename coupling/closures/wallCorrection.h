/// \file
/// Corrections of a particle's drag for walls beside it.
///
/// Tube, any Re: R. Di Felice, Int. J. Multiphase Flow 22, 527 (1996), fitted to measured settling velocities on the
/// axis of a tube; lambda = d/D, and Re_t is that of the particle in unbounded fluid:
///
///     v/v_t = k = ((1 - lambda)/(1 - 0.33 lambda))^n,     (3.3 - n)/(n - 0.85) = 0.1 Re_t
///
/// The same force moves the particle k times as fast as a free one, so at a given speed v the drag is that of a free
/// particle at v/k. Range: lambda < 0.9. At Re -> 0 it is within 1 % of Faxen's series for a tube's axis for
/// lambda <= 0.2, 3 % faster at 0.3 and 9 % faster at 0.5.
///
/// Plane, creeping flow, motion parallel to it: H. Faxen, Ark. Mat. Astron. Fys. 17 (1923), a series in lambda = R/h
/// with the distance h from centre to wall; in Happel & Brenner, Low Reynolds Number Hydrodynamics (1965), ch. 7:
///
///     1/(1 - 9/16 lambda + 1/8 lambda^3 - 45/256 lambda^4 - 1/16 lambda^5)
///
/// Range: Re h/d << 1. At contact it is finite (3.08), whereas the exact factor grows as ln(1/gap).
///
/// Plane, creeping flow, motion towards it, any gap: H. Brenner, Chem. Eng. Sci. 16, 242 (1961), an exact series in
/// bipolar coordinates, in the closed form of M. A. Bevan & D. C. Prieve, J. Chem. Phys. 113, 1228 (2000); s = gap/R:
///
///     (6 s^2 + 9 s + 2)/(6 s^2 + 2 s)
///
/// Compared with the series it is at most 0.7 % low (s = 0.05) and at most 0.3 % high (s = 5), and it has the 1/s of
/// lubrication theory. Range: Re << 1 for any gap; any Re near the wall, for s below about 1/Re.
#pragma once

#include <cmath>

namespace clepsydra::closures
{

/// n of Di Felice's factor [-]: 3.3 in creeping flow, 0.85 for large Re.
inline double diFeliceWallExponent(double freeReynolds) noexcept
{
    return (3.3 + 0.085 * freeReynolds) / (1.0 + 0.1 * freeReynolds);
}

/// k [-], in (0, 1]. \param lambda  d/D in [0, 1)
inline double diFeliceWallVelocityRatio(double lambda, double freeReynolds) noexcept
{
    return std::pow((1.0 - lambda) / (1.0 - 0.33 * lambda), diFeliceWallExponent(freeReynolds));
}

/// k for a particle of a given speed v in the tube, Re = rho v d/mu. The free particle's Re_t = Re/k(Re_t) is found by
/// Newton's iteration for ln k.
inline double diFeliceWallVelocityRatioAtSpeed(double lambda, double reynolds) noexcept
{
    const double logBase = std::log((1.0 - lambda) / (1.0 - 0.33 * lambda));
    double logRatio = logBase * diFeliceWallExponent(reynolds);
    for (int iteration = 0; iteration < 5; ++iteration)
    {
        const double freeReynolds = reynolds * std::exp(-logRatio);
        const double denominator = 1.0 + 0.1 * freeReynolds;
        const double slope = 1.0 - 0.245 * logBase * freeReynolds / (denominator * denominator);
        logRatio -= (logRatio - logBase * diFeliceWallExponent(freeReynolds)) / slope;
    }
    return std::exp(logRatio);
}

/// Drag divided by the free drag for motion parallel to the wall [-]. \param lambda  R/h in [0, 1]
inline double faxenParallelFactor(double lambda) noexcept
{
    const double cubed = lambda * lambda * lambda;
    return 1.0
           / (1.0 - 9.0 / 16.0 * lambda + cubed / 8.0 - 45.0 / 256.0 * cubed * lambda - cubed * lambda * lambda / 16.0);
}

/// Drag divided by the free drag for motion towards or away from the wall [-]; unbounded at contact.
/// \param gap  divided by the radius, > 0
inline double brennerPerpendicularFactor(double gap) noexcept
{
    return ((6.0 * gap + 9.0) * gap + 2.0) / ((6.0 * gap + 2.0) * gap);
}

} // namespace clepsydra::closures
