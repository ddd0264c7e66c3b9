#pragma once

#include <Eigen/Core>

#include <filesystem>

namespace clepsydra
{

/// What is drawn of the beads; one row or column per bead. SI units.
struct DrawnBeads
{
    Eigen::ArrayXi id;
    Eigen::Matrix3Xd position;
    Eigen::Matrix3Xd velocity;
    Eigen::Matrix3Xd angularVelocity;
    Eigen::ArrayXd radius;
    /// Of the fluid at the bead; 1 without fluid.
    Eigen::ArrayXd voidFraction;
};

/// Writes the beads as vertices with point data id, radius, velocity, angularVelocity, voidFraction and speed, for
/// ParaView (binary). Local. \throws std::runtime_error naming the file where it cannot be written.
void writeVtp(const std::filesystem::path& file, const DrawnBeads& beads);

} // namespace clepsydra
