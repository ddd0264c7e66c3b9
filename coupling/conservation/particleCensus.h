#pragma once

#include "engine/particles.h"

#include "label.H"

#include <vector>

namespace clepsydra
{

/// Counts the particles of all ranks by their ids, so that the loss of a particle is an error.
class ParticleCensus
{
public:
    /// Counts the particles and compares them with the last count. New particles have higher ids than all that were
    /// there at the last count, or the state of a new particle (see isNewParticle()). Collective. FatalError that names
    /// the missing particles and their last positions where some are missing.
    /// \return the highest id among the particles that are not new
    int count(const ParticlesView& particles);

    /// Counts the particles after some have been removed. Collective. FatalError where a number other than `removed` is
    /// missing.
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
    struct LastPosition
    {
        int id;
        Vector3d position;
    };

    void record(const ParticlesView& particles);
    [[noreturn]] void reportMissing(const ParticlesView& particles, Foam::label missing) const;

    std::vector<LastPosition> last_;
    Foam::label atStart_ = -1;
    Foam::label inserted_ = 0;
    Foam::label removed_ = 0;
    Foam::label now_ = 0;
    Foam::label highestId_ = 0;
};

} // namespace clepsydra
