/// \file
/// What walls do to the drag of a particle beside them.
///
/// Tube, any Re: R. Di Felice, Int. J. Multiphase Flow 22, 527 (1996), fitted to measured settling velocities on the
/// axis of a tube, lambda = d/D, Re_t of the particle in unbounded fluid:
///
///     v/v_t = k = ((1 - lambda)/(1 - .33 lambda))^n,     (3.3 - n)/(n - .85) = .1 Re_t
///
/// The same force moves the particle k times as fast; so at a given speed v the drag is that of a free particle at v/k. Range:
/// lambda < .9; at Re -> 0 within 1 % of Faxen's series for a tube's axis for lambda <= .2, 3 % faster at .3, 9 % at .5.
///
/// Plane, creeping flow, motion along it: H. Faxen, Ark. Mat. Astron. Fys. 17 (1923), series in lambda = R/h, h from
/// centre to wall; in Happel & Brenner, Low Reynolds Number Hydrodynamics (1965), ch. 7:
///
///     1/(1 - 9/16 lambda + 1/8 lambda^3 - 45/256 lambda^4 - 1/16 lambda^5)
///
/// Range: Re h/d << 1. At contact it is finite (3.08), where the true one grows as ln(1/gap).
///
/// The same, motion towards it, any gap: H. Brenner, Chem. Eng. Sci. 16, 242 (1961), an exact series in bipolar
/// coordinates, in the closed form of M. A. Bevan & D. C. Prieve, J. Chem. Phys. 113, 1228 (2000); s = gap/R:
///
///     (6 s^2 + 9 s + 2)/(6 s^2 + 2 s)
///
/// It is .7 % low at most (s = .05), .3 % high at most (s = 5) against the series, and has the 1/s of lubrication. Range:
/// Re << 1 for the whole of it; near the wall, for s below some 1/Re, at any Re.
#pragma once

#include <cmath>

namespace clepsydra::closures
{

/// n of Di Felice's factor [-]: 3.3 creeping, .85 for large Re.
inline double diFeliceWallExponent(double freeReynolds) noexcept
{
    return (3.3 + 0.085 * freeReynolds) / (1.0 + 0.1 * freeReynolds);
}

/// k [-], in (0, 1]. \param lambda  d/D in [0, 1)
inline double diFeliceWallVelocityRatio(double lambda, double freeReynolds) noexcept
{
    return std::pow((1.0 - lambda) / (1.0 - 0.33 * lambda), diFeliceWallExponent(freeReynolds));
}

/// k for a particle of a given speed in the tube, Re = rho v d/mu; the free particle's is Re_t = Re/k(Re_t), which is solved by
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

/// Drag over free drag, motion along the wall [-]. \param lambda  R/h in [0, 1]
inline double faxenParallelFactor(double lambda) noexcept
{
    const double cubed = lambda * lambda * lambda;
    return 1.0
           / (1.0 - 9.0 / 16.0 * lambda + cubed / 8.0 - 45.0 / 256.0 * cubed * lambda - cubed * lambda * lambda / 16.0);
}

/// Drag over free drag, motion towards or from the wall [-]; unbounded at contact. \param gap  over the radius, > 0
inline double brennerPerpendicularFactor(double gap) noexcept
{
    return ((6.0 * gap + 9.0) * gap + 2.0) / ((6.0 * gap + 2.0) * gap);
}

} // namespace clepsydra::closures
