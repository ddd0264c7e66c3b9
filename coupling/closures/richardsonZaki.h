/// \file
/// Hindered settling, v/v_t = eps^n: J. F. Richardson & W. N. Zaki, Trans. Inst. Chem. Eng. 32, 35 (1954), and a smooth
/// exponent by P. N. Rowe, Chem. Eng. Sci. 42, 2795 (1987). v is the velocity relative to the vessel (closed, without
/// net flux), or the superficial velocity of a liquid-fluidised bed; v_t and Re = rho v_t d/mu are those of the
/// isolated particle.
#pragma once

#include <cmath>

namespace clepsydra::closures
{

/// Richardson & Zaki's exponent; d/D_column corrects for the wall. Its branches do not meet exactly (for d/D = 0, n
/// jumps by 1.8 % at Re = 0.2, 2.3 % at 1 and 0.02 % at 500).
inline double richardsonZakiExponent(double terminalReynolds, double diameterRatio = 0.0) noexcept
{
    if (terminalReynolds < 0.2)
    {
        return 4.65 + 19.5 * diameterRatio;
    }
    if (terminalReynolds < 1.0)
    {
        return (4.35 + 17.5 * diameterRatio) * std::pow(terminalReynolds, -0.03);
    }
    if (terminalReynolds < 200.0)
    {
        return (4.45 + 18.0 * diameterRatio) * std::pow(terminalReynolds, -0.1);
    }
    if (terminalReynolds < 500.0)
    {
        return 4.45 * std::pow(terminalReynolds, -0.1);
    }
    return 2.39;
}

/// Rowe's exponent: (4.7 - n)/(n - 2.35) = 0.175 Re^0.75. It is smooth and has no wall correction.
inline double roweExponent(double terminalReynolds) noexcept
{
    const double weight = 0.175 * std::pow(terminalReynolds, 0.75);
    return (4.7 + 2.35 * weight) / (1.0 + weight);
}

} // namespace clepsydra::closures
