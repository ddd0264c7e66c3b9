#pragma once

#include "engine/liggghts/liggghtsParticles.h"

namespace clepsydra
{

/// Examines particles that have come into LIGGGHTS for overlaps, after which they would be shot apart.
class InsertionCheck
{
public:
    explicit InsertionCheck(LiggghtsParticles& particles)
        : particles_(particles)
    {}

    /// Examines all particles at the start. \param freshStart  false where they are those of a checkpoint, as they were
    void atStart(const LiggghtsProgram& program, bool freshStart);

    /// Examines the particles that have been inserted since the last call.
    void afterStep(const LiggghtsProgram& program);

    /// Particles of all ranks that remain after some have been removed.
    void setCount(long count)
    {
        count_ = count;
    }

private:
    LiggghtsParticles& particles_;
    /// Of all ranks at the last call.
    long count_ = 0;
};

} // namespace clepsydra
