/// \file
/// The exponential function as a short sum of Chebyshev polynomials.
///
///     exp(-a (1 - x)) = sum_k c_k T_k(x) on [-1, 1],    c_0 = e^-a I_0(a),  c_k = 2 e^-a I_k(a)
///
/// I_k are the modified Bessel functions: Abramowitz & Stegun, Handbook of Mathematical Functions (1964), 9.6.34. For the
/// exponential of a matrix: Tal-Ezer & Kosloff, J. Chem. Phys. 81, 3967 (1984). About sqrt(2 a ln(1/tolerance)) terms are
/// needed for large a.
#pragma once

#include <vector>

namespace clepsydra
{

/// The coefficients c_0, c_1 ... up to where all that follow add up to less than a tolerance. All are positive and they
/// are scaled by that last bit to add up to one, so that the sum is exact at x = 1.
/// \param exponent  a >= 0, of any size
/// \param tolerance  largest error of the sum on [-1, 1], in (0, 1)
std::vector<double> chebyshevExponential(double exponent, double tolerance);

} // namespace clepsydra
