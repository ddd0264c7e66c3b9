#include "engine/liggghts/removal.h"

#include "engine/liggghts/floatingPointTraps.h"
#include "engine/liggghts/liggghtsProgram.h"

#include <atom.h>
#include <atom_vec.h>
#include <fix.h>
#include <lammps.h>
#include <modify.h>
#include <neighbor.h>

#include <mpi.h>

#include <algorithm>
#include <string>
#include <unordered_set>

namespace clepsydra
{

namespace lmp = LAMMPS_NS;

long removeParticles(LiggghtsProgram& program, const std::vector<int>& ids)
{
    const FloatingPointTraps none(0);
    lmp::Atom& atom = *program->atom;
    // The contact histories are copied from the neighbour lists to the particles, while the lists still correspond to the
    // particles.
    program->modify->setup_pre_exchange();
    const std::unordered_set<int> leaving(ids.begin(), ids.end());
    for (int particle = 0; particle < atom.nlocal;)
    {
        if (leaving.count(atom.tag[particle]) == 0)
        {
            ++particle;
            continue;
        }
        constexpr int deleting = 1;
        atom.avec->copy(--atom.nlocal, particle, deleting);
    }
    const lmp::bigint here = atom.nlocal;
    MPI_Allreduce(&here, &atom.natoms, 1, MPI_LMP_BIGINT, MPI_SUM, program->world);
    // Copies of removed particles must not be found.
    atom.nghost = 0;
    if (atom.map_style != 0)
    {
        atom.map_init();
        atom.map_set();
    }
    return atom.natoms;
}

void allowNoParticles(LiggghtsProgram& program)
{
    const lmp::Modify& modify = *program->modify;
    const bool found =
        std::any_of(modify.fix, modify.fix + modify.nfix, [](lmp::Fix* fix) { return fix->min_type() == 1; });
    if (program->atom->natoms > 0 || found)
    {
        return;
    }
    // A particle template provides the material; its radius has no effect because there are no particles.
    program.execute(
        "fix clepsydraTemplate all particletemplate/sphere 10007 atom_type 1 density constant 1. radius constant "
            + std::to_string(program->neighbor->skin),
        "no particles");
    program.execute(
        "fix clepsydraTemplates all particledistribution/discrete 10009 1 clepsydraTemplate 1.", "no particles");
}

} // namespace clepsydra
