#pragma once

#include "engine/periodicBox.h"

#include "polyMesh.H"

#include <array>
#include <string>

namespace clepsydra
{

/// Of lengths of the mesh: files have points with few digits.
constexpr double roundingOfMeshPoints = 1e-6;

/// The directions in which cyclic patches make a mesh periodic.
struct Periodicity
{
    PeriodicBox box;
    /// The names of the patches at the ends along each axis, as "'left' and 'right'"; empty where it is not periodic.
    std::array<std::string, 3> patches;
};

/// Particles have images in periodic directions, so the patches of a pair must be planes perpendicular to an axis at the
/// two ends of the mesh, and each a translation of the other.
///
/// FatalError that names the patch and what is allowed for any other patch that couples cells, except those between
/// ranks. Collective.
Periodicity periodicityOf(const Foam::polyMesh& mesh);

/// The box of periodicityOf(). Collective.
inline PeriodicBox periodicBoxOf(const Foam::polyMesh& mesh)
{
    return periodicityOf(mesh).box;
}

} // namespace clepsydra
