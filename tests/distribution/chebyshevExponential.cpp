/// \file
/// The series that the smoothing uses, against the exponential that it approximates.

#include "distribution/chebyshevExponential.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace
{

using clepsydra::chebyshevExponential;

/// The sum is exp(-a (1 - x)) to its tolerance on all of [-1, 1], for exponents from none, and nearly none, to far beyond
/// the one where e^a overflows, and 1 at x = 1, which is what conserves the integral. A series that is cut too early, or
/// coefficients that lose their digits in the recurrence, miss by more.
TEST(ChebyshevExponential, IsTheExponential)
{
    for (const double exponent : {0.0, 1e-300, 1e-6, 0.1, 1.0, 8.0, 60.0, 600.0, 1e4, 1e5})
    {
        for (const double tolerance : {1e-4, 1e-8, 1e-12})
        {
            const std::vector<double> series = chebyshevExponential(exponent, tolerance);
            for (const double x : {1.0, 1 - 1e-7, 0.9999, 0.99, 0.5, 0.0, -0.3, -0.999, -1.0})
            {
                double sum = 0;
                for (std::size_t k = 0; k < series.size(); ++k)
                {
                    sum += series[k] * std::cos(static_cast<double>(k) * std::acos(x));
                }
                EXPECT_NEAR(sum, std::exp(-exponent * (1 - x)), 2 * tolerance + 1e-12)
                    << "exponent " << exponent << ", x " << x;
            }
            EXPECT_NEAR(std::accumulate(series.begin(), series.end(), 0.0), 1, 1e-14);
            for (const double coefficient : series)
            {
                EXPECT_GT(coefficient, 0);
            }
        }
    }
}

/// Its length grows like the square root of the exponent: this is what makes small cells affordable. Terms that no longer
/// matter would still be right, and cost as much as steps of explicit Euler.
TEST(ChebyshevExponential, IsShort)
{
    EXPECT_LT(chebyshevExponential(1, 1e-8).size(), 11U);
    EXPECT_LT(chebyshevExponential(60, 1e-8).size(), 50U);
    EXPECT_LT(chebyshevExponential(600, 1e-8).size(), 145U);
    EXPECT_LT(chebyshevExponential(6e4, 1e-8).size(), 1450U);
}

} // namespace
