#pragma once

#include <Eigen/Dense>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace clepsydra::tests
{

/// A box along the axes, as fluid mesh and as walls of the particles. SI units.
struct Box
{
    Eigen::Vector3d lower = Eigen::Vector3d::Zero();
    Eigen::Vector3d upper = Eigen::Vector3d(0.02, 0.02, 0.04);
    /// Axes along which mesh and particles are periodic, without walls at the ends.
    std::array<bool, 3> periodic = {false, false, false};

    Eigen::Vector3d size() const
    {
        return upper - lower;
    }
};

/// A LIGGGHTS script: alike particles in a box, Hertz contacts. Every member may be changed by a test.
struct DemScript
{
    double diameter = 0.002;
    double density = 2500;
    std::vector<Eigen::Vector3d> particles;
    /// Particles that never move: no integration, yet the fluid's forces on them.
    bool fixed = false;
    /// Instead of `particles`: a file that `DEM/writeRestart` of couplingProperties has written.
    std::string readRestart;

    double timeStep = 2.5e-5;
    double gravity = 9.81;
    double youngsModulus = 5e6;
    double poissonsRatio = 0.2;
    double restitution = 0.9;
    double friction = 0.15;
    /// Against the box's sides; a negative one means `friction`.
    double wallFriction = -1;

    /// Planes at the box's faces, except along periodic axes.
    bool walls = true;
    /// Height of the bottom plane, where it is not the box's (a floor that lets the fluid through).
    double floor = std::numeric_limits<double>::quiet_NaN();

    /// DEM steps between two entries of DEM/particles.dump; 0: none.
    int dumpEvery = 0;
    /// Lines at the end of the script.
    std::string more;

    std::string text(const Box& box) const;
};

/// Points of a body-centred lattice that fills a box: two points per cell of nx x ny x nz, at 1/4 and 3/4.
std::vector<Eigen::Vector3d> bodyCentredLattice(const Box& box, const Eigen::Vector3i& cells);

/// Points of a simple lattice that fills a box, in the middle of each cell of nx x ny x nz.
std::vector<Eigen::Vector3d> simpleLattice(const Box& box, const Eigen::Vector3i& cells);

/// Moves every point by up to `amplitude` along each axis; the same seed gives the same points.
void jitter(std::vector<Eigen::Vector3d>& points, double amplitude, unsigned seed);

} // namespace clepsydra::tests
