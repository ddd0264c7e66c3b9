#pragma once

#include "modelLines.h"

namespace clepsydra
{

/// What a force is in the equation of motion of a particle. The forces of two models of one family would add up, so a
/// run has at most one model of each family, except of `other`.
enum class ForceFamily
{
    drag,
    pressureGradient,
    viscousStress,
    buoyancy,
    addedMass,
    history,
    /// Lift in a sheared fluid (Saffman).
    shearLift,
    /// Lift of a rotating particle (Magnus).
    rotationLift,
    lubrication,
    /// Torque on a rotating particle, in the equation of its rotation.
    torque,
    /// Forces that the program does not know, such as that of a magnet.
    other
};

/// Where the reaction to a force acts; see ForceSum.
enum class ReactionPlace
{
    source,   ///< a source of the fluid
    inFluid,  ///< already in the fluid's equation, or on the walls of the tank
    mutual,   ///< another particle or a wall
    couple,   ///< a couple in the fluid's momentum equation, see TorqueReaction
    ofOwnKind ///< as the model itself states
};

/// A family of forces as messages and the report at the start of the log present it. SI units, with the pressure in Pa.
struct ForceFamilyText
{
    const char* name;
    /// The term in the equation of motion, with its sign.
    const char* term;
    ReactionPlace reaction;
    /// Entry of forceModels that leaves the term out of the equations; empty where these do not ask for it.
    const char* leftOutBy;
};

const ForceFamilyText& textOf(ForceFamily family);

/// Lines on force models as `pimpleDemFoam -listModels` prints them. They also tell messages which models a family has.
class ForceLines : public ModelLines
{
public:
    ForceLines(ForceFamily family, std::initializer_list<std::pair<const char*, const char*>> lines);

    /// Names of all models of a family in the program, sorted.
    static Foam::wordList namesOf(ForceFamily family);
};

} // namespace clepsydra
