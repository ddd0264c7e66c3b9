#pragma once

#include "engine/beads.h"

#include "label.H"

#include <vector>

namespace clepsydra
{

/// Counts the beads of all ranks by their numbers, so that none is lost without an error.
class BeadCensus
{
public:
    /// Compares with the last count. New beads (pouring) have numbers above all earlier ones. Collective.
    /// FatalError naming the missing beads with their last position otherwise.
    void count(const BeadsView& beads);

    /// Beads at the first count and now, over all ranks.
    Foam::label atStart() const
    {
        return atStart_;
    }

    Foam::label now() const
    {
        return now_;
    }

    /// Beads that came in less those that are here.
    Foam::label lost() const
    {
        return atStart_ + inserted_ - now_;
    }

private:
    struct Sighting
    {
        int id;
        Vector3d position;
    };

    [[noreturn]] void reportMissing(const BeadsView& beads, Foam::label missing) const;

    std::vector<Sighting> last_;
    Foam::label atStart_ = -1;
    Foam::label inserted_ = 0;
    Foam::label now_ = 0;
    Foam::label highestId_ = 0;
};

} // namespace clepsydra
