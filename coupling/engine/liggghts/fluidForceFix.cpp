#include "engine/liggghts/fluidForceFix.h"

#include "engine/liggghts/floatingPointTraps.h"
#include "engine/liggghts/liggghtsProgram.h"
#include "engine/liggghts/particleChecks.h"
#include "engine/liggghts/rows.h"

#include <atom.h>
#include <fix_external.h>
#include <lammps.h>
#include <modify.h>
#include <update.h>

#include <algorithm>
#include <string>

namespace clepsydra
{

namespace lmp = LAMMPS_NS;

namespace
{

/// Whether the fix moves its particles by the forces on them, and not as the script prescribes or not at all.
bool movesByForces(const lmp::Fix& fix)
{
    const std::string style = fix.style;
    const bool isMultisphere = style.rfind("multisphere", 0) == 0; // does not declare that it integrates
    return (fix.time_integrate == 1 && style != "move" && style.find("noforce") == std::string::npos) || isMultisphere;
}

} // namespace

FluidForceFix::FluidForceFix(
    LiggghtsProgram& program, LiggghtsParticles& particles, InsertionCheck& insertionCheck, FluidForces& forces)
    : program_(program),
      particles_(particles),
      insertionCheck_(insertionCheck),
      forces_(forces)
{
    constexpr const char* id = "clepsydraForce";
    program_.execute(std::string("fix ") + id + " all external pf/callback 1 1", "fluid force");
    lmp::Modify& modify = *program_->modify;
    static_cast<lmp::FixExternal*>(modify.fix[modify.find_fix(id)])
        ->set_callback([](void* self, lmp::bigint, int, int*, double**,
                           double** force) { static_cast<FluidForceFix*>(self)->addForces(force); },
            this);
    std::for_each(modify.fix, modify.fix + modify.nfix, [this](const lmp::Fix* fix) {
        movingGroups_ |= movesByForces(*fix) ? fix->groupbit : 0;
        frozenGroups_ |= std::string(fix->style) == "freeze" ? fix->groupbit : 0;
    });
}

void FluidForceFix::addForces(double** force)
{
    requireFiniteForces(*program_);
    const FloatingPointTraps asOutside(program_.trapsOutside());
    Vectors ofFluid(firstElement(force), 3, program_->atom->nlocal);
    const bool preparing = program_->update->setupflag != 0;
    if (preparing && !evaluatesWhilePreparing_)
    {
        ofFluid.setZero();
        return;
    }
    if (!preparing)
    {
        insertionCheck_.afterStep(program_);
    }
    findFixedParticles();
    forces_.evaluate(particles_.view(particles_.pairsRequested() ? particles_.pairsWithState() : ParticlePairs{},
                         !preparing, ConstView<bool>(fixed_.data(), fixed_.size())),
        program_->update->dt, ofFluid);
    clearForceOnFixedParticles(ofFluid);
}

void FluidForceFix::findFixedParticles()
{
    const lmp::Atom& atom = *program_->atom;
    fixed_.resize(atom.nlocal);
    std::transform(atom.mask, atom.mask + atom.nlocal, fixed_.begin(),
        [this](int groups) { return (groups & movingGroups_) == 0 || (groups & frozenGroups_) != 0; });
}

void FluidForceFix::clearForceOnFixedParticles(Vectors force) const
{
    for (Eigen::Index particle = 0; frozenGroups_ != 0 && particle < force.cols(); ++particle)
    {
        if (fixed_[particle])
        {
            force.col(particle).setZero();
        }
    }
}

} // namespace clepsydra
