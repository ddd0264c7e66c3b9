/// \file
/// Constants that C++17 does not define.
#pragma once

namespace clepsydra::closures
{

inline constexpr double pi = 3.14159265358979323846;

/// Default of the formulas that start-up messages and tests use; a case sets its own value. Standard gravity is
/// 9.80665.
inline constexpr double defaultGravity = 9.81; // m/s2

} // namespace clepsydra::closures
