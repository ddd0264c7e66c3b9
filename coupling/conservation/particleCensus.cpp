#include "conservation/particleCensus.h"

#include "couplingState.h"
#include "vectors.h"

#include "DynamicList.H"
#include "HashSet.H"
#include "ListListOps.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "error.H"
#include "pointField.H"

#include <cstdlib>

namespace clepsydra
{

namespace
{

/// Concatenates the lists of all ranks on the master; empty on the other ranks. Collective.
template<class Type>
Foam::List<Type> onMaster(const Foam::UList<Type>& own)
{
    Foam::List<Foam::List<Type>> ofRanks(Foam::Pstream::nProcs());
    ofRanks[Foam::Pstream::myProcNo()] = own;
    Foam::Pstream::gatherList(ofRanks);
    return Foam::Pstream::master()
               ? Foam::ListListOps::combine<Foam::List<Type>>(ofRanks, Foam::accessOp<Foam::List<Type>>())
               : Foam::List<Type>();
}

} // namespace

int ParticleCensus::count(const ParticlesView& particles)
{
    using namespace Foam;

    label stillThere = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        stillThere += !isNewParticle(particles, particle, highestId_);
    }
    reduce(stillThere, sumOp<label>());
    if (stillThere != now_)
    {
        reportMissing(particles, now_ - stillThere);
    }

    const bool first = atStart_ < 0;
    const label highestBefore = highestId_;
    record(particles);
    if (first)
    {
        atStart_ = now_;
        return static_cast<int>(highestId_);
    }
    inserted_ += now_ - stillThere;
    return static_cast<int>(highestBefore);
}

void ParticleCensus::countAfterRemoval(const ParticlesView& particles, Foam::label removed)
{
    using namespace Foam;

    const label expected = now_ - removed;
    record(particles);
    removed_ += removed;
    if (now_ != expected)
    {
        FatalErrorInFunction << "The DEM engine has " << now_ << " particles after " << removed << " of "
                             << expected + removed << " have left and were removed; allowed: " << expected
                             << exit(FatalError);
    }
}

void ParticleCensus::record(const ParticlesView& particles)
{
    using namespace Foam;

    now_ = returnReduce(static_cast<label>(particles.size()), sumOp<label>());
    highestId_ = returnReduce(particles.size() > 0 ? static_cast<label>(particles.id.maxCoeff()) : 0, maxOp<label>());
    last_.clear();
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        last_.push_back({particles.id[particle], particles.position.col(particle)});
    }
}

void ParticleCensus::reportMissing(const ParticlesView& particles, Foam::label missing) const
{
    using namespace Foam;

    // A particle that a rank no longer has is either new on another rank or lost. Only such particles are communicated,
    // not all of them.
    labelHashSet before;
    for (const LastPosition& seen : last_)
    {
        before.insert(seen.id);
    }
    labelHashSet here;
    DynamicList<label> arrived;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const int id = particles.id[particle];
        if (isNewParticle(particles, particle, highestId_))
        {
            continue;
        }
        here.insert(id);
        if (!before.found(id))
        {
            arrived.append(id);
        }
    }
    DynamicList<label> departed;
    DynamicList<point> places;
    for (const LastPosition& seen : last_)
    {
        if (!here.found(seen.id))
        {
            departed.append(seen.id);
            places.append(toFoam(seen.position));
        }
    }
    const labelHashSet arrivedAtAnyRank(onMaster<label>(arrived));
    const labelList leftAnyRank = onMaster<label>(departed);
    const pointField lastPositions(onMaster<point>(places));
    string names;
    forAll (leftAnyRank, i)
    {
        if (!arrivedAtAnyRank.found(leftAnyRank[i]))
        {
            const point& at = lastPositions[i];
            names += "\n    particle " + Foam::name(leftAnyRank[i]) + ", last seen at (" + Foam::name(at.x()) + ' '
                     + Foam::name(at.y()) + ' ' + Foam::name(at.z()) + ") m";
        }
    }
    // No rank may end the run before all ranks have the message.
    Pstream::scatter(names);
    FatalErrorInFunction
        << missing << " of " << now_ << " particles were lost in the last coupling step:" << names.c_str()
        << "\nThe DEM box is too small, a wall has a gap, or the DEM step is too long. Particles may only leave "
        << "through particleOutlets; the DEM box must extend beyond these by a particle's diameter and its "
        << "travel in one coupling step" << exit(FatalError);
    std::abort();
}

} // namespace clepsydra
