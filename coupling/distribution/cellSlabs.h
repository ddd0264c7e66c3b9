#pragma once

#include "distribution/sphereInBox.h"
#include "engine/particles.h"

#include "fvMesh.H"
#include "volFields.H"

#include <array>
#include <vector>

namespace clepsydra
{

/// The cells as slabs that cross, for the share of a sphere that lies in each.
///
/// The share in a brick along the axes is the part of the sphere that lies in it. Any other cell is taken as the
/// intersection of slabs, each between two opposite faces (or one face, where nothing is opposite): the share of a sphere
/// in a slab follows from the two planes alone, and the share in the cell is the product over its slabs; where a cell's
/// edge passes through the sphere that is off by up to a tenth of the sphere. On bricks the shares of all cells add up
/// to one for any position and size of the sphere; elsewhere they nearly do and the caller normalises. The share has a
/// continuous derivative in the sphere's position, and depends on nothing but the sphere and the cell: not on the host
/// cell of the last interval, not on how the mesh is decomposed.
///
/// A wall bounds no share: a particle does not reach through a wall, it touches it. So a cell has the full share on the
/// fluid's side of its wall faces, and next to none, behindWall at most, of a particle whose centre lies behind one. This is
/// what keeps the solid volume from leaking through baffles of zero thickness.
///
/// Next to none and not none, because the mesh's walls are not quite the engine's: snappyHexMesh cuts an edge short that
/// a small particle rolls into. A particle whose centre is in front of no cell's walls so belongs to the cells whose walls it is
/// the least behind, as long as that is less than its radius.
class CellSlabs
{
public:
    /// Beside any other share it is lost in rounding.
    static constexpr double behindWall = 1e-30;

    explicit CellSlabs(const Foam::fvMesh& mesh);

    /// Share of a sphere in one cell, not normalised, in [0, 1].
    /// \param radius      of the sphere [m]
    /// \param particleRadius  how far behind a wall its centre may be [m]
    double share(Foam::label cell, const Vector3d& centre, double radius, double particleRadius) const;

    /// Share of a Gaussian exp(-r2/b2) in one cell, not normalised, in [0, 1]; the same rule at walls.
    double gaussianShare(Foam::label cell, const Vector3d& centre, double bandwidth, double particleRadius) const;

    /// Cells whose bounding box meets the cube about the sphere, by growing label.
    void cellsNear(const Vector3d& centre, double radius, std::vector<Foam::label>& cells) const;

    /// Whether the cell's bounding box meets the cube about the sphere.
    bool isNear(Foam::label cell, const Vector3d& centre, double radius) const
    {
        return cubeMeets(cellBoxes_[cell], centre, radius);
    }

    /// Box around the cells of this rank.
    const Box& box() const
    {
        return box_;
    }

private:
    struct Plane
    {
        Vector3d inwardNormal;
        double offset;
    };
    /// The faces on one side of a cell: several where the neighbours are finer.
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
    // cut: fraction of the kernel on the inner side of a plane at a signed distance [m] from its centre; a wall cuts nothing
    template<class Cut>
    double fractionInside(const Side& side, const Vector3d& centre, const Cut& cut) const;
    template<class Cut>
    double shareInSlabs(Foam::label cell, const Vector3d& centre, const Cut& cut) const;
    double partBeforeWalls(Foam::label cell, const Vector3d& centre, double particleRadius) const;
    void addCell(const Foam::fvMesh& mesh, Foam::label cell);
    void makeBins(const Foam::fvMesh& mesh);
    Eigen::Vector3i binOf(const Vector3d& point) const;

    std::vector<Plane> planes_;
    std::vector<Slab> slabs_;
    std::vector<int> firstSlab_;
    std::vector<Brick> bricks_;
    mutable SphereInBox sphereInBox_;

    Box box_;
    std::vector<Box> cellBoxes_;
    Eigen::Vector3i binCount_ = Eigen::Vector3i::Ones();
    Vector3d binSize_ = Vector3d::Ones();
    std::vector<int> firstInBin_;
    std::vector<Foam::label> cellsInBins_;
};

} // namespace clepsydra
