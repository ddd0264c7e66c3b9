#include "engine/liggghts/particleProperty.h"

#include "engine/liggghts/liggghtsProgram.h"
#include "engine/liggghts/rows.h"
#include "tokens/exactText.h"

#include <fix_property_atom.h>
#include <lammps.h>
#include <modify.h>

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;

lmp::FixPropertyAtom* findProperty(
    LiggghtsProgram& program, const std::string& name, const std::string& style, int size)
{
    return static_cast<lmp::FixPropertyAtom*>(
        program->modify->find_fix_property(name.c_str(), "property/atom", style.c_str(), size, 0, "coupling"));
}

} // namespace

ParticleProperty::ParticleProperty(LiggghtsProgram& program, const std::string& name,
    const std::vector<double>& ofNewParticle, InRestartFiles inRestartFiles, OnCopies onCopies)
    : isScalar_(ofNewParticle.size() == 1)
{
    const std::string style = isScalar_ ? "scalar" : "vector";
    // property/atom <name> <style> <restart> <ghost> <reverse> <defaults ...>
    std::string command = "fix " + name + " all property/atom " + name + ' ' + style
                          + (inRestartFiles == InRestartFiles::yes ? " yes" : " no")
                          + (onCopies == OnCopies::yes ? " yes" : " no") + " no";
    for (const double value : ofNewParticle)
    {
        command += ' ' + exactText(value);
    }
    // LIGGGHTS warns of many values per particle.
    program.execute(command, name, LiggghtsProgram::Warnings::dropped);
    fix_ = findProperty(program, name, style, isScalar_ ? 0 : static_cast<int>(ofNewParticle.size()));
}

ParticleProperty::ParticleProperty(LiggghtsProgram& program, const std::string& name)
    : isScalar_(true),
      fix_(findProperty(program, name, "scalar", 0))
{}

double* ParticleProperty::values() const
{
    return isScalar_ ? fix_->vector_atom : firstElement(fix_->array_atom);
}

void ParticleProperty::sendToCopies() const
{
    fix_->do_forward_comm();
}

} // namespace clepsydra
