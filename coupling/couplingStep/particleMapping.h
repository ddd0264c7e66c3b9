#pragma once

#include "distribution/distribution.h"
#include "exchange/particleExchange.h"
#include "phaseTimers.h"

namespace clepsydra
{

class ParticleMapping;

/// Particles whose cells are known, with what they add to them. Only ParticleMapping makes one, so that nothing can be
/// distributed or sampled before. Valid until the engine advances or particles are located again. All members are
/// collective.
class LocatedParticles
{
public:
    /// Densities of the particles' contributions in the cells, not smoothed.
    /// \param rowCount  number of rows to compute, from the first one on
    Eigen::MatrixXd densities(Eigen::Index rowCount) const;

    /// The same of any amounts. \param amounts  a column per particle of this rank
    Eigen::MatrixXd densitiesOf(const Eigen::MatrixXd& amounts) const;

    /// Smooths densities, see SmoothingModel::smooth().
    void smooth(Eigen::MatrixXd& densities) const;

    /// Values of the cells at the particles. \return a column per particle of this rank
    Eigen::MatrixXd sample(const Eigen::MatrixXd& inCells) const;

    /// Copies of the particles near this rank's cells. Local.
    const std::vector<GhostParticle>& ghosts() const;

private:
    friend class ParticleMapping;
    explicit LocatedParticles(const ParticleMapping& mapping)
        : mapping_(&mapping)
    {}

    const ParticleMapping* mapping_;
};

/// Maps particles to cells and fields to particles: the exchange between ranks and the distribution, with the time of
/// each.
class ParticleMapping
{
public:
    ParticleMapping(const Foam::fvMesh& mesh, const Foam::dictionary& couplingProperties, Distribution& distribution,
        PhaseTimers& timers);

    /// Finds the cells of the particles on all ranks. Collective. FatalError where a particle is in no cell and may not be
    /// outside the mesh.
    /// \param contributions  what each particle adds to its cells, a column per particle
    LocatedParticles locate(const ParticlesView& particles, const Eigen::MatrixXd& contributions);

    /// As locate(), but what is to be confirmed by all ranks is left to the totals: whether all ghosts have been sent and
    /// all cells near particles found, and whether each particle is in a cell. Where a condition of the totals does not
    /// hold, the particles must be located again. Collective, but with few exceptions without a reduction.
    LocatedParticles locateAsPlanned(
        const ParticlesView& particles, const Eigen::MatrixXd& contributions, RankTotals& totals);

    /// Recomputes what depends on the points of the mesh, after they have moved. Particles that were located before are
    /// no longer valid. Collective.
    void meshMoved();

    /// The particles that were located last.
    LocatedParticles lastLocated() const
    {
        return LocatedParticles(*this);
    }

    /// Whether each particle of this rank is in no cell of the mesh on any rank. Collective.
    std::vector<bool> areOutsideMesh(const ParticlesView& particles);

    const Distribution& distribution() const
    {
        return distribution_;
    }

    /// Bytes that this rank has sent to others so far. Local.
    std::size_t bytesSent() const
    {
        return exchange_.bytesSent();
    }

private:
    friend class LocatedParticles;
    /// Finds the cells of the ghosts that have been sent. \return the sums of the particles' shares over all ranks.
    /// Collective.
    Eigen::MatrixXd shareSums();
    /// What `communicate` returns; its time is that of the exchange.
    template<class Communicate>
    auto exchanged(const Communicate& communicate);

    const Foam::fvMesh& mesh_;
    const Foam::dictionary& couplingProperties_;
    Distribution& distribution_;
    PhaseTimers& timers_;
    ParticleExchange exchange_;
};

} // namespace clepsydra
