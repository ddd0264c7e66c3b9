#pragma once

#include "engine/particles.h"
#include "rankTotals.h"

#include "fvMesh.H"

namespace clepsydra
{

/// FatalError, when the totals are reduced, where a particle has no share in any cell and is not one of those that may be
/// outside the mesh. The message describes the particle with the lowest id. Local. \pre mesh, couplingProperties and the
/// view are valid until then
/// \param shareSums  1 x particles: sums of the shares over all ranks
void requireWithinMesh(const Foam::fvMesh& mesh, const Foam::dictionary& couplingProperties,
    const ParticlesView& particles, const Eigen::MatrixXd& shareSums, RankTotals& totals);

} // namespace clepsydra
