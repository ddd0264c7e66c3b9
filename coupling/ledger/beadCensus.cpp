#include "ledger/beadCensus.h"

#include "HashSet.H"
#include "Pstream.H"
#include "PstreamReduceOps.H"
#include "error.H"
#include "stringList.H"

#include <cstdlib>

namespace clepsydra
{

void BeadCensus::count(const BeadsView& beads)
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

    now_ = returnReduce(static_cast<label>(beads.size()), sumOp<label>());
    highestId_ = returnReduce(beads.size() > 0 ? static_cast<label>(beads.id.maxCoeff()) : 0, maxOp<label>());
    if (atStart_ < 0)
    {
        atStart_ = now_;
    }
    else
    {
        inserted_ += now_ - stillThere;
    }
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
    FatalErrorInFunction << missing << " of " << now_ << " beads were lost in the last interval:" << allNames.c_str()
                         << "\nThe DEM box is too small, a wall has a gap, or the DEM step is too long."
                         << exit(FatalError);
    std::abort();
}

} // namespace clepsydra
