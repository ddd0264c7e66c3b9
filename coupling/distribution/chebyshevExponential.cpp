#include "distribution/chebyshevExponential.h"

#include <cmath>
#include <numeric>

namespace clepsydra
{

std::vector<double> chebyshevExponential(double exponent, double tolerance)
{
    // All terms but the first are below the tolerance, and the recurrence would overflow at exponents such as those of a
    // mesh of one cell.
    if (2 * exponent < tolerance)
    {
        return {1};
    }
    // Miller's backward recurrence (Abramowitz & Stegun 9.12, example 1): I_(k-1) = I_(k+1) + 2 k/a I_k, started far
    // beyond the last term that matters and with an arbitrary scale. The scale follows from e^-a (I_0 + 2 I_1 + 2
    // I_2 + ...) = 1. Neither e^a nor I_k is computed, which would overflow at a = 710.
    const auto start = static_cast<std::size_t>(20 + 12 * std::sqrt(exponent));
    constexpr double tiny = 1e-280;
    constexpr double huge = 1e250;
    std::vector<double> bessel(start + 2, 0.0);
    bessel[start] = tiny;
    for (std::size_t k = start; k > 0; --k)
    {
        bessel[k - 1] = bessel[k + 1] + 2 * static_cast<double>(k) / exponent * bessel[k];
        if (bessel[k - 1] > huge)
        {
            for (std::size_t above = k - 1; above < bessel.size(); ++above)
            {
                bessel[above] /= huge;
            }
        }
    }
    for (std::size_t k = 1; k < bessel.size(); ++k)
    {
        bessel[k] *= 2;
    }

    double total = std::accumulate(bessel.rbegin(), bessel.rend(), 0.0);
    double left = 0;
    while (bessel.size() > 1 && left + bessel.back() < tolerance * total)
    {
        left += bessel.back();
        bessel.pop_back();
    }
    total -= left;
    for (double& coefficient : bessel)
    {
        coefficient /= total;
    }
    return bessel;
}

} // namespace clepsydra
