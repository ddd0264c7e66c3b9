#pragma once

#include "distribution/boxTree.h"
#include "distribution/sphereInBox.h"
#include "distribution/wayAroundWalls.h"
#include "engine/particles.h"

#include "fvMesh.H"
#include "volFields.H"

#include <array>
#include <vector>

namespace clepsydra
{

/// The cells as intersections of slabs, which give the share of a sphere in each cell.
///
/// In a brick along the axes the share is the exact part of the sphere's volume. Any other cell is treated as the
/// intersection of slabs, each between two opposite faces (or behind one face, where no other is opposite). The share
/// of a sphere in a slab follows from the two planes, and the share in the cell is the product over its slabs; where an
/// edge of the cell passes through the sphere, the error is up to a tenth of the sphere. On bricks the shares of all
/// cells add up to one for any position and size of the sphere; elsewhere they nearly do, and the caller normalises
/// them. The share has a continuous derivative with respect to the sphere's position. It depends on the sphere and the
/// cell only, not on the cell of the last coupling step and not on the decomposition of the mesh.
///
/// A wall does not reduce a share, because a particle touches a wall and does not pass it. A cell therefore has the
/// full share on the fluid's side of its wall faces, and at most behindWall of a particle whose centre is behind one of
/// them. This prevents solid volume from leaking through baffles of zero thickness.
///
/// The share behind a wall is not zero because the walls of the mesh differ from those of the engine: snappyHexMesh
/// cuts off edges into which a small particle can roll. A particle whose centre is behind walls of all cells therefore
/// belongs to the cells whose walls it is the least behind, as long as that distance is less than its radius.
class CellSlabs
{
public:
    /// Largest share behind a wall; beside any other share it is below rounding.
    static constexpr double behindWall = 1e-30;

    explicit CellSlabs(const Foam::fvMesh& mesh);

    /// Computes the slabs of the mesh as it is now, after its points have moved. Local.
    void meshMoved();

    const Foam::fvMesh& mesh() const
    {
        return mesh_;
    }

    /// Share of a sphere in one cell, not normalised, in [0, 1].
    /// \param radius  of the sphere [m]
    /// \param particleRadius  largest distance of the centre behind a wall [m]
    double share(Foam::label cell, const Vector3d& centre, double radius, double particleRadius) const;

    /// Share of a Gaussian exp(-r2/b2) in one cell, not normalised, in [0, 1]; walls are treated in the same way. A wide
    /// kernel reaches past the end of a wall, where the plane of a wall cuts nothing off: there, the way around it counts.
    double gaussianShare(Foam::label cell, const Vector3d& centre, double bandwidth, double particleRadius,
        const WayAroundWalls& aroundWalls) const;

    /// Cells whose bounding boxes intersect the cube around the sphere, in ascending order.
    void cellsNear(const Vector3d& centre, double radius, std::vector<Foam::label>& cells) const;

    /// Whether the cell's bounding box intersects the cube around the sphere.
    bool isNear(Foam::label cell, const Vector3d& centre, double radius) const
    {
        return cubeMeets(cellBoxes_[static_cast<std::size_t>(cell)], centre, radius);
    }

    /// Box around the cells of this rank.
    Box box() const
    {
        return cellBoxes_.around();
    }

private:
    struct Plane
    {
        Vector3d inwardNormal;
        double offset;
    };
    /// The faces on one side of a cell; there are several where the neighbours are finer.
    struct Side
    {
        int firstPlane;
        int planeCount;
        bool wall;
    };
    struct Slab
    {
        Side low;
        Side high;
    };

    /// A cell that is a box along the axes.
    struct Brick
    {
        bool isBrick = false;
        std::array<bool, 3> lowIsWall{};
        std::array<bool, 3> highIsWall{};
    };

    double shareInBrick(Foam::label cell, const Vector3d& centre, double radius) const;
    // \param cut  function of the signed distance [m] between the kernel's centre and a plane: the fraction of the
    // kernel on the inner side; a wall cuts nothing off
    template<class Cut>
    double fractionInside(const Side& side, const Vector3d& centre, const Cut& cut) const;
    template<class Cut>
    double shareInSlabs(Foam::label cell, const Vector3d& centre, const Cut& cut) const;
    double partBeforeWalls(Foam::label cell, const Vector3d& centre, double particleRadius) const;
    /// \return box around the cell
    Box addCell(const Foam::fvMesh& mesh, Foam::label cell);

    const Foam::fvMesh& mesh_;
    std::vector<Plane> planes_;
    std::vector<Slab> slabs_;
    std::vector<int> firstSlab_;
    std::vector<Brick> bricks_;
    mutable SphereInBox sphereInBox_;
    BoxTree cellBoxes_;
};

} // namespace clepsydra
