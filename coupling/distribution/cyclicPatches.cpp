#include "distribution/cyclicPatches.h"

#include "vectors.h"

#include "PstreamReduceOps.H"
#include "SubField.H"
#include "cyclicPolyPatch.H"
#include "processorCyclicPolyPatch.H"

#include <algorithm>
#include <string>

namespace clepsydra
{

using namespace Foam;

namespace
{

[[noreturn]] void refuse(const polyPatch& patch, const std::string& objection)
{
    FatalErrorInFunction
        << "Patch '" << patch.name() << "' in " << patch.boundaryMesh().objectPath() << " is of type " << patch.type()
        << objection.c_str()
        << "; allowed: wall, patch, symmetryPlane and others that couple no cells, processor between "
        << "ranks, and pairs of cyclic patches in planes perpendicular to the x, y or z axis at the "
        << "two ends of the mesh, each a translation of the other, because a particle near one of them "
        << "acts at the other, too" << exit(FatalError);
    std::abort();
}

/// Faces of one patch of a pair on all ranks; also those that the decomposition has put into processorCyclic patches.
class CyclicSide
{
public:
    /// Collective.
    explicit CyclicSide(const cyclicPolyPatch& patch)
    {
        const polyBoundaryMesh& patches = patch.boundaryMesh();
        add(patch, patch.neighbPatch().faceCentres());
        for (const polyPatch& other : patches)
        {
            if (!isA<processorCyclicPolyPatch>(other))
            {
                continue;
            }
            if (const auto& part = refCast<const processorCyclicPolyPatch>(other); part.referPatchID() == patch.index())
            {
                add(part, part.neighbFaceCentres());
            }
        }
        reduce(low_, minOp<vector>());
        reduce(high_, maxOp<vector>());
        reduce(shortest_, minOp<vector>());
        reduce(longest_, maxOp<vector>());
        reduce(areaVector_, sumOp<vector>());
        reduce(area_, sumOp<scalar>());
    }

    bool isEmpty() const
    {
        return !(area_ > 0);
    }

    /// Axis to which the plane of the faces is perpendicular; -1 where they are in no such plane.
    label axis(double tolerance) const
    {
        for (direction axis = 0; axis < vector::nComponents; ++axis)
        {
            if (std::abs(areaVector_[axis]) > (1 - roundingOfMeshPoints) * area_
                && high_[axis] - low_[axis] <= tolerance)
            {
                return axis;
            }
        }
        return -1;
    }

    double place(label axis) const
    {
        return 0.5 * (low_[axis] + high_[axis]);
    }

    /// Whether all faces are separated from those of the other patch by the same vector along an axis.
    bool isTranslatedAlong(label axis, double tolerance) const
    {
        vector across = longest_;
        across[axis] = 0;
        return mag(longest_ - shortest_) <= tolerance && mag(across) <= tolerance;
    }

private:
    void add(const polyPatch& faces, const vectorField& centresOfOther)
    {
        forAll (faces, face)
        {
            for (const label point : faces[face])
            {
                const Foam::point& at = faces.points()[point];
                low_ = min(low_, at);
                high_ = max(high_, at);
            }
            const vector separation = centresOfOther[face] - faces.faceCentres()[face];
            shortest_ = min(shortest_, separation);
            longest_ = max(longest_, separation);
            areaVector_ += faces.faceAreas()[face];
            area_ += mag(faces.faceAreas()[face]);
        }
    }

    vector low_ = vector::max;
    vector high_ = vector::min;
    vector shortest_ = vector::max;
    vector longest_ = vector::min;
    vector areaVector_ = vector::zero;
    scalar area_ = 0;
};

void addPair(const cyclicPolyPatch& patch, const boundBox& mesh, Periodicity& periodic)
{
    if (patch.transform() == coupledPolyPatch::ROTATIONAL)
    {
        refuse(patch, " and rotational");
    }
    const CyclicSide one(patch);
    const CyclicSide other(patch.neighbPatch());
    if (one.isEmpty())
    {
        return;
    }
    const double tolerance = roundingOfMeshPoints * mesh.mag();
    const label axis = one.axis(tolerance);
    if (axis < 0 || other.axis(tolerance) != axis)
    {
        refuse(patch, " and does not lie in a plane perpendicular to an axis, as its neighbour '"
                          + patch.neighbPatch().name() + "' must as well");
    }
    if (!one.isTranslatedAlong(axis, tolerance))
    {
        refuse(patch, " and its neighbour '" + patch.neighbPatch().name()
                          + "' is not its translation along the axis to which it is perpendicular");
    }
    const double low = std::min(one.place(axis), other.place(axis));
    const double high = std::max(one.place(axis), other.place(axis));
    if (std::abs(low - mesh.min()[axis]) > tolerance || std::abs(high - mesh.max()[axis]) > tolerance)
    {
        refuse(patch, " and does not lie at an end of the mesh");
    }
    periodic.box.low[axis] = mesh.min()[axis];
    periodic.box.length[axis] = mesh.max()[axis] - mesh.min()[axis];
    std::string& names = periodic.patches[static_cast<std::size_t>(axis)];
    names += (names.empty() ? "'" : ", '") + patch.name() + "' and '" + patch.neighbPatch().name() + "'";
}

} // namespace

Periodicity periodicityOf(const polyMesh& mesh)
{
    Periodicity periodic;
    // Not polyMesh::bounds(), which a mesh made in memory may have of one rank only.
    const boundBox bounds(mesh.points(), true);
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        // Not coupled(), which is false of cyclicAMI.
        if (!isA<coupledPolyPatch>(patch) || isA<processorPolyPatch>(patch))
        {
            continue;
        }
        // Not isA<cyclicPolyPatch>(): types derived from it do more than repeat the mesh.
        if (patch.type() != cyclicPolyPatch::typeName)
        {
            refuse(patch, "");
        }
        if (const auto& cyclic = refCast<const cyclicPolyPatch>(patch); cyclic.owner())
        {
            addPair(cyclic, bounds, periodic);
        }
    }
    return periodic;
}

} // namespace clepsydra
