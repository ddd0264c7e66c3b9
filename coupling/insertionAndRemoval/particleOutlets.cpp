#include "insertionAndRemoval/particleOutlets.h"

#include "runTimeSelection.h"
#include "vectors.h"

#include "ListListOps.H"
#include "triSurface.H"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// The part of a sphere on one side of a plane.
struct Segment
{
    double share; // fraction of the sphere's volume
    double depth; // distance of its centroid from the plane, in radii
};

/// \param beyond  distance of the sphere's centre beyond the plane, in radii, from -1 to 1
Segment segmentWithin(double beyond)
{
    const double height = 1 - beyond;
    const double share = height * height * (3 - height) / 4;
    const double fromCentre = 3 * (2 - height) * (2 - height) / (4 * (3 - height));
    return {share, fromCentre - beyond};
}

} // namespace

ParticleOutlets::ParticleOutlets(const dictionary& couplingProperties, const fvMesh& mesh)
{
    readNames(couplingProperties, mesh);
    meshMoved(mesh);
}

void ParticleOutlets::meshMoved(const fvMesh& mesh)
{
    if (!names_.empty())
    {
        gatherFaces(mesh);
    }
}

void ParticleOutlets::readNames(const dictionary& couplingProperties, const fvMesh& mesh)
{
    const word entry = "particleOutlets";
    couplingProperties.readIfPresent(entry, names_);
    const wordList known = mesh.boundaryMesh().names();
    for (const word& name : names_)
    {
        const label patch = mesh.boundaryMesh().findPatchID(name);
        if (patch < 0)
        {
            FatalIOErrorInFunction(couplingProperties)
                << "Entry '" << entry << "' lists '" << name << "', which is not a patch of the mesh"
                << didYouMean(name, known).c_str() << "; allowed: " << flatOutput(known) << exit(FatalIOError);
        }
        if (mesh.boundaryMesh()[patch].coupled())
        {
            FatalIOErrorInFunction(couplingProperties) << "Entry '" << entry << "' lists '" << name
                                                       << "', which couples two parts of the mesh; allowed: patches "
                                                       << "at which the mesh ends" << exit(FatalIOError);
        }
        if (returnReduce(mesh.boundaryMesh()[patch].size(), sumOp<label>()) == 0)
        {
            FatalIOErrorInFunction(couplingProperties)
                << "Entry '" << entry << "' lists '" << name << "', which has no faces; allowed: patches with faces"
                << exit(FatalIOError);
        }
    }
}

void ParticleOutlets::gatherFaces(const fvMesh& mesh)
{
    // Three consecutive corners per triangle, and the outlet of each triangle.
    List<pointField> cornersOfRanks(Pstream::nProcs());
    List<labelList> outletsOfRanks(Pstream::nProcs());
    DynamicList<point> corners;
    DynamicList<label> outlets;
    forAll (names_, outlet)
    {
        const polyPatch& patch = mesh.boundaryMesh()[mesh.boundaryMesh().findPatchID(names_[outlet])];
        for (const face& patchFace : patch)
        {
            for (label corner = 1; corner + 1 < patchFace.size(); ++corner)
            {
                for (const label at : {label(0), corner, label(corner + 1)})
                {
                    corners.append(mesh.points()[patchFace[at]]);
                }
                outlets.append(outlet);
            }
        }
    }
    cornersOfRanks[Pstream::myProcNo()].transfer(corners);
    outletsOfRanks[Pstream::myProcNo()].transfer(outlets);
    Pstream::gatherList(cornersOfRanks);
    Pstream::scatterList(cornersOfRanks);
    Pstream::gatherList(outletsOfRanks);
    Pstream::scatterList(outletsOfRanks);

    const pointField points = ListListOps::combine<pointField>(cornersOfRanks, accessOp<pointField>());
    const labelList regions = ListListOps::combine<labelList>(outletsOfRanks, accessOp<labelList>());
    List<labelledTri> triangles(regions.size());
    forAll (triangles, triangle)
    {
        triangles[triangle] = labelledTri(3 * triangle, 3 * triangle + 1, 3 * triangle + 2, regions[triangle]);
    }
    bounds_ = boundBox(points, false);
    search_.reset(); // It refers to the surface.
    surface_ = std::make_unique<triSurface>(triangles, points);
    search_ = std::make_unique<triSurfaceSearch>(*surface_);
}

PartWithin ParticleOutlets::partWithin(const Vector3d& centre, double radius, double travel) const
{
    PartWithin part;
    const point at = toFoam(centre);
    const double farthest = reach(radius, travel);
    if (!search_ || magSqr(bounds_.nearest(at) - at) > sqr(farthest))
    {
        return part;
    }
    const pointIndexHit found = search_->tree().findNearest(at, sqr(farthest));
    if (!found.hit())
    {
        return part;
    }
    // The normal points outwards, as on all boundary faces.
    const vector normal = surface_->faceNormals()[found.index()];
    const vector fromSurface = at - found.hitPoint();
    const bool inside = (normal & fromSurface) <= 0;
    // On the inner side, the distance from the edge of an outlet is also the distance from the outlet.
    const double beyond = inside ? -mag(fromSurface) : normal & fromSurface;
    if (beyond <= -radius)
    {
        return part;
    }
    const vector inwards = inside && beyond < 0 ? fromSurface / -beyond : -normal;
    const Segment segment = segmentWithin(std::min(beyond / radius, 1.0));
    // A particle that has left entirely still needs a position inside, where its last impulse is transferred to the
    // fluid.
    constexpr double smallestDepth = 1e-2;
    part.outlet = (*surface_)[found.index()].region();
    part.share = segment.share;
    part.shift = toEigen(found.hitPoint() + radius * std::max(segment.depth, smallestDepth) * inwards - at);
    return part;
}

} // namespace clepsydra
