#include "movingWalls.h"

#include "vectors.h"

#include "Function1.H"
#include "PatchFunction1.H"
#include "rotatingWallVelocityFvPatchVectorField.H"
#include "translatingWallVelocityFvPatchVectorField.H"
#include "uniformFixedValueFvPatchFields.H"
#include "volFields.H"
#include "wallFvPatch.H"

#include <cmath>
#include <functional>
#include <memory>
#include <sstream>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Largest difference of the velocities of a wall and its patch, and largest part of the velocity across the patch, whose
/// faces are plane where the wall is round; root mean squares over the patch, relative to that of the velocity.
constexpr double velocityTolerance = 1e-3;
constexpr double normalTolerance = 0.05;

/// How the motion of a wall compares with the velocity of a patch; root mean squares over its area [m/s].
struct Comparison
{
    double difference; ///< along the patch
    double across;     ///< of the wall's velocity
    double speed;      ///< of the wall's velocity
};

/// Collective.
Comparison compare(const fvPatchVectorField& onPatch, const RigidMotion& motion)
{
    const vectorField& areas = onPatch.patch().Sf();
    const vectorField& centres = onPatch.patch().Cf();
    scalarList sums(4, Zero);
    forAll (centres, face)
    {
        const scalar area = mag(areas[face]);
        const vector normal = areas[face] / area;
        const vector ofWall = toFoam(motion.at(toEigen(centres[face])));
        const vector difference = ofWall - onPatch[face];
        sums[0] += area;
        sums[1] += area * magSqr(difference - normal * (normal & difference));
        sums[2] += area * sqr(normal & ofWall);
        sums[3] += area * magSqr(ofWall);
    }
    Pstream::listCombineGather(sums, plusEqOp<scalar>());
    Pstream::listCombineScatter(sums);
    const scalar area = max(sums[0], VSMALL);
    return {std::sqrt(sums[1] / area), std::sqrt(sums[2] / area), std::sqrt(sums[3] / area)};
}

/// Whether a patch prescribes the velocity of a wall.
bool isWall(const fvPatchVectorField& onPatch)
{
    return isA<wallFvPatch>(onPatch.patch()) && onPatch.fixesValue();
}

/// The field U as its file states it, with the walls' velocities as their conditions give them, whatever value the file
/// states.
volVectorField velocityWithWalls(const fvMesh& mesh)
{
    volVectorField U(IOobject("U", mesh.time().timeName(), mesh, IOobject::MUST_READ, IOobject::NO_WRITE, false), mesh);
    for (fvPatchVectorField& onPatch : U.boundaryFieldRef())
    {
        if (isWall(onPatch))
        {
            onPatch.evaluate();
        }
    }
    return U;
}

/// Whether a condition's vector differs on a face, at one of many times to the end of the run, from what it is now.
/// Collective.
/// \param at  all faces' vectors at a time
bool changes(const Time& time, const std::function<tmp<vectorField>(scalar)>& at)
{
    const scalar start = time.timeOutputValue();
    const vectorField atStart(at(start));
    scalar difference = 0;
    constexpr label samples = 100;
    for (label sample = 1; sample <= samples; ++sample)
    {
        const vectorField now(at(start + (time.endTime().value() - start) * sample / scalar(samples)));
        difference = max(difference, gMax(mag(now - atStart)()));
    }
    return difference > velocityTolerance * gMax(mag(atStart)());
}

dictionary entriesOf(const fvPatchVectorField& onPatch)
{
    OStringStream text;
    onPatch.write(text);
    return dictionary(IStringStream(text.str())());
}

/// Why the velocity of a patch is not constant over the run; empty where it is, or where this is not known. Collective.
std::string changeInTime(const fvPatchVectorField& onPatch)
{
    std::string entry;
    std::function<tmp<vectorField>(scalar)> at;
    if (isA<rotatingWallVelocityFvPatchVectorField>(onPatch))
    {
        entry = "omega";
        at = [omega = std::shared_ptr<Function1<scalar>>(Function1<scalar>::New(entry, entriesOf(onPatch)).ptr())](
                 scalar time) { return tmp<vectorField>::New(1, vector(omega->value(time), 0, 0)); };
    }
    else if (isA<translatingWallVelocityFvPatchVectorField>(onPatch))
    {
        entry = "U";
        at = [velocity = std::shared_ptr<Function1<vector>>(Function1<vector>::New(entry, entriesOf(onPatch)).ptr())](
                 scalar time) { return tmp<vectorField>::New(1, velocity->value(time)); };
    }
    else if (isA<uniformFixedValueFvPatchVectorField>(onPatch))
    {
        entry = "uniformValue";
        at = [velocity = std::shared_ptr<PatchFunction1<vector>>(
                  PatchFunction1<vector>::New(onPatch.patch().patch(), entry, entriesOf(onPatch)).ptr())](
                 scalar time) { return velocity->value(time); };
    }
    return at && changes(onPatch.db().time(), at) ? "its " + entry + " changes in time, that of the DEM wall does not"
                                                  : std::string();
}

/// Warns where it is not known whether the velocity of a patch, with which a wall moves now, is constant over the run.
void warnWhereItMayChange(const fvPatchVectorField& onPatch, const WallMotion& wall)
{
    const wordList known({"fixedValue", rotatingWallVelocityFvPatchVectorField::typeName,
        translatingWallVelocityFvPatchVectorField::typeName, uniformFixedValueFvPatchVectorField::typeName});
    if (!known.found(onPatch.type()))
    {
        WarningInFunction << "Patch '" << onPatch.patch().name() << "' of 0/U now has the velocity of fix "
                          << wall.fix.c_str() << " (" << wall.kind.c_str()
                          << ") of the DEM script, which is constant; whether that of its condition '" << onPatch.type()
                          << "' is constant is not checked; allowed without this warning: " << flatOutput(known)
                          << endl;
    }
}

/// Why a patch does not move as the wall; empty where it does. Collective.
std::string differenceOf(const fvPatchVectorField& onPatch, const RigidMotion& motion)
{
    const Comparison found = compare(onPatch, motion);
    std::ostringstream text;
    text.precision(3);
    if (found.difference > velocityTolerance * found.speed)
    {
        text << "velocity differs by " << found.difference << " m/s of " << found.speed << " m/s";
    }
    else if (found.across > normalTolerance * found.speed)
    {
        text << "the wall would move through it at " << found.across << " m/s of " << found.speed
             << " m/s, because the velocity has a component normal to it; possible are a surface of revolution about "
                "the "
                "axis and a surface along the velocity";
    }
    else
    {
        text << changeInTime(onPatch);
    }
    return text.str();
}

std::string textOf(const RigidMotion& motion)
{
    const Eigen::IOFormat vectorFormat(Eigen::StreamPrecision, Eigen::DontAlignCols, " ", " ", "", "", "(", ")");
    std::ostringstream text;
    if (!motion.velocity.isZero())
    {
        text << "with the velocity " << (motion.velocity.array() + 0.0).matrix().transpose().format(vectorFormat)
             << " m/s";
    }
    else
    {
        text << "about (origin " << (motion.origin.array() + 0.0).matrix().transpose().format(vectorFormat)
             << ") with the angular velocity "
             << (motion.angularVelocity.array() + 0.0).matrix().transpose().format(vectorFormat) << " rad/s";
    }
    return text.str();
}

/// Collective. \return an empty text where a patch moves as the wall
std::string objectionTo(const WallMotion& wall, const volVectorField& U)
{
    if (!wall.unknownBecause.empty())
    {
        return "the wall moves in the DEM only, and the fluid's wall remains where it is: " + wall.unknownBecause;
    }
    std::string list;
    for (const fvPatchVectorField& onPatch : U.boundaryField())
    {
        if (!isWall(onPatch))
        {
            continue;
        }
        const std::string difference = differenceOf(onPatch, wall.motion);
        if (difference.empty())
        {
            warnWhereItMayChange(onPatch, wall);
            return {};
        }
        list += (list.empty() ? "" : "; ") + std::string("patch '") + onPatch.patch().name() + "': " + difference;
    }
    return "the wall moves in the DEM only, " + textOf(wall.motion) + ", and no wall of the fluid has this velocity ("
           + (list.empty() ? "no patch of type wall prescribes a velocity" : list)
           + "; fixedValue or rotatingWallVelocity in 0/U gives it one)";
}

} // namespace

std::vector<UnmatchedWall> wallsWithoutPatch(const std::vector<WallMotion>& walls, const fvMesh& mesh)
{
    if (walls.empty())
    {
        return {};
    }
    const volVectorField U(velocityWithWalls(mesh));
    std::vector<UnmatchedWall> unmatched;
    for (const WallMotion& wall : walls)
    {
        if (const std::string objection = objectionTo(wall, U); !objection.empty())
        {
            unmatched.push_back({wall, objection});
        }
    }
    return unmatched;
}

void warnOfPatchesWithoutWall(const fvMesh& mesh, const std::vector<WallMotion>& walls)
{
    const volVectorField U(velocityWithWalls(mesh));
    for (const fvPatchVectorField& onPatch : U.boundaryField())
    {
        if (!isWall(onPatch) || !(gMax(mag(onPatch)()) > 0))
        {
            continue;
        }
        bool found = false;
        for (const WallMotion& wall : walls)
        {
            found = found || (wall.unknownBecause.empty() && differenceOf(onPatch, wall.motion).empty());
        }
        if (!found)
        {
            WarningInFunction
                << "Patch '" << onPatch.patch().name() << "' moves, and no wall of the DEM script has its velocity, "
                << "so that particles slide along a wall at rest; a wall of the script gets a velocity by "
                << "'surface_vel', 'surface_ang_vel', 'shear' or fix 'move/mesh'" << endl;
        }
    }
}

} // namespace clepsydra
