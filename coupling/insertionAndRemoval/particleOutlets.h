#pragma once

#include "couplingState.h"

#include "fvMesh.H"
#include "triSurfaceSearch.H"

#include <memory>

namespace clepsydra
{

/// The open boundaries for particles: patches of the mesh that particles leave through.
///
///     particleOutlets     (floor outlet);     // in couplingProperties; default: none
///
/// A wall of the fluid may be one, too: particles reach it only where the DEM script has no wall of its own there. Every
/// rank knows all faces, for the ranks of the particles are not those of the cells. Exact where a patch is flat, on a curved
/// one a particle sees the plane of the nearest face. The mesh must end there: what lies up to a particle's diameter and the
/// travel of one interval behind an outlet is outside.
///
/// FatalIOError, with the nearest patch's name, where an entry names no patch, a patch without faces, or one that
/// joins two parts of the mesh.
class ParticleOutlets
{
public:
    ParticleOutlets(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh);

    const Foam::wordList& names() const
    {
        return names_;
    }

    /// What of a particle is inside; of one that is wholly beyond an outlet nothing. Local.
    /// \param travel  that the particle may have moved since it was inside [m]
    PartWithin partWithin(const Vector3d& centre, double radius, double travel) const;

private:
    void readNames(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh);
    void gatherFaces(const Foam::fvMesh& mesh);

    Foam::wordList names_;
    /// Of all ranks, in triangles whose region is the outlet's index; none where there is no outlet.
    std::unique_ptr<Foam::triSurface> surface_;
    std::unique_ptr<Foam::triSurfaceSearch> search_;
    Foam::boundBox bounds_;
};

} // namespace clepsydra
