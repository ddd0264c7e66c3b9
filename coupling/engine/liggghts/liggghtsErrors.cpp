#include "engine/liggghts/liggghtsErrors.h"

#include "engine/liggghts/replacedFunctions.h"

#include <mpi.h>

#include <compute.h>
#include <error.h>
#include <fix.h>
#include <library.h>

namespace clepsydra
{

void replaceLiggghtsErrors()
{
    // All members that are defined below.
    replaceFunctions(
        {
            "_ZN9LAMMPS_NS5Error3allEPKciS2_",
            "_ZN9LAMMPS_NS5Error3oneEPKciS2_",
            "_ZN9LAMMPS_NS5Error9fix_errorEPKciPNS_3FixES2_",
            "_ZN9LAMMPS_NS5Error9fix_errorEPKciPNS_3FixES2_S2_",
            "_ZN9LAMMPS_NS5Error13compute_errorEPKciPNS_7ComputeES2_",
            "_ZN9LAMMPS_NS5Error12universe_allEPKciS2_",
            "_ZN9LAMMPS_NS5Error12universe_oneEPKciS2_",
            "_ZN9LAMMPS_NS5Error4doneEv",
        },
        reinterpret_cast<const void*>(&lammps_open), reinterpret_cast<const void*>(&replaceLiggghtsErrors));
}

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

void LAMMPS_NS::Error::compute_error(const char*, int, Compute* compute, const char* message)
{
    throw LiggghtsStopped(std::string("compute ") + compute->style + " (id " + compute->id + "): " + message, false);
}

void LAMMPS_NS::Error::universe_all(const char*, int, const char* message)
{
    throw LiggghtsStopped(message, false);
}

void LAMMPS_NS::Error::universe_one(const char*, int, const char* message)
{
    throw LiggghtsStopped(message, true);
}

/// LIGGGHTS' command `quit` calls this member.
void LAMMPS_NS::Error::done()
{
    throw LiggghtsStopped(
        "the command ends the run; allowed: a script without 'quit', because the coupling ends the run", false);
}
