#include "engine/liggghts/lastForces.h"

#include "engine/liggghts/liggghtsProgram.h"
#include "engine/liggghts/rows.h"
#include "engine/particles.h"

#include <atom.h>
#include <lammps.h>

namespace clepsydra
{

namespace
{

/// Forces on particles in rows 0 to 2, torques in rows 3 to 5.
using Stored = Eigen::Map<Eigen::Matrix<double, 6, Eigen::Dynamic>>;

} // namespace

LastForces::LastForces(LiggghtsProgram& program, bool known)
    : program_(program),
      property_(program, "clepsydraLastForces", std::vector<double>(6, 0.0), ParticleProperty::InRestartFiles::yes),
      known_(known)
{}

void LastForces::store()
{
    const LAMMPS_NS::Atom& atom = *program_->atom;
    Stored stored(property_.values(), 6, atom.nlocal);
    stored.topRows<3>() = ConstVectors(firstElement(atom.f), 3, atom.nlocal);
    stored.bottomRows<3>() = ConstVectors(firstElement(atom.torque), 3, atom.nlocal);
    known_ = true;
}

void LastForces::restore()
{
    if (known_)
    {
        const LAMMPS_NS::Atom& atom = *program_->atom;
        const Stored stored(property_.values(), 6, atom.nlocal);
        Vectors(firstElement(atom.f), 3, atom.nlocal) = stored.topRows<3>();
        Vectors(firstElement(atom.torque), 3, atom.nlocal) = stored.bottomRows<3>();
    }
}

} // namespace clepsydra
