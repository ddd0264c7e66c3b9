#include "engine/liggghts/scriptFacts.h"

#include "engine/liggghts/liggghtsProgram.h"
#include "engine/liggghts/propertyReads.h"

#include <atom.h>
#include <domain.h>
#include <fix.h>
#include <fix_gravity.h>
#include <fix_property_global.h>
#include <force.h>
#include <group.h>
#include <lammps.h>
#include <modify.h>
#include <update.h>

#include <mpi.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;

std::string textOrEmpty(const char* text)
{
    return text ? text : "";
}

std::string nameOfGroup(const lmp::Group& groups, int bit)
{
    constexpr int mostGroups = 32;
    for (int group = 0; group < mostGroups; ++group)
    {
        if (groups.names[group] && groups.bitmask[group] == bit)
        {
            return groups.names[group];
        }
    }
    return {};
}

std::vector<lmp::Fix*> fixesOf(const lmp::Modify& modify)
{
    return {modify.fix, modify.fix + modify.nfix};
}

/// The groups of each particle on this rank, and of the particles that each insertion will make, without repetition.
std::set<int> groupsOfParticles(const lmp::LAMMPS& program)
{
    const lmp::Atom& atom = *program.atom;
    std::set<int> groups(atom.mask, atom.mask + atom.nlocal);
    constexpr int all = 1;
    for (const lmp::Fix* fix : fixesOf(*program.modify))
    {
        if (std::string(fix->style).rfind("insert/", 0) == 0)
        {
            groups.insert(all | fix->groupbit);
        }
    }
    return groups;
}

std::vector<ScriptFacts::SharedParticles> integratedTwice(const lmp::LAMMPS& program)
{
    std::vector<lmp::Fix*> integrators = fixesOf(*program.modify);
    integrators.erase(std::remove_if(integrators.begin(), integrators.end(),
                          [](const lmp::Fix* fix) { return fix->time_integrate != 1; }),
        integrators.end());
    const std::size_t count = integrators.size();
    std::vector<int> shared(count * count, 0);
    const std::set<int> groups = groupsOfParticles(program);
    for (std::size_t i = 0; i < count; ++i)
    {
        for (std::size_t j = i + 1; j < count; ++j)
        {
            shared[i * count + j] = static_cast<int>(std::any_of(groups.begin(), groups.end(),
                [&](int of) { return (of & integrators[i]->groupbit) != 0 && (of & integrators[j]->groupbit) != 0; }));
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, shared.data(), static_cast<int>(shared.size()), MPI_INT, MPI_MAX, program.world);
    std::vector<ScriptFacts::SharedParticles> found;
    for (std::size_t pair = 0; pair < shared.size(); ++pair)
    {
        if (shared[pair] != 0)
        {
            found.push_back({integrators[pair / count]->id, integrators[pair % count]->id});
        }
    }
    return found;
}

/// Name of a command, with the id of a fix: "boundary", "fix gravity".
std::string nameOf(const std::string& command)
{
    std::istringstream tokens(command);
    std::string name;
    std::string id;
    tokens >> name;
    return name == "fix" && tokens >> id ? name + ' ' + id : name;
}

struct Property
{
    std::string id;
    std::string name;
};

/// What a command `fix <id> <group> property/global <name> ...` states; no name where it is another command.
Property propertyOf(const std::string& command)
{
    static const std::set<std::string> styles = {
        "property/global", "custom_property/global", "property/atomtype", "property/atomtypepair"};
    std::istringstream tokens(command);
    std::string fix;
    std::string group;
    std::string style;
    Property property;
    tokens >> fix >> property.id >> group >> style >> property.name;
    return fix == "fix" && styles.count(style) > 0 ? property : Property{};
}

/// Whether a fix holds values of which one at least is not zero.
bool hasValues(lmp::Fix& fix)
{
    bool found = fix.scalar_flag != 0 && fix.compute_scalar() != 0;
    for (int i = 0; fix.vector_flag != 0 && i < fix.size_vector; ++i)
    {
        found |= fix.compute_vector(i) != 0;
    }
    for (int i = 0; fix.array_flag != 0 && i < fix.size_array_rows * fix.size_array_cols; ++i)
    {
        found |= fix.compute_array(i / fix.size_array_cols, i % fix.size_array_cols) != 0;
    }
    return found;
}

} // namespace

std::vector<std::string> ScriptFacts::fixesOfStyle(const std::string& style) const
{
    std::vector<std::string> ids;
    for (const Fix& fix : fixes)
    {
        if (fix.style == style)
        {
            ids.push_back(fix.id);
        }
    }
    return ids;
}

const ScriptCommand* ScriptFacts::lastCommand(const std::string& name) const
{
    const auto found = std::find_if(
        commands.rbegin(), commands.rend(), [&](const ScriptCommand& command) { return nameOf(command.text) == name; });
    return found == commands.rend() ? nullptr : &*found;
}

PeriodicBox periodicBoxOf(const LiggghtsProgram& program)
{
    const lmp::Domain& domain = *program->domain;
    PeriodicBox periodic;
    for (int axis = 0; axis < 3; ++axis)
    {
        if (domain.periodicity[axis] != 0)
        {
            periodic.low[axis] = domain.boxlo[axis];
            periodic.length[axis] = domain.boxhi[axis] - domain.boxlo[axis];
        }
    }
    return periodic;
}

ScriptFacts factsOf(const LiggghtsProgram& program, std::vector<ScriptCommand> commands)
{
    ScriptFacts facts{textOrEmpty(program->update->unit_style), textOrEmpty(program->atom->atom_style),
        textOrEmpty(program->update->integrate_style), textOrEmpty(program->force->pair_style),
        Box(Vector3d(program->domain->boxlo), Vector3d(program->domain->boxhi)), periodicBoxOf(program),
        program->domain->triclinic != 0, {}, integratedTwice(*program), std::move(commands)};
    for (const lmp::Fix* fix : fixesOf(*program->modify))
    {
        const ScriptCommand* const command = facts.lastCommand(std::string("fix ") + fix->id);
        facts.fixes.push_back({fix->id, fix->style, nameOfGroup(*program->group, fix->groupbit),
            command ? *command : ScriptCommand{}, fix->time_integrate == 1});
    }
    const auto property = [&](const char* name, const char* style, const char* kind, int size) {
        constexpr bool missingIsError = false;
        return program->modify->find_fix_property(name, style, kind, size, 0, "coupling", missingIsError);
    };
    const lmp::Fix* const temperature = property(temperatureName, "property/atom", "scalar", 0);
    facts.hasTemperature = temperature != nullptr;
    facts.temperatureInRestartFiles = temperature && temperature->restart_peratom != 0;
    facts.hasSpecificHeat =
        property(specificHeatName, "property/global", "peratomtype", program->atom->ntypes) != nullptr;
    return facts;
}

Vector3d gravityOf(const LiggghtsProgram& program)
{
    Vector3d acceleration = Vector3d::Zero();
    const lmp::Modify& modify = *program->modify;
    std::for_each(modify.fix, modify.fix + modify.nfix, [&](lmp::Fix* fix) {
        if (std::string(fix->style) == "gravity")
        {
            // The fix computes its components in init(), which LIGGGHTS itself calls only before the first step.
            fix->init();
            Vector3d ofFix = Vector3d::Zero();
            static_cast<lmp::FixGravity*>(fix)->get_gravity(ofFix.data());
            acceleration += ofFix;
        }
    });
    return acceleration;
}

std::vector<ContactMaterial> contactMaterialsOf(const LiggghtsProgram& program)
{
    lmp::Modify& modify = *program->modify;
    const int materialCount = program->atom->ntypes;
    const auto property = [&](const char* name) {
        return static_cast<lmp::FixPropertyGlobal*>(
            modify.find_fix_property(name, "property/global", "peratomtype", materialCount, 0, "coupling", false));
    };
    auto* const youngsModulus = property("youngsModulus");
    auto* const poissonRatio = property("poissonsRatio");
    std::vector<ContactMaterial> materials;
    if (youngsModulus && poissonRatio)
    {
        for (int material = 0; material < materialCount; ++material)
        {
            materials.push_back({youngsModulus->compute_vector(material), poissonRatio->compute_vector(material)});
        }
    }
    return materials;
}

std::vector<double> specificHeatsOf(const LiggghtsProgram& program)
{
    const int materialCount = program->atom->ntypes;
    auto* const fix = static_cast<lmp::FixPropertyGlobal*>(program->modify->find_fix_property(
        specificHeatName, "property/global", "peratomtype", materialCount, 0, "coupling"));
    std::vector<double> specificHeats;
    for (int material = 0; material < materialCount; ++material)
    {
        specificHeats.push_back(fix->compute_vector(material));
    }
    return specificHeats;
}

std::vector<ScriptCommand> unreadProperties(const LiggghtsProgram& program, const std::vector<ScriptCommand>& commands)
{
    const std::set<std::string>* const read = propertiesRead(*program);
    std::vector<ScriptCommand> unread;
    for (const ScriptCommand& command : commands)
    {
        const auto [id, property] = propertyOf(command.text);
        const std::string reference = "f_" + id;
        const bool isRead = read == nullptr || read->count(property) > 0
                            || std::any_of(commands.begin(), commands.end(), [&](const ScriptCommand& other) {
                                   return other.text.find(reference) != std::string::npos;
                               });
        const int fix = property.empty() ? -1 : program->modify->find_fix(id.c_str());
        if (fix >= 0 && !isRead && hasValues(*program->modify->fix[fix]))
        {
            unread.push_back(command);
        }
    }
    return unread;
}

} // namespace clepsydra
