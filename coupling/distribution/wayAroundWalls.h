#pragma once

#include "distribution/boxTree.h"
#include "engine/periodicBox.h"

#include "fvMesh.H"

#include <array>
#include <vector>

namespace clepsydra
{

/// How much of a Gaussian exp(-r2/b2) reaches a cell that is behind the plane of a wall, where the wall ends.
///
/// A wall ends at its rims: the edges of a baffle, and the edges at which a wall bends away from the fluid. Where the
/// straight way from the centre of a particle to the centre of a cell is free, the cell has its full share. Where it
/// leads through a wall, the way around the nearest rim of that wall counts with its whole length L: the share is
/// multiplied by exp(-(L2 - r2)/b2). At the rim L equals r, so the share is continuous in the position of the particle.
///
/// Every rank stores the walls of all ranks, so the result does not depend on the decomposition. Where the mesh is
/// periodic, the walls repeat themselves, and a wall that reaches a cyclic patch does not end there.
class WayAroundWalls
{
public:
    /// Collective.
    explicit WayAroundWalls(const Foam::fvMesh& mesh);

    /// Factor in [0, 1] of the share of a cell of this rank. It is 0 where no rim is so near that more than exp(-9) of
    /// the kernel's peak passes around it. Local.
    double factor(const Vector3d& centre, Foam::label cell, double bandwidth) const;

private:
    /// Part of a face where the mesh ends; its normal points out of the fluid.
    struct Triangle
    {
        std::array<Vector3d, 3> corners;
        Vector3d normal;
        int surface;
    };
    /// An edge where two surfaces end.
    struct Rim
    {
        Vector3d first;
        Vector3d last;
        std::array<int, 2> surfaces;
    };

    /// Length of the shortest way over an edge [m].
    static double wayOver(const Rim& rim, const Vector3d& from, const Vector3d& to);
    /// Whether the straight way passes a triangle from the wall's side to the fluid's.
    static bool emergesFrom(const Triangle& triangle, const Vector3d& from, const Vector3d& to);

    const Foam::fvMesh& mesh_;
    const PeriodicBox periodic_;
    std::vector<Triangle> triangles_;
    std::vector<Rim> rims_;
    BoxTree triangleBoxes_;
    BoxTree rimBoxes_;
};

} // namespace clepsydra
