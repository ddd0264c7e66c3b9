#pragma once

#include "openfoam/objectFile.h"

#include "volFields.H"
#include "zeroGradientFvPatchFields.H"

namespace clepsydra
{

/// A field of the coupling. It is read from the time folder where the run was stopped; otherwise it is uniform.
/// IOobject::READ_IF_PRESENT alone would treat a file that cannot be opened as missing.
template<class Type>
Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh> couplingField(
    const Foam::word& name, const Foam::fvMesh& mesh, const Foam::dimensionSet& dimensions, const Type& value)
{
    using namespace Foam;
    using Field = GeometricField<Type, fvPatchField, volMesh>;
    IOobject file(name, mesh.time().timeName(), mesh, IOobject::MUST_READ, IOobject::AUTO_WRITE);
    if (hasFile<Field>(file))
    {
        return Field(file, mesh);
    }
    file.readOpt() = IOobject::READ_IF_PRESENT;
    return Field(file, mesh, dimensioned<Type>(name, dimensions, value), zeroGradientFvPatchField<Type>::typeName);
}

/// A field that is recomputed in every coupling step. It is neither read nor written, and uniform at first.
template<class Field>
Field temporaryField(const Foam::word& name, const Foam::fvMesh& mesh, const Foam::dimensionSet& dimensions,
    const typename Field::value_type& value = Foam::pTraits<typename Field::value_type>::zero,
    const Foam::word& patchType = Field::Patch::calculatedType())
{
    using namespace Foam;
    return Field(IOobject(name, mesh.time().timeName(), mesh, IOobject::NO_READ, IOobject::NO_WRITE), mesh,
        dimensioned<typename Field::value_type>(name, dimensions, value), patchType);
}

} // namespace clepsydra
