#pragma once

#include "engine/liggghts/scriptFacts.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace clepsydra
{

/// Constant motion of a rigid body.
struct RigidMotion
{
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();        ///< of the origin [m/s]
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();          ///< a point on the axis [m]
    Eigen::Vector3d angularVelocity = Eigen::Vector3d::Zero(); ///< [rad/s]

    Eigen::Vector3d at(const Eigen::Vector3d& position) const
    {
        return velocity + angularVelocity.cross(position - origin);
    }
};

/// A wall of the script whose surface moves.
struct WallMotion
{
    std::string fix;       ///< id of the fix that moves it
    ScriptCommand command; ///< of that fix; without a text where an `if` of the script has made it
    std::string kind;      ///< "move/mesh", "surface_vel", "surface_ang_vel", "shear"
    RigidMotion motion;
    /// Why the motion is not known; empty where it is.
    std::string unknownBecause;
};

/// The walls of a script that move: `fix move/mesh`, and the words `surface_vel` and `surface_ang_vel` of `mesh/surface` and
/// `shear` of `wall/gran`, which give a surface a velocity without moving its geometry.
std::vector<WallMotion> wallMotions(const ScriptFacts& facts);

} // namespace clepsydra
