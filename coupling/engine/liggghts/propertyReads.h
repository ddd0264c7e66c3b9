#pragma once

#include <set>
#include <string>

namespace LAMMPS_NS
{
class LAMMPS;
}

namespace clepsydra
{

/// Begins a record of the values of `fix property/global` that LIGGGHTS' models and fixes look up. LIGGGHTS itself does
/// not record it. This program replaces the function of LIGGGHTS that looks them up; see replaceFunctions().
///
/// Call before LIGGGHTS is started. Has no effect where the function cannot be replaced.
void recordPropertyReads();

/// Names of the values that an instance of LIGGGHTS has looked up; nullptr where there is no record.
const std::set<std::string>* propertiesRead(const LAMMPS_NS::LAMMPS& program);

/// Deletes the record of an instance that is about to end.
void forgetPropertyReads(const LAMMPS_NS::LAMMPS& program);

} // namespace clepsydra
