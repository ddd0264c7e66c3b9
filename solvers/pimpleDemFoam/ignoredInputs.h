#pragma once

#include "FlatOutput.H"
#include "fvMesh.H"

/// \file
/// Checks of OpenFOAM's own files for entries that this solver would ignore or that would give wrong results.

namespace clepsydra
{

/// FatalIOError where a function object has a type under its name of an earlier version; it names the new one. OpenFOAM
/// itself would only warn of an unknown type and run without it.
void refuseRenamedFunctionObjects(const Foam::Time& time);

/// FatalIOError where the case asks for what OpenFOAM's pimpleFoam does and this solver does not: rotating zones
/// (constant/MRFProperties, unless all are inactive), and PIMPLE { consistent yes; } and others.
void refuseUnsupported(const Foam::fvMesh& mesh);

/// FatalError where the schemes of a field's equation would make it another one: a convection scheme that is `bounded`,
/// because it would subtract div(alphaPhi) times the field a second time, or a scheme in time that is none of an unsteady
/// flow, or another one than that of the void fraction. Inline, because the library of turbulence models needs it, too.
inline void checkSchemes(const Foam::fvMesh& mesh, const Foam::word& field)
{
    using namespace Foam;
    const word convection("div(phi," + field + ')');
    if (const token first(mesh.divScheme(convection)); first.isWord() && first.wordToken() == "bounded")
    {
        FatalErrorInFunction << "The scheme '" << convection << "' in system/fvSchemes begins with 'bounded'; allowed: "
                             << "the scheme without that word, because the solver itself subtracts the continuity "
                             << "error from the equation of " << field << exit(FatalError);
    }
    const word inTime("ddt(voidFraction," + field + ')');
    const tokenList& scheme = mesh.ddtScheme(inTime);
    const wordList unsteady({"Euler", "backward", "CrankNicolson"});
    if (!scheme.first().isWord() || !unsteady.found(scheme.first().wordToken()))
    {
        FatalErrorInFunction << "The scheme '" << inTime << "' in system/fvSchemes is " << scheme.first()
                             << "; allowed: " << flatOutput(unsteady) << ", because particles and fluid change in time"
                             << exit(FatalError);
    }
    const word ofVoidFraction("ddt(voidFraction)");
    if (const tokenList& other = mesh.ddtScheme(ofVoidFraction); scheme != other)
    {
        FatalErrorInFunction << "The schemes '" << inTime << "' and '" << ofVoidFraction
                             << "' in system/fvSchemes differ; allowed: the same for both, because otherwise a uniform "
                             << field << " would not remain uniform" << exit(FatalError);
    }
}

/// Checks the schemes of OpenFOAM's function object `scalarTransport`, whose equation ds/dt + div(flux s) has no void
/// fraction. Between particles no flux is solenoidal, so that the equation would create and destroy s, unless the
/// scheme is `bounded`, which subtracts s div(flux). FatalIOError where the flux is phi; otherwise a warning.
void checkScalarTransport(const Foam::fvMesh& mesh);

} // namespace clepsydra
