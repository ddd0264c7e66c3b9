#pragma once

#include <array>
#include <cstddef>

namespace clepsydra
{

/// Contacts between particles, each quantity of all of them side by side, as vector units take them. SI units.
struct HertzContacts
{
    static constexpr std::size_t most = 64;
    using Values = std::array<double, most>;
    using Vectors = std::array<Values, 3>;

    std::size_t count = 0;

    /// Of particle i from particle j.
    Vectors distance;
    Vectors velocity;
    Values radiusI;
    Values radiusJ;
    Values massI;
    Values massJ;
    Vectors angularVelocityI;
    Vectors angularVelocityJ;
    /// Of the two materials: effective Young's and shear modulus, damping by restitution (negative), friction.
    Values youngsModulus;
    Values shearModulus;
    Values damping;
    Values friction;

    /// Tangential displacement since the particles met: taken and brought up to date.
    Vectors shear;

    /// On particle i; particle j has the opposite.
    Vectors force;
    Vectors torqueI;
    Vectors torqueJ;
};

/// LIGGGHTS' `model hertz tangential history` (normal_model_hertz.h, tangential_model_history.h) with its operations in
/// their order: the same results to the last bit.
/// \param shearStep  time by which the shear grows [s]; 0 leaves it as it is
void evaluateHertz(HertzContacts& contacts, double shearStep);

} // namespace clepsydra
