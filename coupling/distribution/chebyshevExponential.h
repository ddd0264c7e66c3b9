/// \file
/// Expansion of the exponential function in a short series of Chebyshev polynomials.
///
///     exp(-a (1 - x)) = sum_k c_k T_k(x) on [-1, 1],    c_0 = e^-a I_0(a),  c_k = 2 e^-a I_k(a)
///
/// I_k are the modified Bessel functions: Abramowitz & Stegun, Handbook of Mathematical Functions (1964), 9.6.34. For
/// the exponential of a matrix: Tal-Ezer & Kosloff, J. Chem. Phys. 81, 3967 (1984). For large a about sqrt(2 a
/// ln(1/tolerance)) terms are necessary.
#pragma once

#include <vector>

namespace clepsydra
{

/// The coefficients c_0, c_1 ... up to the term after which all others add up to less than the tolerance. All are
/// positive, and they are scaled so that they add up to one and the series is exact at x = 1.
/// \param exponent  a >= 0, without upper limit
/// \param tolerance  largest error of the series on [-1, 1], in (0, 1)
std::vector<double> chebyshevExponential(double exponent, double tolerance);

} // namespace clepsydra
