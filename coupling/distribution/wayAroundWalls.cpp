#include "distribution/wayAroundWalls.h"

#include "distribution/cyclicPatches.h"
#include "vectors.h"

#include "ListListOps.H"
#include "Pstream.H"
#include "faceList.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace clepsydra
{

namespace
{

using Foam::label;
using Foam::labelList;

/// Faces whose normals differ by less than about 45 degrees belong to one surface.
constexpr double sameSurfaceCosine = 0.7;
/// Exponent of the kernel beyond which a way is too long to count.
constexpr double longestWaySqr = 9;
/// A way through the edge between two triangles meets one of them despite rounding.
constexpr double roundingOfPosition = 1e-9;

/// Faces of the boundaries of all ranks at which the mesh ends.
struct BoundaryFaces
{
    Foam::pointField points;
    Foam::faceList faces;
};

/// Collective.
BoundaryFaces gatherBoundary(const Foam::fvMesh& mesh)
{
    using namespace Foam;

    List<pointField> pointsOfRanks(Pstream::nProcs());
    List<labelList> sizesOfRanks(Pstream::nProcs());
    DynamicList<point> points;
    DynamicList<label> sizes;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        forAll (patch, face)
        {
            if (!patch.coupled())
            {
                points.append(patch[face].points(mesh.points()));
                sizes.append(patch[face].size());
            }
        }
    }
    pointsOfRanks[Pstream::myProcNo()].transfer(points);
    sizesOfRanks[Pstream::myProcNo()].transfer(sizes);
    Pstream::gatherList(pointsOfRanks);
    Pstream::scatterList(pointsOfRanks);
    Pstream::gatherList(sizesOfRanks);
    Pstream::scatterList(sizesOfRanks);

    BoundaryFaces all;
    const pointField corners = ListListOps::combine<pointField>(pointsOfRanks, accessOp<pointField>());
    const labelList faceSizes = ListListOps::combine<labelList>(sizesOfRanks, accessOp<labelList>());
    // Corners of faces that meet have the same coordinates, on any rank and on both sides of a baffle.
    std::map<std::array<double, 3>, label> places;
    DynamicList<point> different;
    labelList indices(corners.size());
    forAll (corners, corner)
    {
        const point& at = corners[corner];
        const auto [place, isNew] = places.try_emplace({at.x(), at.y(), at.z()}, different.size());
        indices[corner] = place->second;
        if (isNew)
        {
            different.append(at);
        }
    }
    all.points.transfer(different);
    all.faces.setSize(faceSizes.size());
    label first = 0;
    forAll (faceSizes, face)
    {
        all.faces[face] = Foam::face(labelList(SubList<label>(indices, faceSizes[face], first)));
        first += faceSizes[face];
    }
    return all;
}

/// The edges at the high ends of a periodic box as the same edges at its low ends.
class EdgesUnderImages
{
public:
    EdgesUnderImages(const Foam::pointField& points, const PeriodicBox& periodic)
    {
        for (Eigen::Index axis = 0; axis < 3; ++axis)
        {
            if (periodic.isPeriodic(axis))
            {
                imageAtLowEnd_.push_back(imagesAlong(axis, points, periodic));
            }
        }
    }

    /// The ends of the edge in ascending order. An edge that only touches an end of the box has no image there.
    std::array<label, 2> operator()(Foam::edge edge) const
    {
        for (const labelList& image : imageAtLowEnd_)
        {
            if (image[edge[0]] >= 0 && image[edge[1]] >= 0)
            {
                edge = Foam::edge(image[edge[0]], image[edge[1]]);
            }
        }
        return {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
    }

private:
    /// For each point at the high end along an axis, the one at the low end; -1 for any other point.
    static labelList imagesAlong(Eigen::Index axis, const Foam::pointField& points, const PeriodicBox& periodic)
    {
        const double length = periodic.length[axis];
        const double rounding = roundingOfMeshPoints * length;
        const auto isAt = [&](label point, double height) {
            return std::abs(toEigen(points[point])[axis] - periodic.low[axis] - height) <= rounding;
        };
        std::vector<label> atLowEnd;
        std::vector<Box> places;
        forAll (points, point)
        {
            if (isAt(point, 0))
            {
                atLowEnd.push_back(point);
                places.emplace_back(toEigen(points[point]), toEigen(points[point]));
            }
        }
        const BoxTree tree(std::move(places));
        labelList images(points.size(), -1);
        forAll (points, point)
        {
            if (isAt(point, length))
            {
                tree.forEachNear(toEigen(points[point]) - length * Vector3d::Unit(axis), rounding,
                    [&](int found) { images[point] = atLowEnd[static_cast<std::size_t>(found)]; });
            }
        }
        return images;
    }

    std::vector<labelList> imageAtLowEnd_;
};

/// Disjoint sets of faces.
class Surfaces
{
public:
    explicit Surfaces(label faceCount)
        : parent_(static_cast<std::size_t>(faceCount))
    {
        std::iota(parent_.begin(), parent_.end(), 0);
    }

    int of(int face)
    {
        while (parent_[static_cast<std::size_t>(face)] != face)
        {
            int& parent = parent_[static_cast<std::size_t>(face)];
            parent = parent_[static_cast<std::size_t>(parent)];
            face = parent;
        }
        return face;
    }

    void join(int a, int b)
    {
        parent_[static_cast<std::size_t>(of(a))] = of(b);
    }

private:
    std::vector<int> parent_;
};

} // namespace

WayAroundWalls::WayAroundWalls(const Foam::fvMesh& mesh)
    : mesh_(mesh),
      periodic_(periodicBoxOf(mesh))
{
    const BoundaryFaces boundary = gatherBoundary(mesh);
    const auto faceCount = static_cast<int>(boundary.faces.size());
    std::vector<Vector3d> normals;
    std::vector<Vector3d> centres;
    // The faces that meet at an edge or at its images, and the edge as one of them has it.
    struct FacesAtEdge
    {
        std::array<label, 2> edge;
        std::vector<int> faces;
    };
    std::map<std::array<label, 2>, FacesAtEdge> facesAtEdges;
    const EdgesUnderImages edgeOf(boundary.points, periodic_);
    for (int face = 0; face < faceCount; ++face)
    {
        normals.push_back(toEigen(boundary.faces[face].areaNormal(boundary.points)).normalized());
        centres.push_back(toEigen(boundary.faces[face].centre(boundary.points)));
        for (const Foam::edge& edge : boundary.faces[face].edges())
        {
            FacesAtEdge& at = facesAtEdges[edgeOf(edge)];
            at.edge = {std::min(edge[0], edge[1]), std::max(edge[0], edge[1])};
            at.faces.push_back(face);
        }
    }

    Surfaces surfaces(faceCount);
    const auto areSmooth = [&](int a, int b) { return normals[a].dot(normals[b]) > sameSurfaceCosine; };
    for (const auto& [key, at] : facesAtEdges)
    {
        const std::vector<int>& faces = at.faces;
        for (std::size_t i = 0; i < faces.size(); ++i)
        {
            for (std::size_t j = 0; j < i; ++j)
            {
                if (areSmooth(faces[i], faces[j]))
                {
                    surfaces.join(faces[i], faces[j]);
                }
            }
        }
    }
    const auto pointAt = [&](label point) { return toEigen(boundary.points[point]); };
    std::vector<Box> rimBoxes;
    for (const auto& [key, at] : facesAtEdges)
    {
        const auto& [edge, faces] = at;
        // Where more than two faces meet, a wall goes on or stands on another one.
        if (faces.size() != 2 || areSmooth(faces[0], faces[1]))
        {
            continue;
        }
        // Positive where the second face bends away from the fluid before the first; zero for the sides of a baffle.
        const double behind = periodic_.nearest(centres[faces[1]] - centres[faces[0]]).dot(normals[faces[0]]);
        const double length = (pointAt(edge[1]) - pointAt(edge[0])).norm();
        if (behind > -roundingOfPosition * length)
        {
            rims_.push_back({pointAt(edge[0]), pointAt(edge[1]), {surfaces.of(faces[0]), surfaces.of(faces[1])}});
            rimBoxes.emplace_back(
                rims_.back().first.cwiseMin(rims_.back().last), rims_.back().first.cwiseMax(rims_.back().last));
        }
    }
    rimBoxes_ = BoxTree(std::move(rimBoxes));
    if (rims_.empty())
    {
        return;
    }

    std::vector<Box> triangleBoxes;
    for (int face = 0; face < faceCount; ++face)
    {
        const Foam::face& corners = boundary.faces[face];
        for (label corner = 1; corner + 1 < corners.size(); ++corner)
        {
            const Triangle triangle{{pointAt(corners[0]), pointAt(corners[corner]), pointAt(corners[corner + 1])},
                normals[face], surfaces.of(face)};
            Box around;
            for (const Vector3d& point : triangle.corners)
            {
                around.extend(point);
            }
            triangles_.push_back(triangle);
            triangleBoxes.push_back(around);
        }
    }
    triangleBoxes_ = BoxTree(std::move(triangleBoxes));
}

double WayAroundWalls::wayOver(const Rim& rim, const Vector3d& from, const Vector3d& to)
{
    // Both points are turned about the edge into one plane, where the shortest way is straight.
    const double length = (rim.last - rim.first).norm();
    const Vector3d along = (rim.last - rim.first) / length;
    const double placeFrom = along.dot(from - rim.first);
    const double placeTo = along.dot(to - rim.first);
    const double awayFrom = (from - rim.first - placeFrom * along).norm();
    const double awayTo = (to - rim.first - placeTo * along).norm();
    const double both = awayFrom + awayTo;
    const double place = both > 0 ? placeFrom + (placeTo - placeFrom) * awayFrom / both : placeFrom;
    const Vector3d over = rim.first + std::clamp(place, 0.0, length) * along;
    return (from - over).norm() + (to - over).norm();
}

bool WayAroundWalls::emergesFrom(const Triangle& triangle, const Vector3d& from, const Vector3d& to)
{
    const auto& [a, b, c] = triangle.corners;
    const double before = triangle.normal.dot(from - a);
    const double after = triangle.normal.dot(to - a);
    if (!(before > 0 && after < 0))
    {
        return false;
    }
    const Vector3d at = from + before / (before - after) * (to - from);
    const double least = -roundingOfPosition * (b - a).cross(c - a).norm();
    const auto side = [&](const Vector3d& first, const Vector3d& second) {
        return (second - first).cross(at - first).dot(triangle.normal);
    };
    return side(a, b) >= least && side(b, c) >= least && side(c, a) >= least;
}

double WayAroundWalls::factor(const Vector3d& centre, Foam::label cell, double bandwidth) const
{
    // Not mesh_.C(), whose first call is collective: this function is called for the cells of one rank.
    const Vector3d to = toEigen(mesh_.cellCentres()[cell]);
    const double straightSqr = (to - centre).squaredNorm();
    const double longest = std::sqrt(straightSqr + longestWaySqr * bandwidth * bandwidth);
    // Not the walls are moved to their images, but the two points, which are near the image of a wall where their own
    // images are near the wall.
    struct NearRim
    {
        int rim;
        Vector3d away;
    };
    std::vector<NearRim> nearRims;
    periodic_.forEachImage(
        rimBoxes_.around(), centre, longest, [&](const Vector3d& image, const Eigen::Vector3i& periods) {
            const Vector3d away = periodic_.image(Vector3d::Zero(), periods);
            rimBoxes_.forEachNear(image, longest, [&](int rim) { nearRims.push_back({rim, away}); });
        });
    if (nearRims.empty())
    {
        return 0;
    }
    std::vector<int> passed;
    const Vector3d middle = 0.5 * (centre + to);
    const double half = 0.5 * (to - centre).cwiseAbs().maxCoeff();
    periodic_.forEachImage(
        triangleBoxes_.around(), middle, half, [&](const Vector3d& image, const Eigen::Vector3i& periods) {
            const Vector3d away = periodic_.image(Vector3d::Zero(), periods);
            triangleBoxes_.forEachNear(image, half, [&](int index) {
                const Triangle& triangle = triangles_[static_cast<std::size_t>(index)];
                if (emergesFrom(triangle, centre + away, to + away)
                    && std::find(passed.begin(), passed.end(), triangle.surface) == passed.end())
                {
                    passed.push_back(triangle.surface);
                }
            });
        });
    double detourSqr = 0;
    for (const int surface : passed)
    {
        // Not the longest one that counts: rounding would decide whether a surface without a rim nearby lets nothing pass.
        double shortest = std::numeric_limits<double>::infinity();
        for (const auto& [index, away] : nearRims)
        {
            const Rim& rim = rims_[static_cast<std::size_t>(index)];
            if (rim.surfaces[0] == surface || rim.surfaces[1] == surface)
            {
                shortest = std::min(shortest, wayOver(rim, centre + away, to + away));
            }
        }
        detourSqr += std::max(0.0, shortest * shortest - straightSqr);
    }
    const double longestDetourSqr = longestWaySqr * bandwidth * bandwidth;
    return detourSqr < longestDetourSqr ? std::exp(-detourSqr / (bandwidth * bandwidth)) : 0;
}

} // namespace clepsydra
