#pragma once

#include "couplingState.h"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

/// Expected response of a particle in the next coupling step to the fluid's velocity and pressure that are being solved
/// for.
struct AnticipatedMotion
{
    /// Impulse of the drag on the particle per difference between the fluid's velocity and the particle's present one
    /// [kg].
    double drag = 0;
    /// Change of the particle's mean velocity over the coupling step divided by the slip velocity [-]. It is also the
    /// fraction of another force's impulse that drag transfers to the fluid.
    double velocityResponse = 0;
    /// Change of that mean velocity per force on the particle [m/(N s)].
    double pressureResponse = 0;
    /// Impulse of the added mass on the particle per difference between the fluid's velocity that is solved for and
    /// `fluidVelocity` [kg]; see implicitAddedMass().
    double addedMass = 0;
    /// Velocity of the fluid at the particle before the step that is solved [m/s].
    Vector3d fluidVelocity = Vector3d::Zero();
};

/// Part of a particle's added mass m_a whose reaction to DU/Dt must be implicit in the fluid's equation [kg].
///
/// DU/Dt of one step acts on the particles in the next one, and so does the reaction on the fluid. Where particles are
/// held, or are too heavy to follow, each step multiplies a change of U by -m_a over the fluid's mass per particle: it
/// grows above 1, whatever the step. With the coefficient 1/2 this ratio is below 1 up to a solid fraction of 2/3, with
/// Zuber's it is 1 at 0.4 and 4 at 0.6. What is above 1 is implicit, and the rest is as stable as at 1.
///
/// \param fluidMass  rho_f V_p eps/(1 - eps), of the fluid per particle [kg]
inline double implicitAddedMass(double addedMass, double fluidMass)
{
    return std::max(0.0, addedMass - fluidMass);
}

/// Solves m dv/dt = K (U - v) + F over the time dt, where m includes the added mass. With x = K dt/m and b = (1 -
/// exp(-x))/x:
///
///     velocityResponse = 1 - b,    pressureResponse = dt (1 - b)/(x m)
///
/// The drag's impulse is m (1 - exp(-K dt/m)) (U - v) on a free particle. Here m is the particle's own mass alone,
/// because in a long coupling step the added mass gives back the rest. On a particle that contacts hold in place the
/// impulse is K dt (U - v), which is larger. The fraction for which contacts account is taken from the last coupling
/// step: it is the part of the impulse that did not change the particle's momentum. A particle whose velocity is
/// unchanged to the last bit is treated as fixed.
///
/// \param received  what the particle received in the last coupling step
/// \param changeOfVelocity  of the particle over the last coupling step [m/s]
/// \param mass  of the particle [kg]
/// \param lastTimeStep  length of the last coupling step [s]
/// \param nextTimeStep  length dt of the next coupling step [s]
inline AnticipatedMotion anticipatedMotion(const ReceivedImpulse& received, const Vector3d& changeOfVelocity,
    double mass, double lastTimeStep, double nextTimeStep)
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
    // The series replaces the difference where that loses its digits.
    const double velocityResponsePerTime = x < 1e-4 ? 0.5 - x / 6 : (1 + std::expm1(-x) / x) / x;
    return {fixedDrag + takenUp * (freeDrag - fixedDrag), x * velocityResponsePerTime,
        nextTimeStep * velocityResponsePerTime / inertia};
}

} // namespace clepsydra
