#pragma once

#include "openfoam/compatibility.h"

#include "Pstream.H"
#include "PstreamReduceOps.H"

namespace clepsydra
{

/// Whether a rank has the file of an object, wherever the file handler keeps it: `collated` has one file for many
/// ranks, in a folder such as processors2. Collective.
template<class Type>
bool hasFile(const Foam::IOobject& object)
{
    return Foam::returnReduce(!clepsydra::typeFilePath<Type>(object).empty(), Foam::orOp<bool>());
}

} // namespace clepsydra
