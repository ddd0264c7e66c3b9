#pragma once

#include "fvMesh.H"

namespace clepsydra
{

/// Fields that stand in the start time's folder and that nobody has read: a warning, with the nearest known name, and
/// FatalError for a name that is a misspelling of one that is read. Call when all fields of the solver are there, and before function objects begin to write.
void reportUnreadFields(const Foam::fvMesh& mesh);

} // namespace clepsydra
