#include "engine/liggghts/particleChecks.h"

#include "engine/demEngine.h"
#include "engine/liggghts/floatingPointTraps.h"
#include "engine/liggghts/rows.h"

#include <atom.h>
#include <domain.h>
#include <fix_property_global.h>
#include <lammps.h>
#include <modify.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;

std::string placeText(const double* place)
{
    std::ostringstream text;
    text << '(' << place[0] << ' ' << place[1] << ' ' << place[2] << ") m";
    return text.str();
}

/// Cause of a force on a particle that is not a finite number, as far as it is known.
std::string causeOf(const lmp::Atom& atom, int particle)
{
    for (int other = 0; other < atom.nlocal + atom.nghost; ++other)
    {
        if (other != particle && std::equal(atom.x[particle], atom.x[particle] + 3, atom.x[other]))
        {
            return ": particle " + std::to_string(atom.tag[other])
                   + " is at the same place; allowed: particles at different positions";
        }
    }
    return ". This happens where a particle's centre lies exactly on a wall, on an edge or a corner of one, or where "
           "the DEM step is too long; allowed: particles beside walls that at most touch them";
}

} // namespace

std::string boxText(const lmp::LAMMPS& program)
{
    return "the box, " + placeText(program.domain->boxlo) + " to " + placeText(program.domain->boxhi);
}

std::string lastParticleText(const lmp::LAMMPS& program)
{
    // LIGGGHTS has not overwritten the values of the last particle that it removed.
    const lmp::Atom& atom = *program.atom;
    std::ostringstream text;
    text << "particle " << atom.tag[0] << " is at " << placeText(atom.x[0]) << " with a speed of "
         << ConstVectors(atom.v[0], 3, 1).norm() << " m/s, outside " << boxText(program);
    return text.str();
}

void requireParticlesInBox(const lmp::LAMMPS& program)
{
    const lmp::Domain& domain = *program.domain;
    const lmp::Atom& atom = *program.atom;
    for (int particle = 0; particle < atom.nlocal; ++particle)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            const double x = atom.x[particle][axis];
            if (domain.periodicity[axis] == 0 && !(x >= domain.boxlo[axis] && x <= domain.boxhi[axis]))
            {
                throw DemEngineError("Particle " + std::to_string(atom.tag[particle]) + " at "
                                     + placeText(atom.x[particle]) + " lies outside the DEM box; allowed: positions in "
                                     + boxText(program));
            }
        }
    }
}

void requireNoDeepOverlap(const lmp::LAMMPS& program, const ParticlePairs& pairs, const std::vector<bool>& isExamined)
{
    constexpr double largestPart = 0.1;
    const auto examined = [&](int particle) {
        const auto own = static_cast<std::size_t>(particle);
        return isExamined.empty() || (own < isExamined.size() && isExamined[own]);
    };
    for (Eigen::Index pair = 0; pair < pairs.list.cols(); ++pair)
    {
        const int i = pairs.list(0, pair);
        const int j = pairs.list(1, pair);
        if (!examined(i) && !examined(j))
        {
            continue;
        }
        const double smaller = 2 * std::min(pairs.radius[i], pairs.radius[j]);
        const double overlap =
            pairs.radius[i] + pairs.radius[j] - (pairs.position.col(i) - pairs.position.col(j)).norm();
        if (overlap > largestPart * smaller)
        {
            const lmp::Atom& atom = *program.atom;
            std::ostringstream message;
            message << "Particles " << atom.tag[i] << " and " << atom.tag[j] << " at " << placeText(atom.x[i])
                    << " and " << placeText(atom.x[j]) << " overlap by " << overlap << " m, " << overlap / smaller
                    << " of the smaller one's diameter; allowed at the start and at an insertion: at most "
                    << largestPart;
            throw DemEngineError(message.str());
        }
    }
}

void requireFiniteForces(const lmp::LAMMPS& program)
{
    const lmp::Atom& atom = *program.atom;
    const FloatingPointTraps none(0);
    const Eigen::Index count = 3L * atom.nlocal;
    if (atom.nlocal == 0
        || std::isfinite(ConstView<double>(firstElement(atom.f), count).sum()
                         + ConstView<double>(firstElement(atom.x), count).sum()))
    {
        return;
    }
    for (int particle = 0; particle < atom.nlocal; ++particle)
    {
        const double* const x = atom.x[particle];
        const double* const f = atom.f[particle];
        if (!std::isfinite(f[0] + f[1] + f[2] + x[0] + x[1] + x[2]))
        {
            throw DemEngineError("The force on particle " + std::to_string(atom.tag[particle]) + " at " + placeText(x)
                                 + " is not a finite number" + causeOf(atom, particle));
        }
    }
}

void requireNoNegativeFriction(const lmp::LAMMPS& program)
{
    auto* const friction = static_cast<lmp::FixPropertyGlobal*>(program.modify->find_fix_property(
        "coefficientFriction", "property/global", "peratomtypepair", 0, 0, "coupling", false));
    const int materialCount = program.atom->ntypes;
    for (int pair = 0; friction && pair < materialCount * materialCount; ++pair)
    {
        const double value = friction->compute_array(pair / materialCount, pair % materialCount);
        if (value < 0)
        {
            throw DemEngineError("coefficientFriction of the materials " + std::to_string(pair / materialCount + 1)
                                 + " and " + std::to_string(pair % materialCount + 1) + " is " + std::to_string(value)
                                 + "; allowed: a number >= 0");
        }
    }
}

} // namespace clepsydra
