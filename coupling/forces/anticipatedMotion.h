#pragma once

#include "couplingState.h"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

/// How a particle will answer in the next interval to the fluid that is being solved for.
struct AnticipatedMotion
{
    /// Impulse of the drag that the particle will receive for every m/s by which the fluid is faster than the particle is now
    /// [kg].
    double drag = 0;
    /// Part of the fluid's velocity relative to the particle by which the particle's mean velocity over the interval will differ
    /// from that now; also the part of another force's impulse that the drag will take from the particle.
    double velocityResponse = 0;
    /// Change of that mean velocity by another force [m/(N s)].
    double pressureResponse = 0;
};

/// From m dv/dt = K (U - v) + F, m with the added mass, over the time dt, with x = K dt/m and b = (1 - exp(-x))/x:
///
///     following = 1 - b,    pressureResponse = dt (1 - b)/(x m)
///
/// The drag's impulse would be m (1 - exp(-K dt/m)) (U - v) for a particle that nothing holds, here with the particle's own mass
/// alone: in long intervals that is the drag's less what the added mass hands back. It is K dt (U - v), which is more, for
/// one that contacts hold. What share was held is read from the last interval: the part of the impulse that the
/// particle's own momentum did not take up. A particle whose velocity is the same to the last bit is held fast by the engine.
///
/// \param received  of the last interval
/// \param changeOfVelocity  of the particle over the last interval [m/s]
/// \param lastTimeStep  that length [s]
/// \param nextTimeStep  dt [s]
inline AnticipatedMotion anticipatedMotion(
    const ReceivedImpulse& received, const Vector3d& changeOfVelocity, double mass, double lastTimeStep, double nextTimeStep)
{
    const double fixedDrag = nextTimeStep / lastTimeStep * received.implicitCoefficientTime;
    if (changeOfVelocity.isZero(0))
    {
        return {fixedDrag, 0, 0};
    }
    const double inertia = mass + received.addedMassTime / lastTimeStep;
    const double freeDrag = -mass * std::expm1(-fixedDrag / mass);
    const double impulseSqr = received.impulse.squaredNorm();
    const double takenUp =
        impulseSqr > 0 ? std::clamp(mass * changeOfVelocity.dot(received.impulse) / impulseSqr, 0.0, 1.0) : 0;

    const double x = fixedDrag / inertia;
    // The series where the difference loses its digits.
    const double velocityResponsePerTime = x < 1e-4 ? 0.5 - x / 6 : (1 + std::expm1(-x) / x) / x;
    return {fixedDrag + takenUp * (freeDrag - fixedDrag), x * velocityResponsePerTime,
        nextTimeStep * velocityResponsePerTime / inertia};
}

} // namespace clepsydra
