#pragma once

#include "engine/particles.h"
#include "rankTotals.h"

#include "label.H"

#include <vector>

namespace clepsydra
{

/// Counts the particles of all ranks by their ids, so that the loss of a particle is an error.
class ParticleCensus
{
public:
    /// Counts the particles and compares them with the last count. New particles have higher ids than all that were
    /// there at the last count, or the state of a new particle (see isNewParticle()). The count is complete when the
    /// totals are reduced: FatalError then that names the missing particles and their last positions where some are
    /// missing. Local.
    /// \return the highest id at the last count over all ranks, 0 before the first one
    int count(const ParticlesView& particles, RankTotals& totals);

    /// The same with a reduction of its own. Collective.
    int count(const ParticlesView& particles);

    /// Counts the particles after some have been removed. Collective, one reduction. FatalError where a number other than
    /// `removed` is missing.
    void countAfterRemoval(const ParticlesView& particles, Foam::label removed);

    /// Number of particles at the first count and at the last one, over all ranks.
    Foam::label atStart() const
    {
        return atStart_;
    }

    Foam::label now() const
    {
        return now_;
    }

    /// Numbers of particles that have been inserted and removed since the first count.
    Foam::label inserted() const
    {
        return inserted_;
    }

    Foam::label removed() const
    {
        return removed_;
    }

    /// Number of particles that are missing: those at the start and inserted ones less removed and present ones.
    Foam::label lost() const
    {
        return atStart_ + inserted_ - removed_ - now_;
    }

private:
    struct Counted
    {
        int id;
        /// Whether the particle was new at this count.
        bool isNew;
        Vector3d position;
    };

    /// Lists this rank's particles in here_. \return number of particles that are not new
    Foam::label list(const ParticlesView& particles);
    /// Numbers over all ranks of a count that is complete; here_ becomes last_.
    void record(Foam::label now, Foam::label highestId);
    [[noreturn]] void reportMissing(Foam::label missing) const;

    /// The particles of this rank at the last count that is complete, and at the one that is not yet.
    std::vector<Counted> last_;
    std::vector<Counted> here_;
    Foam::label atStart_ = -1;
    Foam::label inserted_ = 0;
    Foam::label removed_ = 0;
    Foam::label now_ = 0;
    Foam::label highestId_ = 0;
};

} // namespace clepsydra
