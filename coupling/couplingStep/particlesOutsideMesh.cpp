#include "couplingStep/particlesOutsideMesh.h"

#include "couplingState.h"
#include "ranks.h"
#include "vectors.h"

#include <cstdlib>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Text that names the nearest patch where the mesh ends, and says whether the position is beyond it. Collective.
string nearestPatch(const fvMesh& mesh, const point& position)
{
    scalar nearest = GREAT;
    string text;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        forAll (patch, face)
        {
            if (patch.coupled())
            {
                break;
            }
            const pointHit found = patch[face].nearestPoint(position, mesh.points());
            if (found.distance() < nearest)
            {
                nearest = found.distance();
                const bool beyond = ((position - found.rawPoint()) & patch.faceAreas()[face]) > 0;
                text = (beyond ? ", and is " + Foam::name(nearest) + " m beyond patch '" + patch.name()
                                     + "', which it has crossed"
                               : ", and the nearest patch is '" + patch.name() + '\'');
            }
        }
    }
    return firstOfRanks(nearest == returnReduce(nearest, minOp<scalar>()) ? text : string());
}

/// FatalError that describes the particle with the given id. Collective.
[[noreturn]] void reportOutsideMesh(
    const fvMesh& mesh, const dictionary& couplingProperties, const ParticlesView& particles, label count, label id)
{
    vector position = vector::zero;
    vector velocity = vector::zero;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        if (particles.id[particle] == id)
        {
            position = toFoam(particles.position.col(particle));
            velocity = toFoam(particles.velocity.col(particle));
        }
    }
    reduce(position, sumOp<vector>());
    reduce(velocity, sumOp<vector>());
    const wordList outlets = couplingProperties.getOrDefault<wordList>("particleOutlets", wordList());
    FatalErrorInFunction << "Particle " << id << " at " << position << " m lies in no cell of the mesh, which spans "
                         << boundBox(mesh.points(), true) << " m. It moves at " << mag(velocity) << " m/s, " << velocity
                         << nearestPatch(mesh, position).c_str() << "; " << count
                         << " particles in all lie in no cell; allowed: particles within the mesh. Where particles may "
                         << "leave, list the patch in particleOutlets, which is now " << flatOutput(outlets)
                         << "; where they may be in parts of the DEM box without mesh and without fluid, set "
                         << "allowParticlesOutsideMesh yes; otherwise a wall of the DEM script is missing there"
                         << exit(FatalError);
    std::abort();
}

} // namespace

void requireWithinMesh(const fvMesh& mesh, const dictionary& couplingProperties, const ParticlesView& particles,
    const Eigen::MatrixXd& shareSums, RankTotals& totals)
{
    label count = 0;
    label lowestId = labelMax;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        if (!(shareSums(0, particle) > 0) && !isOutsideMesh(particles.state[particle]))
        {
            ++count;
            lowestId = min(lowestId, label(particles.id[particle]));
        }
    }
    totals.add({{static_cast<double>(count)}, {-static_cast<double>(lowestId)}},
        [&mesh, &couplingProperties, particles](const RankNumbers& all) {
            if (all.sums[0] > 0)
            {
                reportOutsideMesh(mesh, couplingProperties, particles, static_cast<label>(all.sums[0]),
                    static_cast<label>(-all.maxima[0]));
            }
        });
}

} // namespace clepsydra
