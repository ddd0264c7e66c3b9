/// \file
/// Coarse graining: a parcel of diameter a d, with the size factor a >= 1, moves in place of a^3 particles of diameter
/// d and has their density, velocity and volume.
///
/// Forces of the fluid and gravity: a^3 times those on ONE REAL PARTICLE, i.e. the drag law is evaluated with the real
/// diameter, the slip and the void fraction of the parcel. The parcel then has the relaxation time, the terminal
/// velocity and the minimum fluidisation velocity of the real particles. A drag law that is given the parcel's diameter
/// instead has, in creeping flow, a^2 times the relaxation time.
///
/// Contacts: two rules, which differ in what they keep.
///
///   - C. Bierwisch, T. Kraft, H. Riedel & M. Moseler, J. Mech. Phys. Solids 57, 10 (2009): the density of energy,
///     hence the stress. Overlaps scale with a and forces with a^2. With Hertz' law the elastic modulus stays as it is,
///     as do the coefficients of restitution and friction; collisions last a times as long.
///   - M. Sakai & S. Koshizuka, Chem. Eng. Sci. 64, 533 (2009): the a^3 particles of one parcel collide with those of
///     the other in pairs at the same time. At a given overlap the forces are a^3 times those of one pair; collisions
///     last as long as real ones.
///
/// Both keep the coefficient of restitution. Range: the flow must not change over the size of a parcel.
#pragma once

#include "closures/particleInFluid.h"

namespace clepsydra::closures
{

/// Number of particles that a parcel represents.
inline double particlesPerParcel(double sizeFactor) noexcept
{
    return sizeFactor * sizeFactor * sizeFactor;
}

/// Sp of a parcel [kg/s].
/// \param particle  one real particle, with the void fraction and the slip of the parcel
template<class DragLaw>
double parcelDrag(const DragLaw& drag, const ParticleInFluid& particle, double sizeFactor)
{
    return particlesPerParcel(sizeFactor) * drag(particle);
}

/// Factors on the quantities of a contact of two real particles.
struct ParcelContact
{
    double springStiffness; // of a linear spring
    double damping;         // of a linear dashpot
    double hertzModulus;    // elastic modulus of Hertz' law
    double collisionTime;
};

inline ParcelContact bierwischContact(double sizeFactor) noexcept
{
    return {sizeFactor, sizeFactor * sizeFactor, 1.0, sizeFactor};
}

inline ParcelContact sakaiContact(double sizeFactor) noexcept
{
    const double number = particlesPerParcel(sizeFactor);
    return {number, number, number / std::sqrt(sizeFactor), 1.0};
}

} // namespace clepsydra::closures
