#pragma once

#include "engine/demEngine.h"
#include "engine/liggghts/insertionCheck.h"
#include "engine/liggghts/liggghtsParticles.h"

namespace clepsydra
{

/// Adds the fluid's forces to LIGGGHTS' at every step, by a `fix external` that is the last fix of all.
class FluidForceFix
{
public:
    FluidForceFix(
        LiggghtsProgram& program, LiggghtsParticles& particles, InsertionCheck& insertionCheck, FluidForces& forces);
    FluidForceFix(const FluidForceFix&) = delete;
    FluidForceFix& operator=(const FluidForceFix&) = delete;

    /// Whether forces are evaluated also where LIGGGHTS prepares a run without a step; they are zero otherwise.
    void evaluateWhilePreparing(bool evaluate)
    {
        evaluatesWhilePreparing_ = evaluate;
    }

private:
    void addForces(double** force);
    /// Particles that `groupChanges` has put to rest are in no group that moves.
    void findFixedParticles();
    /// `fix freeze` has cleared all forces except the fluid's, which are added after it.
    void clearForceOnFixedParticles(Vectors force) const;

    LiggghtsProgram& program_;
    LiggghtsParticles& particles_;
    InsertionCheck& insertionCheck_;
    FluidForces& forces_;
    bool evaluatesWhilePreparing_ = false;
    /// Groups whose particles are moved by forces, and groups whose particles are frozen by a fix.
    int movingGroups_ = 0;
    int frozenGroups_ = 0;
    Eigen::Array<bool, Eigen::Dynamic, 1> fixed_;
};

} // namespace clepsydra
