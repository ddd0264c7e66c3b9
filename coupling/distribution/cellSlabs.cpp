#include "distribution/cellSlabs.h"

#include "vectors.h"

#include "coupledPolyPatch.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clepsydra
{

using Foam::label;

namespace
{

/// Relative distance allowed between the planes of a brick and the box around its corners.
constexpr double roundingOfPlanes = 1e-9;
constexpr double infinitelyFar = std::numeric_limits<double>::infinity();
/// Faces of a cell whose normals differ by less than about 25 degrees bound it on the same side.
constexpr double sameSideCosine = 0.9;
/// Sides whose normals are within about 60 degrees of opposite directions bound the same slab.
constexpr double oppositeCosine = -0.5;
/// Exponent of the share behind walls: of two cells, nearly all goes to the one whose wall is half as far.
constexpr double behindWallExponent = 8;

bool isWallFace(const Foam::polyMesh& mesh, label face)
{
    if (mesh.isInternalFace(face))
    {
        return false;
    }
    const Foam::polyBoundaryMesh& patches = mesh.boundaryMesh();
    return !patches[patches.whichPatch(face)].coupled();
}

} // namespace

CellSlabs::CellSlabs(const Foam::fvMesh& mesh)
    : mesh_(mesh)
{
    meshMoved();
}

void CellSlabs::meshMoved()
{
    planes_.clear();
    slabs_.clear();
    bricks_.clear();
    firstSlab_.assign(1, 0);
    std::vector<Box> boxes;
    for (label cell = 0; cell < mesh_.nCells(); ++cell)
    {
        boxes.push_back(addCell(mesh_, cell));
        firstSlab_.push_back(static_cast<int>(slabs_.size()));
    }
    cellBoxes_ = BoxTree(std::move(boxes));
}

Box CellSlabs::addCell(const Foam::fvMesh& mesh, label cell)
{
    struct Group
    {
        Vector3d normal;
        std::vector<Plane> planes;
        bool wall;
    };
    std::vector<Group> groups;
    for (const label face : mesh.cells()[cell])
    {
        const double sign = mesh.faceOwner()[face] == cell ? -1 : 1;
        const Vector3d normal = sign * toEigen(mesh.faceAreas()[face]).normalized();
        const Plane plane{normal, normal.dot(toEigen(mesh.faceCentres()[face]))};
        const bool wall = isWallFace(mesh, face);
        const auto sameSide = std::find_if(groups.begin(), groups.end(),
            [&](const Group& group) { return group.wall == wall && group.normal.dot(normal) > sameSideCosine; });
        if (sameSide == groups.end())
        {
            groups.push_back({normal, {plane}, wall});
        }
        else
        {
            sameSide->planes.push_back(plane);
        }
    }

    Box cellBox;
    for (const label point : mesh.cellPoints()[cell])
    {
        cellBox.extend(toEigen(mesh.points()[point]));
    }
    Brick brick;
    brick.isBrick = groups.size() == 6;
    for (const Group& group : groups)
    {
        Eigen::Index axis = 0;
        group.normal.cwiseAbs().maxCoeff(&axis);
        const bool low = group.normal[axis] > 0;
        const double place = (low ? cellBox.min() : cellBox.max())[axis];
        brick.isBrick = brick.isBrick && std::all_of(group.planes.begin(), group.planes.end(), [&](const Plane& plane) {
            const Vector3d inBox = Vector3d::Unit(axis) * (low ? 1 : -1);
            return (plane.inwardNormal - inBox).norm() < roundingOfPlanes
                   && std::abs(plane.offset - inBox[axis] * place) < roundingOfPlanes * cellBox.sizes().maxCoeff();
        });
        (low ? brick.lowIsWall : brick.highIsWall)[axis] = group.wall;
    }
    bricks_.push_back(brick);

    const auto store = [&](const Group& group) {
        const Side side{static_cast<int>(planes_.size()), static_cast<int>(group.planes.size()), group.wall};
        planes_.insert(planes_.end(), group.planes.begin(), group.planes.end());
        return side;
    };
    while (!groups.empty())
    {
        const Group low = std::move(groups.back());
        groups.pop_back();
        Slab slab{store(low), {0, 0, false}};
        const auto high = std::min_element(groups.begin(), groups.end(),
            [&](const Group& a, const Group& b) { return a.normal.dot(low.normal) < b.normal.dot(low.normal); });
        if (high != groups.end() && high->normal.dot(low.normal) < oppositeCosine)
        {
            slab.high = store(*high);
            groups.erase(high);
        }
        slabs_.push_back(slab);
    }
    return cellBox;
}

template<class Cut>
double CellSlabs::fractionInside(const Side& side, const Vector3d& centre, const Cut& cut) const
{
    double fraction = 1;
    for (int i = side.firstPlane; !side.wall && i < side.firstPlane + side.planeCount; ++i)
    {
        fraction = std::min(fraction, cut(planes_[i].inwardNormal.dot(centre) - planes_[i].offset));
    }
    return fraction;
}

double CellSlabs::partBeforeWalls(label cell, const Vector3d& centre, double particleRadius) const
{
    double nearestPlane = 0;
    for (int slab = firstSlab_[cell]; slab < firstSlab_[cell + 1]; ++slab)
    {
        for (const Side& side : {slabs_[slab].low, slabs_[slab].high})
        {
            for (int i = side.firstPlane; side.wall && i < side.firstPlane + side.planeCount; ++i)
            {
                nearestPlane = std::min(nearestPlane, planes_[i].inwardNormal.dot(centre) - planes_[i].offset);
            }
        }
    }
    return nearestPlane == 0
               ? 1
               : behindWall * std::pow(std::max(0.0, 1 + nearestPlane / particleRadius), behindWallExponent);
}

template<class Cut>
double CellSlabs::shareInSlabs(label cell, const Vector3d& centre, const Cut& cut) const
{
    double share = 1;
    for (int slab = firstSlab_[cell]; slab < firstSlab_[cell + 1] && share > 0; ++slab)
    {
        const double low = fractionInside(slabs_[slab].low, centre, cut);
        const double high = fractionInside(slabs_[slab].high, centre, cut);
        share *= std::max(0.0, low + high - 1);
    }
    return share;
}

double CellSlabs::share(label cell, const Vector3d& centre, double radius, double particleRadius) const
{
    const double before = partBeforeWalls(cell, centre, particleRadius);
    if (before == 0)
    {
        return 0;
    }
    const auto cut = [radius](double distance) { return partInHalfSpace(distance / radius); };
    return before * (bricks_[cell].isBrick ? shareInBrick(cell, centre, radius) : shareInSlabs(cell, centre, cut));
}

double CellSlabs::shareInBrick(label cell, const Vector3d& centre, double radius) const
{
    const Box& box = cellBoxes_[static_cast<std::size_t>(cell)];
    const Brick& brick = bricks_[cell];
    const auto distance = [perRadius = 1 / radius](
                              double inside, bool wall) { return wall ? infinitelyFar : inside * perRadius; };
    std::array<SlabAboutSphere, 3> slabs;
    for (int axis = 0; axis < 3; ++axis)
    {
        slabs[axis] = {distance(centre[axis] - box.min()[axis], brick.lowIsWall[axis]),
            distance(box.max()[axis] - centre[axis], brick.highIsWall[axis])};
    }
    return sphereInBox_(slabs);
}

double CellSlabs::gaussianShare(label cell, const Vector3d& centre, double bandwidth, double particleRadius,
    const WayAroundWalls& aroundWalls) const
{
    double before = partBeforeWalls(cell, centre, particleRadius);
    if (before < 1)
    {
        before = std::max(before, aroundWalls.factor(centre, cell, bandwidth));
    }
    const auto cut = [bandwidth](double distance) { return 0.5 * std::erfc(-distance / bandwidth); };
    return before == 0 ? 0 : before * shareInSlabs(cell, centre, cut);
}

void CellSlabs::cellsNear(const Vector3d& centre, double radius, std::vector<label>& cells) const
{
    cells.clear();
    cellBoxes_.forEachNear(centre, radius, [&](label cell) { cells.push_back(cell); });
    std::sort(cells.begin(), cells.end());
}

} // namespace clepsydra
