#pragma once

#include <array>
#include <cstddef>

namespace clepsydra
{

/// Contacts between particles, with each quantity of all contacts side by side for vector units. SI units.
struct HertzContacts
{
    static constexpr std::size_t most = 64;
    using Values = std::array<double, most>;
    using Vectors = std::array<Values, 3>;

    std::size_t count = 0;

    /// Position and velocity of particle i relative to particle j.
    Vectors distance;
    Vectors velocity;
    Values radiusI;
    Values radiusJ;
    Values massI;
    Values massJ;
    Vectors angularVelocityI;
    Vectors angularVelocityJ;
    /// Properties of the pair of materials: effective Young's and shear modulus, damping coefficient from restitution
    /// (negative), friction coefficient.
    Values youngsModulus;
    Values shearModulus;
    Values damping;
    Values friction;
    /// Coefficient of rolling friction; read with rolling friction only.
    Values rollingFriction;

    /// Tangential displacement since the start of the contact; updated.
    Vectors shear;

    /// Results. The force acts on particle i; particle j has the opposite one.
    Vectors force;
    Vectors torqueI;
    Vectors torqueJ;
};

/// The contact law `model hertz tangential history` of LIGGGHTS (normal_model_hertz.h, tangential_model_history.h). It
/// has LIGGGHTS' operations in their order, so the results are the same to the last bit.
/// \param shearStep  time over which the tangential displacement grows [s]; 0 leaves it unchanged
void evaluateHertz(HertzContacts& contacts, double shearStep);

/// The same with `rolling_friction cdt` (rolling_model_cdt.h): a torque of constant size against the relative rotation,
/// without its part about the normal (Ai et al., Powder Technology 206, 2011, model A).
void evaluateHertzRolling(HertzContacts& contacts, double shearStep);

} // namespace clepsydra
