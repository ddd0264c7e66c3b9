#include "wallsOfMovingMesh.h"

#include "distribution/boxTree.h"
#include "vectors.h"

#include "surfaceFields.H"
#include "triPointRef.H"
#include "wallFvPatch.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Largest differences of velocities; root mean squares over a patch, relative to that of its velocity. The triangles of a
/// curved wall are not the faces of the patch.
constexpr double toleranceOfTriangles = 0.02;
constexpr double toleranceAlongPatch = 1e-3;
constexpr double toleranceAcrossPatch = 0.05;
/// Largest flux of fluid through a wall, relative to the area times the velocity.
constexpr double toleranceOfFlux = 1e-3;
/// Of velocities, relative to that of the fastest patch.
constexpr double rounding = 1e-9;
/// Widths of a face within which a triangle is beside it.
constexpr double besideFace = 2;

const word patchesEntry("patchesWithoutDemWall");

/// Triangles where they are now, with their velocities over the last coupling step.
class MovedTriangles
{
public:
    template<class Triangles>
    MovedTriangles(const Triangles& before, const Triangles& now, double timeStep)
    {
        std::vector<Box> boxes;
        for (const auto& [name, corners] : now)
        {
            const auto old = before.find(name);
            if (old == before.end())
            {
                continue;
            }
            Moved moved{corners, {}, 0};
            Box around;
            for (std::size_t corner = 0; corner < corners.size(); ++corner)
            {
                moved.velocities[corner] = (corners[corner] - old->second[corner]) / timeStep;
                around.extend(corners[corner]);
            }
            const auto wall = std::find(walls_.begin(), walls_.end(), name.first);
            moved.wall = static_cast<std::size_t>(wall - walls_.begin());
            if (wall == walls_.end())
            {
                walls_.push_back(name.first);
                moving_.push_back(false);
            }
            moving_[moved.wall] = moving_[moved.wall]
                                  || std::any_of(moved.velocities.begin(), moved.velocities.end(),
                                      [](const Vector3d& v) { return v.squaredNorm() > 0; });
            triangles_.push_back(moved);
            boxes.push_back(around);
        }
        boxes_ = BoxTree(std::move(boxes));
    }

    const std::vector<std::string>& walls() const
    {
        return walls_;
    }

    bool hasMoved(std::size_t wall) const
    {
        return moving_[wall];
    }

    struct Nearest
    {
        Vector3d velocity = Vector3d::Zero();
        std::size_t wall = std::numeric_limits<std::size_t>::max();
    };

    /// Velocity of the nearest wall within a distance; none where there is no wall.
    Nearest nearest(const Vector3d& point, double within) const
    {
        Nearest found;
        double shortest = within;
        boxes_.forEachNear(point, within, [&](int index) {
            const Moved& moved = triangles_[static_cast<std::size_t>(index)];
            const Foam::point a = toFoam(moved.corners[0]);
            const Foam::point b = toFoam(moved.corners[1]);
            const Foam::point c = toFoam(moved.corners[2]);
            const triPointRef triangle(a, b, c);
            const pointHit there = triangle.nearestPoint(toFoam(point));
            if (there.distance() < shortest)
            {
                shortest = there.distance();
                const barycentric2D weights = triangle.pointToBarycentric(there.rawPoint());
                found = {weights[0] * moved.velocities[0] + weights[1] * moved.velocities[1]
                             + weights[2] * moved.velocities[2],
                    moved.wall};
            }
        });
        return found;
    }

private:
    struct Moved
    {
        std::array<Vector3d, 3> corners;
        std::array<Vector3d, 3> velocities;
        std::size_t wall;
    };

    std::vector<Moved> triangles_;
    std::vector<std::string> walls_;
    std::vector<bool> moving_;
    BoxTree boxes_;
};

/// Sums over the faces of a patch, and in the end over all ranks.
struct PatchSums
{
    PatchSums(std::size_t motions, std::size_t walls)
        : difference(motions, 0),
          across(motions, 0),
          facesNear(walls, 0)
    {}

    /// Times the area: square of the velocity that the wall must have, and of its difference from the nearest triangles.
    double speed = 0;
    double fromTriangles = 0;
    /// Times the area: square of the velocity of the mesh or the fluid, the larger one.
    double fastest = 0;
    /// Flux through the patch, and that of its speed [m3/s].
    double flux = 0;
    double largestFlux = 0;
    /// Times the area, for each motion of a wall along itself: squares of the difference along the patch, and of what is
    /// across it.
    std::vector<double> difference;
    std::vector<double> across;
    /// Number of faces whose nearest triangle is one of each wall.
    std::vector<double> facesNear;

    /// Appends all numbers to a list, or takes them from it.
    template<class Act>
    void forEach(const Act& act)
    {
        for (double* const number : {&speed, &fromTriangles, &fastest, &flux, &largestFlux})
        {
            act(*number);
        }
        for (std::vector<double>* const numbers : {&difference, &across, &facesNear})
        {
            std::for_each(numbers->begin(), numbers->end(), act);
        }
    }
};

PatchSums sumsOf(const fvPatchVectorField& onPatch, const fvMesh& mesh, const std::vector<WallMotion>& alongItself,
    const MovedTriangles& triangles)
{
    const fvPatch& patch = onPatch.patch();
    const double timeStep = mesh.time().deltaTValue();
    const scalarField& meshFlux = mesh.phi().boundaryField()[patch.index()];
    PatchSums sums(alongItself.size(), triangles.walls().size());
    forAll (onPatch, face)
    {
        const double area = patch.magSf()[face];
        const vector normal = patch.Sf()[face] / area;
        const vector ofMesh = (patch.Cf()[face] - patch.patch()[face].centre(mesh.oldPoints())) / timeStep;
        const vector ofWall = onPatch.fixesValue() ? onPatch[face] : meshFlux[face] / area * normal;
        sums.speed += area * magSqr(ofWall);
        const double fastest = std::max(mag(ofMesh), mag(onPatch[face]));
        sums.fastest += area * sqr(fastest);
        sums.flux += mag((onPatch[face] & patch.Sf()[face]) - meshFlux[face]);
        sums.largestFlux += area * fastest;
        const MovedTriangles::Nearest near = triangles.nearest(toEigen(patch.Cf()[face]), besideFace * std::sqrt(area));
        sums.fromTriangles += area * magSqr(toFoam(near.velocity) - ofWall);
        if (near.wall < sums.facesNear.size())
        {
            sums.facesNear[near.wall] += 1;
        }
        const Vector3d middle = toEigen(patch.Cf()[face] - 0.5 * timeStep * ofMesh);
        for (std::size_t i = 0; i < alongItself.size(); ++i)
        {
            const vector ofScript = toFoam(alongItself[i].motion.at(middle));
            const vector difference = ofScript - ofWall;
            sums.difference[i] += area * magSqr(difference - normal * (normal & difference));
            sums.across[i] += area * std::max(sqr(normal & ofScript), sqr(normal & ofWall));
        }
    }
    return sums;
}

/// Collective.
void addOverRanks(std::vector<PatchSums>& patches)
{
    DynamicList<scalar> all;
    for (PatchSums& patch : patches)
    {
        patch.forEach([&](double number) { all.append(number); });
    }
    Pstream::listCombineGather(all, plusEqOp<scalar>());
    Pstream::listCombineScatter(all);
    label next = 0;
    for (PatchSums& patch : patches)
    {
        patch.forEach([&](double& number) { number = all[next++]; });
    }
}

bool isSmall(double square, double tolerance, double ofSquare)
{
    return square <= sqr(tolerance) * ofSquare;
}

} // namespace

WallsOfMovingMesh::WallsOfMovingMesh(const fvMesh& mesh, const CouplingSettings& settings, const DemEngine& engine,
    const std::vector<WallMotion>& motions)
    : mesh_(mesh),
      settings_(settings),
      engine_(engine),
      allowed_(settings.dict().getOrDefault<wordRes>(patchesEntry, {})),
      before_(triangles())
{
    std::copy_if(motions.begin(), motions.end(), std::back_inserter(alongItself_),
        [](const WallMotion& wall) { return wall.kind != "move/mesh" && wall.unknownBecause.empty(); });
    const wordList patches = mesh.boundaryMesh().names();
    for (const wordRe& name : allowed_)
    {
        if (std::none_of(patches.begin(), patches.end(), [&](const word& patch) { return name.match(patch); }))
        {
            FatalIOErrorInFunction(settings.dict())
                << "Entry '" << patchesEntry << "' lists '" << name << "', which is not a patch of the mesh"
                << didYouMean(name, patches).c_str() << "; allowed: " << flatOutput(patches) << exit(FatalIOError);
        }
    }
}

WallsOfMovingMesh::Triangles WallsOfMovingMesh::triangles() const
{
    List<wordList> names(Pstream::nProcs());
    List<labelList> ids(Pstream::nProcs());
    List<scalarList> corners(Pstream::nProcs());
    {
        DynamicList<word> namesHere;
        DynamicList<label> idsHere;
        DynamicList<scalar> cornersHere;
        for (const WallTriangle& triangle : engine_.movingWalls())
        {
            namesHere.append(word(triangle.wall, false));
            idsHere.append(triangle.id);
            for (const Vector3d& corner : triangle.corners)
            {
                std::for_each(corner.begin(), corner.end(), [&](double place) { cornersHere.append(place); });
            }
        }
        const label here = Pstream::myProcNo();
        names[here].transfer(namesHere);
        ids[here].transfer(idsHere);
        corners[here].transfer(cornersHere);
    }
    Pstream::gatherList(names);
    Pstream::scatterList(names);
    Pstream::gatherList(ids);
    Pstream::scatterList(ids);
    Pstream::gatherList(corners);
    Pstream::scatterList(corners);
    Triangles all;
    forAll (names, rank)
    {
        forAll (names[rank], i)
        {
            auto& triangle = all[{names[rank][i], ids[rank][i]}];
            constexpr label numbers = 9;
            for (label at = 0; at < numbers; ++at)
            {
                triangle[static_cast<std::size_t>(at / 3)][at % 3] = corners[rank][numbers * i + at];
            }
        }
    }
    return all;
}

void WallsOfMovingMesh::check(const volVectorField& U)
{
    Triangles now = triangles();
    const MovedTriangles moved(before_, now, mesh_.time().deltaTValue());
    before_ = std::move(now);
    // All ranks have the same walls in the same order.
    std::vector<word> patches;
    std::vector<PatchSums> sums;
    for (const fvPatchVectorField& onPatch : U.boundaryField())
    {
        if (isA<wallFvPatch>(onPatch.patch()))
        {
            patches.push_back(onPatch.patch().name());
            sums.push_back(sumsOf(onPatch, mesh_, alongItself_, moved));
        }
    }
    addOverRanks(sums);
    double fastest = 0;
    for (const PatchSums& patch : sums)
    {
        fastest = std::max(fastest, patch.fastest);
    }

    std::set<std::string> matched;
    std::vector<bool> matchedAlongItself(alongItself_.size(), false);
    for (std::size_t index = 0; index < patches.size(); ++index)
    {
        const word& name = patches[index];
        const PatchSums& patch = sums[index];
        if (patch.flux > toleranceOfFlux * patch.largestFlux)
        {
            FatalErrorInFunction << "The patch '" << name
                                 << "' of type wall moves with the mesh, but U there does not: " << patch.flux
                                 << " m3/s of fluid would pass it; allowed: the condition "
                                 << "movingWallVelocity in the file U, or another one with the velocity of the mesh "
                                 << "across the patch" << exit(FatalError);
        }
        if (isSmall(patch.speed, rounding, fastest))
        {
            continue;
        }
        bool isMatched = isSmall(patch.fromTriangles, toleranceOfTriangles, patch.speed);
        for (std::size_t wall = 0; isMatched && wall < moved.walls().size(); ++wall)
        {
            if (patch.facesNear[wall] > 0)
            {
                matched.insert(moved.walls()[wall]);
            }
        }
        for (std::size_t i = 0; i < alongItself_.size(); ++i)
        {
            if (isSmall(patch.difference[i], toleranceAlongPatch, patch.speed)
                && isSmall(patch.across[i], toleranceAcrossPatch, patch.speed))
            {
                isMatched = true;
                matchedAlongItself[i] = true;
            }
        }
        if (!isMatched && !allowed_.match(name))
        {
            const double relative = std::sqrt(patch.fromTriangles / patch.speed);
            std::ostringstream text;
            text << "differ by " << 100 * relative << " % of it";
            refusePatch(name, moved.walls().empty() ? "do not exist" : text.str());
        }
    }
    for (std::size_t wall = 0; wall < moved.walls().size(); ++wall)
    {
        if (moved.hasMoved(wall) && matched.count(moved.walls()[wall]) == 0)
        {
            requirePatchFor(moved.walls()[wall], "move/mesh");
        }
    }
    for (std::size_t i = 0; i < alongItself_.size(); ++i)
    {
        if (!matchedAlongItself[i])
        {
            requirePatchFor(alongItself_[i].fix, alongItself_[i].kind);
        }
    }
}

void WallsOfMovingMesh::refusePatch(const word& patch, const std::string& motion) const
{
    FatalIOErrorInFunction(settings_.dict())
        << "The patch '" << patch << "' of type wall moves at time " << mesh_.time().timeName()
        << " s, and no wall of the DEM script moves with it: velocities of walls that fix move/mesh moves beside it "
        << motion.c_str() << "; allowed: a mesh/surface of the script with the same motion; 'shear', 'surface_vel' or "
        << "'surface_ang_vel' where the patch moves along itself; or, where particles never touch it, the entry\n    "
        << patchesEntry << " ( " << patch << " );\nin constant/couplingProperties" << exit(FatalIOError);
    std::abort();
}

void WallsOfMovingMesh::requirePatchFor(const std::string& wall, const std::string& kind) const
{
    const dictionary& demDict = settings_.demDict();
    if (demDict.getOrDefault<wordRes>("allowedInScript", {}).match(kind))
    {
        return;
    }
    FatalIOErrorInFunction(demDict) << "The wall '" << wall.c_str() << "' of the DEM script moves (" << kind.c_str()
                                    << ") at time " << mesh_.time().timeName()
                                    << " s, and no patch of type wall of the "
                                    << "fluid moves with it; allowed: the same motion in constant/dynamicMeshDict, or "
                                    << "as the velocity in the file U where the wall moves along itself; or, where you "
                                    << "know that the results are right, the entry\n    allowedInScript ( \""
                                    << kind.c_str() << "\" );\nin the dictionary DEM" << exit(FatalIOError);
}

} // namespace clepsydra
