#pragma once

#include "engine/beads.h"

#include "vector.H"

namespace clepsydra
{

// The one place where a vector changes between the engine's side of the coupling and OpenFOAM's.

inline Vector3d toEigen(const Foam::vector& v)
{
    return {v.x(), v.y(), v.z()};
}

inline Foam::vector toFoam(const Vector3d& v)
{
    return {v.x(), v.y(), v.z()};
}

} // namespace clepsydra
