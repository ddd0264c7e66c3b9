#include "conservation/particleCensus.h"

#include "couplingState.h"
#include "vectors.h"

#include "DynamicList.H"
#include "HashSet.H"
#include "ListListOps.H"
#include "Pstream.H"
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

/// Of this rank; 0 without particles.
double highestIdOf(const ParticlesView& particles)
{
    return particles.size() > 0 ? particles.id.maxCoeff() : 0;
}

} // namespace

int ParticleCensus::count(const ParticlesView& particles, RankTotals& totals)
{
    using namespace Foam;

    const label stillThere = list(particles);
    totals.add({{static_cast<double>(stillThere), static_cast<double>(particles.size())}, {highestIdOf(particles)}},
        [this](const RankNumbers& all) {
            const auto still = static_cast<label>(all.sums[0]);
            if (still != now_)
            {
                reportMissing(now_ - still);
            }
            const bool first = atStart_ < 0;
            record(static_cast<label>(all.sums[1]), static_cast<label>(all.maxima[0]));
            if (first)
            {
                atStart_ = now_;
            }
            else
            {
                inserted_ += now_ - still;
            }
        });
    return static_cast<int>(highestId_);
}

int ParticleCensus::count(const ParticlesView& particles)
{
    RankTotals totals;
    const int highestBefore = count(particles, totals);
    totals.reduce();
    return highestBefore;
}

void ParticleCensus::countAfterRemoval(const ParticlesView& particles, Foam::label removed)
{
    using namespace Foam;

    const label expected = now_ - removed;
    list(particles);
    const RankNumbers all = RankTotals::of({{static_cast<double>(particles.size())}, {highestIdOf(particles)}});
    record(static_cast<label>(all.sums[0]), static_cast<label>(all.maxima[0]));
    removed_ += removed;
    if (now_ != expected)
    {
        FatalErrorInFunction << "The DEM engine has " << now_ << " particles after " << removed << " of "
                             << expected + removed << " have left and were removed; allowed: " << expected
                             << exit(FatalError);
    }
}

Foam::label ParticleCensus::list(const ParticlesView& particles)
{
    Foam::label stillThere = 0;
    here_.clear();
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const bool isNew = isNewParticle(particles, particle, highestId_);
        stillThere += !isNew;
        here_.push_back({particles.id[particle], isNew, particles.position.col(particle)});
    }
    return stillThere;
}

void ParticleCensus::record(Foam::label now, Foam::label highestId)
{
    now_ = now;
    highestId_ = highestId;
    last_.swap(here_);
}

void ParticleCensus::reportMissing(Foam::label missing) const
{
    using namespace Foam;

    // A particle that a rank no longer has is either new on another rank or lost. Only such particles are communicated,
    // not all of them.
    labelHashSet before;
    for (const Counted& seen : last_)
    {
        before.insert(seen.id);
    }
    labelHashSet here;
    DynamicList<label> arrived;
    for (const Counted& particle : here_)
    {
        if (particle.isNew)
        {
            continue;
        }
        here.insert(particle.id);
        if (!before.found(particle.id))
        {
            arrived.append(particle.id);
        }
    }
    DynamicList<label> departed;
    DynamicList<point> places;
    for (const Counted& seen : last_)
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
