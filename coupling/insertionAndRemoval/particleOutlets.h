#pragma once

#include "couplingState.h"
#include "vectors.h"

#include "fvMesh.H"
#include "triSurfaceSearch.H"

#include <memory>

namespace clepsydra
{

/// The outlets: patches of the mesh through which particles leave.
///
///     particleOutlets  (floor outlet);    // in couplingProperties; default: none
///
/// A wall of the fluid may be an outlet, too; particles reach it only where the DEM script has no wall there. Every
/// rank stores the faces of all ranks, because the ranks of the particles are not those of the cells. The result is
/// exact for flat patches; on a curved patch the plane of the nearest face is used. The mesh must end at an outlet:
/// everything up to a particle's diameter plus its travel in one coupling step behind it counts as outside.
///
/// FatalIOError with the nearest patch's name where an entry names no patch, a patch without faces, or a patch that
/// couples two parts of the mesh.
class ParticleOutlets
{
public:
    ParticleOutlets(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh);

    /// Takes the faces as they are now, after the points of the mesh have moved. Collective where there are outlets.
    void meshMoved(const Foam::fvMesh& mesh);

    const Foam::wordList& names() const
    {
        return names_;
    }

    /// Box around all outlets; empty where there are none.
    Box bounds() const
    {
        return search_ ? Box(toEigen(bounds_.min()), toEigen(bounds_.max())) : Box();
    }

    /// Distance from an outlet beyond which a particle is not examined [m].
    static double reach(double radius, double travel)
    {
        // A particle that an obstacle behind the outlet has slowed down has come farther than its present velocity
        // suggests.
        return 3 * radius + travel;
    }

    /// The part of a particle that is on the fluid's side of the outlets; its share is 0 where the particle is entirely
    /// beyond an outlet. Local.
    /// \param travel  distance that the particle may have moved since it was inside [m]
    PartWithin partWithin(const Vector3d& centre, double radius, double travel) const;

private:
    void readNames(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh);
    void gatherFaces(const Foam::fvMesh& mesh);

    Foam::wordList names_;
    /// Faces of all ranks as triangles whose region is the outlet's index; null where there is no outlet.
    std::unique_ptr<Foam::triSurface> surface_;
    std::unique_ptr<Foam::triSurfaceSearch> search_;
    Foam::boundBox bounds_;
};

} // namespace clepsydra
