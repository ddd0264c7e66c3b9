#pragma once

#include "engine/particles.h"

#include "label.H"

#include <vector>

namespace clepsydra
{

/// Counts the particles of all ranks by their numbers, so that none is lost without an error.
class ParticleCensus
{
public:
    /// Compares with the last count. New particles have numbers above all that were there then. Collective.
    /// FatalError naming the missing particles with their last position otherwise.
    /// \return the highest number of a particle that is not new
    int count(const ParticlesView& particles);

    /// Counts again after particles have been taken out. Collective. FatalError where other than `removed` are missing.
    void countAfterRemoval(const ParticlesView& particles, Foam::label removed);

    /// Particles at the first count and now, over all ranks.
    Foam::label atStart() const
    {
        return atStart_;
    }

    Foam::label now() const
    {
        return now_;
    }

    /// Particles that have come in or were taken out since the first count.
    Foam::label inserted() const
    {
        return inserted_;
    }

    Foam::label removed() const
    {
        return removed_;
    }

    /// Particles that came in less those that were taken out or are here.
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
