#include "ledger/beadCensus.h"

#include "HashSet.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "error.H"
#include "stringList.H"

#include <cstdlib>

namespace clepsydra
{

int BeadCensus::count(const BeadsView& beads)
{
    using namespace Foam;

    label stillThere = 0;
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        stillThere += beads.id[bead] <= highestId_;
    }
    reduce(stillThere, sumOp<label>());
    if (stillThere != now_)
    {
        reportMissing(beads, now_ - stillThere);
    }

    const bool first = atStart_ < 0;
    const label highestBefore = highestId_;
    remember(beads);
    if (first)
    {
        atStart_ = now_;
        return static_cast<int>(highestId_);
    }
    inserted_ += now_ - stillThere;
    return static_cast<int>(highestBefore);
}

void BeadCensus::countAfterRemoval(const BeadsView& beads, Foam::label removed)
{
    using namespace Foam;

    const label expected = now_ - removed;
    remember(beads);
    removed_ += removed;
    if (now_ != expected)
    {
        FatalErrorInFunction << "The DEM engine has " << now_ << " beads after " << removed << " of "
                             << expected + removed << " have left and were taken out" << exit(FatalError);
    }
}

void BeadCensus::remember(const BeadsView& beads)
{
    using namespace Foam;

    now_ = returnReduce(static_cast<label>(beads.size()), sumOp<label>());
    highestId_ = returnReduce(beads.size() > 0 ? static_cast<label>(beads.id.maxCoeff()) : 0, maxOp<label>());
    last_.clear();
    for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
    {
        last_.push_back({beads.id[bead], beads.position.col(bead)});
    }
}

void BeadCensus::reportMissing(const BeadsView& beads, Foam::label missing) const
{
    using namespace Foam;

    List<labelList> idsOfRanks(Pstream::nProcs());
    labelList& own = idsOfRanks[Pstream::myProcNo()];
    own.resize(static_cast<label>(beads.size()));
    std::copy(beads.id.begin(), beads.id.end(), own.begin());
    Pstream::gatherList(idsOfRanks);
    Pstream::scatterList(idsOfRanks);
    labelHashSet present;
    for (const labelList& ids : idsOfRanks)
    {
        present.insert(ids);
    }

    string names;
    for (const Sighting& seen : last_)
    {
        if (!present.found(seen.id))
        {
            names += "\n    bead " + Foam::name(seen.id) + ", last seen at (" + Foam::name(seen.position.x()) + ' '
                     + Foam::name(seen.position.y()) + ' ' + Foam::name(seen.position.z()) + ") m";
        }
    }
    stringList namesOfRanks(Pstream::nProcs());
    namesOfRanks[Pstream::myProcNo()] = names;
    Pstream::gatherList(namesOfRanks);
    string allNames;
    for (const string& part : namesOfRanks)
    {
        allNames += part;
    }
    FatalErrorInFunction
        << missing << " of " << now_ << " beads were lost in the last interval:" << allNames.c_str()
        << "\nThe DEM box is too small, a wall has a gap, or the DEM step is too long. Beads may leave "
        << "through beadOutlets; the DEM box must go on behind these for a bead's diameter and its "
        << "travel of one interval." << exit(FatalError);
    std::abort();
}

} // namespace clepsydra
