#pragma once

#include "engine/liggghts/particleProperty.h"

namespace clepsydra
{

/// The forces with which the next step begins, stored with each particle and part of LIGGGHTS' restart files. At a new
/// `run`, and in a resumed process, LIGGGHTS would compute others: from the velocities at the end of a step, whereas
/// damping and drag of the last step used those in its middle.
class LastForces
{
public:
    /// \param known  true where a restart file that was read holds them
    LastForces(LiggghtsProgram& program, bool known);

    void store();

    /// Sets LIGGGHTS' forces to those of the last step, if they are known.
    void restore();

    void forget()
    {
        known_ = false;
    }

private:
    LiggghtsProgram& program_;
    const ParticleProperty property_;
    bool known_;
};

} // namespace clepsydra
