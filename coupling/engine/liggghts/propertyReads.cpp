#include "engine/liggghts/propertyReads.h"

#include "engine/demEngine.h"
#include "engine/liggghts/replacedFunctions.h"

#include <library.h>
#include <modify.h>

#include <cstring>
#include <map>

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;

/// By instance, because the function that LIGGGHTS calls has no other way to find its record.
std::map<const lmp::LAMMPS*, std::set<std::string>>& records()
{
    static std::map<const lmp::LAMMPS*, std::set<std::string>> ofInstances;
    return ofInstances;
}

bool recording = false;

} // namespace

void recordPropertyReads()
{
    try
    {
        replaceFunctions({"_ZN9LAMMPS_NS6Modify17find_fix_propertyEPKcS2_S2_iiS2_"},
            reinterpret_cast<const void*>(&lammps_open), reinterpret_cast<const void*>(&recordPropertyReads));
        recording = true;
    }
    catch (const DemEngineError&)
    {
        recording = false; // A warning is missing then, but results are the same.
    }
}

const std::set<std::string>* propertiesRead(const lmp::LAMMPS& program)
{
    return recording ? &records()[&program] : nullptr;
}

void forgetPropertyReads(const lmp::LAMMPS& program)
{
    records().erase(&program);
}

} // namespace clepsydra

/// As LIGGGHTS' own, which calls the member with one argument more: true, so that a property that is not found is an
/// error.
LAMMPS_NS::Fix* LAMMPS_NS::Modify::find_fix_property(
    const char* property, const char* style, const char* kind, int rows, int columns, const char* caller)
{
    if (std::strcmp(style, "property/global") == 0)
    {
        clepsydra::records()[lmp].insert(property);
    }
    constexpr bool missingIsError = true;
    return find_fix_property(property, style, kind, rows, columns, caller, missingIsError);
}
