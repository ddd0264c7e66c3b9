#include "engine/liggghts/liggghtsErrors.h"

#include <error.h>
#include <fix.h>

namespace clepsydra
{

void keepLiggghtsErrorReplacements()
{}

} // namespace clepsydra

using clepsydra::LiggghtsStopped;

void LAMMPS_NS::Error::all(const char*, int, const char* message)
{
    throw LiggghtsStopped(message, false);
}

void LAMMPS_NS::Error::one(const char*, int, const char* message)
{
    throw LiggghtsStopped(message, true);
}

void LAMMPS_NS::Error::fix_error(const char*, int, Fix* fix, const char* message)
{
    throw LiggghtsStopped(std::string("fix ") + fix->style + " (id " + fix->id + "): " + message, false);
}

void LAMMPS_NS::Error::fix_error(const char*, int, Fix* fix, const char* fixStyle, const char* message)
{
    throw LiggghtsStopped(std::string("fix ") + fixStyle + " (id " + fix->id + "): " + message, false);
}
