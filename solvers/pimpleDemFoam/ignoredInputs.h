#pragma once

#include "fvMesh.H"

/// \file
/// Checks of OpenFOAM's own files for entries that this solver would ignore or that would give wrong results.

namespace clepsydra
{

/// FatalIOError where a function object has a type under its name of an earlier version; it names the new one. OpenFOAM
/// itself would only warn of an unknown type and run without it.
void refuseRenamedFunctionObjects(const Foam::Time& time);

/// FatalIOError where the case asks for what OpenFOAM's pimpleFoam does and this solver does not: rotating zones
/// (constant/MRFProperties, unless all are inactive), and PIMPLE { consistent yes; }.
void refuseUnsupported(const Foam::fvMesh& mesh);

/// Checks the schemes of OpenFOAM's function object `scalarTransport`, whose equation ds/dt + div(flux s) has no void
/// fraction. Between particles no flux is solenoidal, so that the equation would create and destroy s, unless the
/// scheme is `bounded`, which subtracts s div(flux). FatalIOError where the flux is phi; otherwise a warning.
void checkScalarTransport(const Foam::fvMesh& mesh);

} // namespace clepsydra
