#pragma once

#include "couplingState.h"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

/// How a bead will answer in the next interval to the fluid that is being solved for.
struct AnticipatedMotion
{
    /// Impulse of the drag that the bead will receive for every m/s by which the fluid is faster than the bead is now
    /// [kg].
    double drag = 0;
    /// Part of the fluid's velocity relative to the bead by which the bead's mean velocity over the interval will differ
    /// from that now; also the part of another force's impulse that the drag will take from the bead.
    double following = 0;
    /// Change of that mean velocity by another force [m/(N s)].
    double mobility = 0;
};

/// From m dv/dt = K (U - v) + F, m with the added mass, over the time dt, with x = K dt/m and b = (1 - exp(-x))/x:
///
///     following = 1 - b,    mobility = dt (1 - b)/(x m)
///
/// The drag's impulse would be m (1 - exp(-K dt/m)) (U - v) for a bead that nothing holds, here with the bead's own mass
/// alone: in long intervals that is the drag's less what the added mass hands back. It is K dt (U - v), which is more, for
/// one that contacts hold. What share was held is read from the last interval: the part of the impulse that the
/// bead's own momentum did not take up. A bead whose velocity is the same to the last bit is held fast by the engine.
///
/// \param given  of the last interval
/// \param changeOfVelocity  of the bead over the last interval [m/s]
/// \param lastInterval  that length [s]
/// \param nextInterval  dt [s]
inline AnticipatedMotion anticipatedMotion(
    const GivenToFluid& given, const Vector3d& changeOfVelocity, double mass, double lastInterval, double nextInterval)
{
    const double heldDrag = nextInterval / lastInterval * given.implicitCoefficientTime;
    if (changeOfVelocity.isZero(0))
    {
        return {heldDrag, 0, 0};
    }
    const double inertia = mass + given.addedMassTime / lastInterval;
    const double freeDrag = -mass * std::expm1(-heldDrag / mass);
    const double impulseSqr = given.impulse.squaredNorm();
    const double takenUp =
        impulseSqr > 0 ? std::clamp(mass * changeOfVelocity.dot(given.impulse) / impulseSqr, 0.0, 1.0) : 0;

    const double x = heldDrag / inertia;
    // The series where the difference loses its digits.
    const double followingPerTime = x < 1e-4 ? 0.5 - x / 6 : (1 + std::expm1(-x) / x) / x;
    return {
        heldDrag + takenUp * (freeDrag - heldDrag), x * followingPerTime, nextInterval * followingPerTime / inertia};
}

} // namespace clepsydra
