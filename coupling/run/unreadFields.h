#pragma once

#include "fvMesh.H"

namespace clepsydra
{

/// Fields that stand in the start time's folder and that nobody has read: a warning with the names that are read, or, where
/// one of these is near, so that it is a misspelling, FatalError with that one. Call when all fields of the solver are there,
/// and before function objects begin to write.
void reportUnreadFields(const Foam::fvMesh& mesh);

} // namespace clepsydra
