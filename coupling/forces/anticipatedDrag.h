#pragma once

#include "engine/beads.h"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

/// The impulse that a bead will receive from the drag of the next interval for every m/s by which the fluid is then
/// faster than the bead is now [kg].
///
/// With K the drag's coefficient and m the bead's mass, a bead under drag alone takes m (1 - exp(-K dt/m)), which is
/// the exact solution of m dv/dt = K (U - v) over dt; a bead that contacts (or a fixed place) hold takes K dt, which is
/// more. What share of the drag was held is read from the last interval: the part of the impulse that the bead's own
/// momentum did not take up.
///
/// \param given  of the last interval
/// \param changeOfVelocity  of the bead over the last interval [m/s]
/// \param nextOverLast  length of the next interval over that of the last
inline double anticipatedDragCoefficient(
    const GivenToFluid& given, const Vector3d& changeOfVelocity, double mass, double nextOverLast)
{
    const double held = nextOverLast * given.implicitCoefficientTime;
    const double free = -mass * std::expm1(-held / mass);
    const double impulseSqr = given.impulse.squaredNorm();
    const double takenUp =
        impulseSqr > 0 ? std::clamp(mass * changeOfVelocity.dot(given.impulse) / impulseSqr, 0.0, 1.0) : 0;
    return held + takenUp * (free - held);
}

} // namespace clepsydra
