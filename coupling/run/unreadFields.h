#pragma once

#include "fvMesh.H"

namespace clepsydra
{

/// Reports fields in the folder of the start time that have not been read. FatalError with the nearest name where it is
/// near enough for a misspelling, otherwise a warning with the names of the fields that are read. Call when all fields
/// of the solver exist, and before function objects begin to write.
void reportUnreadFields(const Foam::fvMesh& mesh);

} // namespace clepsydra
