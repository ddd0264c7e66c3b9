#include "engine/liggghts/groupChanges.h"

#include "engine/demEngine.h"

#include <atom.h>
#include <fix_property_atom.h>
#include <group.h>
#include <lammps.h>
#include <modify.h>

#include <algorithm>

namespace clepsydra
{

namespace
{

std::string propertyName(const GroupChange& change)
{
    return "clepsydraRest_" + change.name;
}

double squaredLength(const double* vector)
{
    return vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2];
}

} // namespace

GroupChanger::GroupChanger(LAMMPS_NS::LAMMPS& program, const GroupChange& change)
    : program_(program),
      change_(change),
      fromBit_(groupBit(change.from)),
      toBit_(groupBit(change.to))
{}

std::string GroupChanger::propertyCommand() const
{
    // fix <id> <group> property/atom <name> <style> <restart> <ghost> <reverse> <default>
    const std::string name = propertyName(change_);
    return change_.rest ? "fix " + name + " all property/atom " + name + " scalar yes no no 0." : std::string();
}

void GroupChanger::apply(double elapsed)
{
    if (change_.rest && !restTime_)
    {
        restTime_ = static_cast<LAMMPS_NS::FixPropertyAtom*>(program_.modify->find_fix_property(
            propertyName(change_).c_str(), "property/atom", "scalar", 0, 0, "coupling"));
    }
    LAMMPS_NS::Atom& atom = *program_.atom;
    for (int particle = 0; particle < atom.nlocal; ++particle)
    {
        const bool before = (atom.mask[particle] & fromBit_) != 0;
        const bool after = (atom.mask[particle] & toBit_) != 0;
        if (before == after)
        {
            throw DemEngineError("Entry 'DEM/groupChanges/" + change_.name + "': particle "
                                 + std::to_string(atom.tag[particle]) + " is in " + (before ? "both" : "neither")
                                 + " of the groups '" + change_.from + "' and '" + change_.to
                                 + "'; allowed: each particle in exactly one of the two");
        }
        if (after || atom.x[particle][2] >= change_.below)
        {
            continue;
        }
        if (change_.rest)
        {
            double& atRest = restTime_->vector_atom[particle];
            atRest = isSlow(particle) ? atRest + elapsed : 0;
            if (atRest < change_.rest->duration)
            {
                continue;
            }
            stop(particle);
        }
        atom.mask[particle] ^= fromBit_ | toBit_;
    }
}

int GroupChanger::groupBit(const std::string& group) const
{
    const LAMMPS_NS::Group& groups = *program_.group;
    const int index = program_.group->find(group.c_str());
    if (index < 0)
    {
        std::string known;
        for (int i = 0; i < groups.ngroup; ++i)
        {
            known += std::string(" ") + groups.names[i];
        }
        throw DemEngineError("Entry 'DEM/groupChanges/" + change_.name + "' names the group '" + group
                             + "', which the DEM script does not define; allowed:" + known);
    }
    return groups.bitmask[index];
}

bool GroupChanger::isSlow(int particle) const
{
    const LAMMPS_NS::Atom& atom = *program_.atom;
    const double limit = change_.rest->speed * change_.rest->speed;
    const double radius = atom.radius[particle];
    return squaredLength(atom.v[particle]) < limit && radius * radius * squaredLength(atom.omega[particle]) < limit;
}

void GroupChanger::stop(int particle) const
{
    std::fill_n(program_.atom->v[particle], 3, 0.0);
    std::fill_n(program_.atom->omega[particle], 3, 0.0);
}

} // namespace clepsydra
