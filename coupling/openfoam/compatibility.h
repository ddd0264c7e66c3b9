#pragma once

// All differences of OpenFOAM's interface between the versions with which Clepsydra compiles (ESI, v1912 and later) are
// handled in this file, except those of the turbulence models (solvers/turbulence/modelTypes.h). FindOpenFOAM.cmake defines
// OPENFOAM (2312 for v2312).

#include "IOobject.H"
#include "Time.H"
#include "dictionary.H"
#include "fvMesh.H"

namespace clepsydra
{

/// State that function objects store from one write time to the next: their counters, triggers and results.
inline const Foam::dictionary& functionObjectState(const Foam::Time& time)
{
#if OPENFOAM >= 2112
    return time.functionObjects().propsDict();
#else
    return time.functionObjects().stateDict();
#endif
}

/// Solver performance of each linear system in the current time step, by the name of the field.
inline const Foam::dictionary& solverPerformanceDict(const Foam::fvMesh& mesh)
{
#if OPENFOAM >= 2312
    return mesh.data().solverPerformanceDict();
#else
    return mesh.solverPerformanceDict();
#endif
}

/// File from which an object of this type is read; empty where there is none.
template<class Type>
Foam::fileName typeFilePath(const Foam::IOobject& object)
{
#if OPENFOAM >= 2312
    return object.typeFilePath<Type>();
#else
    return Foam::typeFilePath<Type>(object);
#endif
}

} // namespace clepsydra
