#include "engine/liggghts/insertionCheck.h"

#include "engine/liggghts/liggghtsProgram.h"
#include "engine/liggghts/particleChecks.h"

#include <atom.h>
#include <lammps.h>

#include <algorithm>

namespace clepsydra
{

void InsertionCheck::atStart(const LiggghtsProgram& program, bool freshStart)
{
    if (freshStart)
    {
        requireNoDeepOverlap(*program, particles_.pairs());
    }
    count_ = program->atom->natoms;
}

void InsertionCheck::afterStep(const LiggghtsProgram& program)
{
    const bool inserted = program->atom->natoms > count_;
    count_ = program->atom->natoms;
    if (!inserted)
    {
        return;
    }
    const std::vector<bool> isNew = particles_.areNew();
    if (std::find(isNew.begin(), isNew.end(), true) != isNew.end())
    {
        requireNoDeepOverlap(*program, particles_.pairs(), isNew);
    }
}

} // namespace clepsydra
