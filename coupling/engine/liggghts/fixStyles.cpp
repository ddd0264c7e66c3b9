#include "engine/liggghts/fixStyles.h"

#include <lammps.h>
#include <modify.h>

#include <map>

namespace clepsydra
{

namespace
{

/// LIGGGHTS' table of the fixes that a script can have. It is a private member of Modify, which an explicit instantiation
/// may name.
std::map<std::string, FixCreator>& fixTable(const LAMMPS_NS::Modify& modify);

template<auto member>
struct FixTable
{
    friend std::map<std::string, FixCreator>& fixTable(const LAMMPS_NS::Modify& modify)
    {
        return *(modify.*member);
    }
};
template struct FixTable<&LAMMPS_NS::Modify::fix_map>;

} // namespace

void setFixStyle(LiggghtsProgram& program, const std::string& style, FixCreator creator)
{
    fixTable(*program->modify)[style] = creator;
}

} // namespace clepsydra
