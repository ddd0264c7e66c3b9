#include "couplingStep/particleMapping.h"

#include "couplingStep/particlesOutsideMesh.h"

#include <mpi.h>

namespace clepsydra
{

namespace
{

MPI_Comm duplicateWorld()
{
    MPI_Comm own;
    MPI_Comm_dup(MPI_COMM_WORLD, &own);
    return own;
}

} // namespace

Eigen::MatrixXd LocatedParticles::densities(Eigen::Index rowCount) const
{
    return mapping_->distribution_.densities(mapping_->exchange_.contributions().topRows(rowCount));
}

Eigen::MatrixXd LocatedParticles::densitiesOf(const Eigen::MatrixXd& amounts) const
{
    return mapping_->distribution_.densities(mapping_->exchange_.toGhosts(amounts));
}

void LocatedParticles::smooth(Eigen::MatrixXd& densities) const
{
    const PhaseTimers::Scope timing = mapping_->timers_.time("smooth");
    mapping_->distribution_.smooth(densities);
}

Eigen::MatrixXd LocatedParticles::sample(const Eigen::MatrixXd& inCells) const
{
    return mapping_->exchange_.sumAtOwners(mapping_->distribution_.sample(inCells));
}

const std::vector<GhostParticle>& LocatedParticles::ghosts() const
{
    return mapping_->exchange_.ghosts();
}

ParticleMapping::ParticleMapping(const Foam::fvMesh& mesh, const Foam::dictionary& couplingProperties,
    Distribution& distribution, PhaseTimers& timers)
    : mesh_(mesh),
      couplingProperties_(couplingProperties),
      distribution_(distribution),
      timers_(timers),
      exchange_(duplicateWorld(), distribution.cells().box(), distribution.voidFractionModel().commonReach(),
          distribution.periodicBox())
{}

void ParticleMapping::meshMoved()
{
    distribution_.meshMoved();
    exchange_.setCells(distribution_.cells().box());
}

template<class Communicate>
auto ParticleMapping::exchanged(const Communicate& communicate)
{
    const PhaseTimers::Scope timing = timers_.time("exchange");
    return communicate();
}

Eigen::MatrixXd ParticleMapping::shareSums()
{
    const Eigen::MatrixXd sharesHere = [&] {
        const PhaseTimers::Scope timing = timers_.time("locate");
        return distribution_.findCells(exchange_.ghosts());
    }();
    return exchanged([&] { return exchange_.sumAtOwners(sharesHere); });
}

std::vector<bool> ParticleMapping::areOutsideMesh(const ParticlesView& particles)
{
    exchanged([&] { exchange_.send(particles, Eigen::MatrixXd(0, particles.size())); });
    const Eigen::MatrixXd shares = shareSums();
    std::vector<bool> outside;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        outside.push_back(!(shares(0, particle) > 0));
    }
    return outside;
}

LocatedParticles ParticleMapping::locate(const ParticlesView& particles, const Eigen::MatrixXd& contributions)
{
    bool asPlanned = false;
    while (!asPlanned)
    {
        RankTotals totals;
        locateAsPlanned(particles, contributions, totals);
        asPlanned = totals.reduce();
    }
    return lastLocated();
}

LocatedParticles ParticleMapping::locateAsPlanned(
    const ParticlesView& particles, const Eigen::MatrixXd& contributions, RankTotals& totals)
{
    exchanged([&] { exchange_.sendAsPlanned(particles, contributions, totals); });
    const Eigen::MatrixXd shares = shareSums();
    requireWithinMesh(mesh_, couplingProperties_, particles, shares, totals);
    distribution_.normalise(exchanged([&] { return exchange_.toGhosts(shares); }));
    const PhaseTimers::Scope timing = timers_.time("smooth");
    distribution_.smoothNearParticles(totals);
    return lastLocated();
}

} // namespace clepsydra
