#include "traffic/beadTraffic.h"

#include "runTimeSelection.h"
#include "vectors.h"

#include <algorithm>

namespace clepsydra
{

using namespace Foam;

Passage& Passage::operator+=(const Passage& other)
{
    beads += other.beads;
    mass += other.mass;
    momentum += other.momentum;
    volume += other.volume;
    return *this;
}

namespace
{

/// Coupling intervals in which a bead comes in, unless said otherwise.
constexpr double usualIntervals = 10;

double readInsertionTime(const dictionary& couplingProperties, double couplingInterval)
{
    return couplingProperties.found("insertionTime") ? positiveEntry(couplingProperties, "insertionTime")
                                                     : usualIntervals * couplingInterval;
}

/// \param introduced  the part of the insertion's time that is over
double shareIntroduced(double introduced)
{
    return introduced * introduced * (3 - 2 * introduced);
}

/// Of all ranks.
Passage sumOfRanks(const Passage& ofRank)
{
    return {returnReduce(ofRank.beads, sumOp<label>()), returnReduce(ofRank.mass, sumOp<scalar>()),
        returnReduce(ofRank.momentum, sumOp<vector>()), returnReduce(ofRank.volume, sumOp<scalar>())};
}

void addBead(Passage& to, double mass, const Vector3d& velocity)
{
    ++to.beads;
    to.mass += mass;
    to.momentum += mass * toFoam(velocity);
}

} // namespace

BeadTraffic::BeadTraffic(const dictionary& couplingProperties, const fvMesh& mesh, double couplingInterval)
    : regIOobject(IOobject(registryName, mesh.time().timeName(), mesh)),
      outlets_(couplingProperties, mesh),
      insertionTime_(readInsertionTime(couplingProperties, couplingInterval)),
      interval_(couplingInterval),
      lastLeft_(static_cast<std::size_t>(outlets_.names().size()))
{}

double BeadTraffic::start(const BeadsView& beads, bool fresh)
{
    double inFluid = 0;
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        CouplingState& state = beads.state[bead];
        if (fresh)
        {
            beads.introduced[bead] = 1;
        }
        state.part = partOf(beads, bead, interval_);
        state.fluid.presence = shareIntroduced(beads.introduced[bead]) * state.part.share;
        inFluid += volumeInFluid(beads, bead);
    }
    return returnReduce(inFluid, sumOp<scalar>());
}

void BeadTraffic::advance(const BeadsView& beads, int newFrom, double interval)
{
    interval_ = interval;
    Passage inserted;
    std::vector<Passage> left(lastLeft_.size());
    gone_.clear();
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        CouplingState& state = beads.state[bead];
        double& introduced = beads.introduced[bead];
        const double volume = sphereVolume(beads.radius[bead]);
        if (beads.id[bead] > newFrom)
        {
            introduced = 0;
            addBead(inserted, beads.mass[bead], beads.velocity.col(bead));
        }
        const double before = shareIntroduced(introduced);
        introduced = std::min(1.0, introduced + interval / insertionTime_);
        const double now = shareIntroduced(introduced);

        const PartWithin part = partOf(beads, bead, interval);
        // One that has turned back is booked where it had begun to leave.
        const auto outlet = static_cast<label>(part.outlet < 0 ? state.part.outlet : part.outlet);
        inserted.volume += (now - before) * state.part.share * volume;
        if (outlet >= 0)
        {
            left[outlet].volume += now * (state.part.share - part.share) * volume;
        }
        state.part = part;
        state.fluid.presence = now * part.share;
        if (!(part.share > 0))
        {
            gone_.push_back({beads.id[bead], outlet, beads.mass[bead], beads.velocity.col(bead)});
        }
    }
    lastInserted_ = sumOfRanks(inserted);
    netVolume_ += lastInserted_.volume;
    for (std::size_t outlet = 0; outlet < left.size(); ++outlet)
    {
        lastLeft_[outlet] = sumOfRanks(left[outlet]);
        netVolume_ -= lastLeft_[outlet].volume;
    }
}

label BeadTraffic::removeGone(DemEngine& engine)
{
    const label count = returnReduce(static_cast<label>(gone_.size()), sumOp<label>());
    if (count == 0)
    {
        return count;
    }
    std::vector<int> ids;
    std::vector<Passage> left(lastLeft_.size());
    for (const Gone& bead : gone_)
    {
        ids.push_back(bead.id);
        addBead(left[bead.outlet], bead.mass, bead.velocity);
    }
    for (std::size_t outlet = 0; outlet < left.size(); ++outlet)
    {
        lastLeft_[outlet] += sumOfRanks(left[outlet]);
    }
    gone_.clear();
    engine.remove(ids);
    return count;
}

PartWithin BeadTraffic::partOf(const BeadsView& beads, Eigen::Index bead, double interval) const
{
    return outlets_.partWithin(
        beads.position.col(bead), beads.radius[bead], interval * beads.velocity.col(bead).norm());
}

} // namespace clepsydra
