#include "scriptRules.h"

#include "couplingStep/energy.h"
#include "distribution/cyclicPatches.h"
#include "forces/forceFamily.h"
#include "movingWalls.h"
#include "runTimeSelection.h"
#include "wordRes.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace clepsydra
{

namespace
{

/// Styles of fixes that cases and tests of this program use with a fluid, that measure only, or that LIGGGHTS makes for
/// itself.
const std::set<std::string> knownFixes = {
    // motion and weight
    "nve/sphere", "nve", "nve/noforce", "move", "freeze", "gravity",
    // walls
    "wall/gran", "mesh/surface", "mesh/surface/planar",
    // insertion
    "insert/pack", "insert/rate/region", "insert/stream", "particletemplate/sphere", "particledistribution/discrete",
    "particledistribution/discrete/massbased", "particledistribution/discrete/numberbased",
    // values
    "property/global", "custom_property/global", "property/atomtype", "property/atomtypepair", "property/atom",
    "property/atom/tracer", "property/atom/tracer/stream", "property/atom/timetracer",
    "property/atom/regiontracer/time",
    // output
    "ave/atom", "ave/correlate", "ave/euler", "ave/euler/stress", "ave/histo", "ave/spatial", "ave/time",
    "check/timestep/gran", "massflow/mesh", "print", "store/force", "store/state",
    // the boxes of the ranks
    "balance",
    // made by LIGGGHTS itself
    "READ_RESTART", "STORE", "contacthistory", "contacthistory/mesh", "neighlist/mesh", "contactproperty/atom",
    "contactproperty/atom/wall", "diam/max"};

/// Styles of LIGGGHTS' heat conduction, which work with a fluid whose temperature is computed.
const std::set<std::string> heatFixes = {"heat/gran", "heat/gran/conduction", "transportequation/scalar"};

/// Why fixes are not known to work with a fluid, by the beginning of their style.
const std::map<std::string, std::string> reasons = {
    {"buoyancy", "the fluid's forces are those of forceModels, and this force would be added to them"},
    {"concave", "the spheres of a body overlap, and the fluid would count the volume of the overlap twice"},
    {"couple/cfd", "the coupling works without LIGGGHTS' own fixes for it"},
    {"deform", "the DEM box changes, and the fluid's mesh does not"},
    {"drag", "the fluid's forces are those of forceModels, and this force would be added to them"},
    {"external", "the coupling adds its own fix of this style, which must be the only one"},
    {"heat/", "the fluid neither heats nor cools the particles without the dictionary 'energy' in couplingProperties"},
    {"multisphere", "the spheres of a body overlap, and the fluid would count the volume of the overlap twice"},
    {"particletemplate/multi",
        "the spheres of a body overlap, and the fluid would count the volume of the overlap twice"},
    {"rigid", "the spheres of a body overlap, and the fluid would count the volume of the overlap twice"},
    {"viscous", "the fluid's forces are those of forceModels, and this force would be added to them"}};

/// The words of a contact law after which the name of a model stands, and the models of these that keep the stress where
/// parcels have the coefficients of the real particles (Bierwisch's rule, closures/parcelScaling.h): of their
/// coefficients only moduli, energy densities, velocities and pure numbers enter, so that with all lengths multiplied by
/// a forces are multiplied by a^2 and torques by a^3. A stiffness, a surface tension or a viscosity would have to change.
const std::map<std::string, std::set<std::string>> contactsOfParcels = {{"model", {"hertz", "hooke"}},
    {"tangential", {"history", "no_history"}}, {"rolling_friction", {"off", "cdt", "epsd", "epsd2"}},
    {"cohesion", {"off", "sjkr", "sjkr2"}}, {"surface", {"default"}}, {"viscous", {"off"}}};

/// Something that the script holds and that is not known to work with a fluid.
struct Unknown
{
    std::string place; ///< of a command in the script; may be empty
    std::string what;
    std::string name; ///< by which `allowedInScript` allows it
};

/// A command of a table in columns, or of several lines, with single blanks.
std::string placeOf(const ScriptCommand& command)
{
    std::istringstream tokens(command.text);
    std::string text;
    for (std::string token; tokens >> token;)
    {
        text += (text.empty() ? "" : " ") + token;
    }
    return command.where.empty() ? std::string() : command.where + ": '" + text + "': ";
}

std::string placeOf(const ScriptFacts& facts, const std::string& command)
{
    const ScriptCommand* const found = facts.lastCommand(command);
    return found ? placeOf(*found) : std::string();
}

std::string reasonFor(const std::string& style)
{
    for (const auto& [beginning, reason] : reasons)
    {
        if (style.rfind(beginning, 0) == 0)
        {
            return reason;
        }
    }
    return "it is not known to work with a fluid";
}

/// Whether constant/g can be the particles' gravity: the fix acts on all particles that move, and is constant.
std::string objectionToGravity(const ScriptFacts::Fix& gravity, const ScriptFacts& facts)
{
    for (const ScriptFacts::Fix& fix : facts.fixes)
    {
        if (gravity.group != "all" && fix.integrates && fix.group != gravity.group)
        {
            return "gravity acts on the group '" + gravity.group + "' only, and fix " + fix.id + " moves the group '"
                   + fix.group + "', but constant/g gives buoyancy to all particles";
        }
    }
    return gravity.command.text.find(" v_") != std::string::npos ? "gravity changes in time, but constant/g is constant"
                                                                 : std::string();
}

/// Whether a force depends on the acceleration of the particles.
bool hasAddedMass(const CouplingSettings& settings)
{
    wordList names = ForceLines::namesOf(ForceFamily::addedMass);
    names.append(ForceLines::namesOf(ForceFamily::history));
    const wordList models = settings.dict().getOrDefault<wordList>("forceModels", wordList());
    return std::any_of(models.begin(), models.end(), [&](const word& model) { return names.found(model); });
}

/// Whether fix move can be beside the forces: they take particles that it moves for particles without acceleration.
std::string objectionToMove(const ScriptFacts::Fix& move, const CouplingSettings& settings)
{
    const std::vector<std::string> words = tokensOf(move.command.text);
    constexpr std::size_t kindOfMotion = 4;
    return words.size() > kindOfMotion && words[kindOfMotion] != "linear" && hasAddedMass(settings)
               ? "the motion '" + words[kindOfMotion]
                     + "' accelerates particles, and the forces of added mass and history take particles that fix move "
                       "moves for ones with a constant velocity"
               : std::string();
}

void addFixes(const ScriptFacts& facts, const CouplingSettings& settings, std::vector<Unknown>& unknown)
{
    const bool hasEnergy = clepsydra::hasEnergy(settings);
    const bool hasIf = facts.lastCommand("if") != nullptr;
    for (const ScriptFacts::Fix& fix : facts.fixes)
    {
        // A fix without a command belongs to one that has a command, unless an `if` has made it.
        if ((fix.command.text.empty() && !hasIf) || fix.style == "move/mesh")
        {
            continue;
        }
        const std::string place = placeOf(fix.command);
        const std::string name = "fix " + fix.id + " has the style '" + fix.style + "': ";
        const bool isKnown = knownFixes.count(fix.style) > 0 || (hasEnergy && heatFixes.count(fix.style) > 0);
        if (!isKnown)
        {
            unknown.push_back({place, name + reasonFor(fix.style), fix.style});
        }
        if (const std::string objection = fix.style == "gravity" ? objectionToGravity(fix, facts)
                                          : fix.style == "move"  ? objectionToMove(fix, settings)
                                                                 : std::string();
            !objection.empty())
        {
            unknown.push_back({place, name + objection, fix.style});
        }
    }
}

/// \param meshMoves  whether WallsOfMovingMesh compares all walls whose motion is known
void addMovingWalls(const ScriptFacts& facts, const fvMesh& mesh, bool meshMoves, std::vector<Unknown>& unknown)
{
    std::vector<WallMotion> walls = wallMotions(facts);
    if (meshMoves)
    {
        walls.erase(std::remove_if(walls.begin(), walls.end(),
                        [](const WallMotion& wall) { return wall.kind == "move/mesh" || wall.unknownBecause.empty(); }),
            walls.end());
    }
    for (const auto& [wall, reason] : wallsWithoutPatch(walls, mesh))
    {
        unknown.push_back({placeOf(wall.command),
            "fix " + wall.fix + (wall.kind == "move/mesh" ? " has the style '" : " has the word '") + wall.kind
                + "': " + reason,
            wall.kind});
    }
}

/// Contact models of one command that are not known to be right between parcels.
void addContactsOfParcels(const ScriptCommand& command, double coarseGraining, std::vector<Unknown>& unknown)
{
    const std::vector<std::string> words = tokensOf(command.text);
    for (std::size_t i = 0; i + 1 < words.size(); ++i)
    {
        const std::string& value = words[i + 1];
        const auto known = contactsOfParcels.find(words[i]);
        if (known != contactsOfParcels.end() && known->second.count(value) == 0)
        {
            std::ostringstream what;
            what << "'" << words[i] << ' ' << value << "' is not known to be right between parcels (coarseGraining "
                 << coarseGraining << "): its coefficients would have to be those of parcels";
            unknown.push_back({placeOf(command), what.str(), value});
        }
    }
}

void addContactsOfParcels(const ScriptFacts& facts, double coarseGraining, std::vector<Unknown>& unknown)
{
    if (const ScriptCommand* const contacts = facts.lastCommand("pair_style"); contacts != nullptr)
    {
        addContactsOfParcels(*contacts, coarseGraining, unknown);
    }
    for (const ScriptFacts::Fix& fix : facts.fixes)
    {
        if (fix.style == "wall/gran")
        {
            addContactsOfParcels(fix.command, coarseGraining, unknown);
        }
        if (heatFixes.count(fix.style) > 0 && !fix.command.text.empty())
        {
            unknown.push_back({placeOf(fix.command),
                "fix " + fix.id + " has the style '" + fix.style
                    + "': heat that parcels conduct through their contacts is not that of their particles",
                fix.style});
        }
    }
}

std::vector<Unknown> unknownWithFluid(
    const CouplingSettings& settings, const ScriptFacts& facts, const fvMesh& mesh, bool meshMoves)
{
    std::vector<Unknown> unknown;
    const auto requireOneOf = [&](const std::string& command, const std::string& style,
                                  const std::set<std::string>& known) {
        if (known.count(style) == 0)
        {
            unknown.push_back({placeOf(facts, command),
                command + " is '" + style + "', which is not known to work with a fluid", style});
        }
    };
    requireOneOf("atom_style", facts.atomStyle, {"granular", "sphere"});
    requireOneOf("pair_style", facts.pairStyle, {"gran", "none"});
    requireOneOf("run_style", facts.runStyle, {"verlet"});
    addFixes(facts, settings, unknown);
    addMovingWalls(facts, mesh, meshMoves, unknown);
    if (settings.coarseGraining() != 1)
    {
        addContactsOfParcels(facts, settings.coarseGraining(), unknown);
    }
    return unknown;
}

/// What is wrong with a fluid in every case.
void requireRightWithFluid(const dictionary& demDict, const ScriptFacts& facts)
{
    if (facts.unitStyle != "si")
    {
        FatalIOErrorInFunction(demDict) << placeOf(facts, "units").c_str() << "The DEM script has units "
                                        << facts.unitStyle.c_str() << "; allowed with a fluid: units si"
                                        << exit(FatalIOError);
    }
    for (const auto& [first, second] : facts.integratedTwice)
    {
        FatalIOErrorInFunction(demDict) << placeOf(facts, "fix " + second).c_str() << "The fixes " << first.c_str()
                                        << " and " << second.c_str()
                                        << " move the same particles, which then move twice in each DEM step; allowed: "
                                        << "groups that have no particle in common" << exit(FatalIOError);
    }
}

/// A coupling step is a number of DEM steps of one length, with and without fluid.
void requireConstantDemStep(const dictionary& demDict, const ScriptFacts& facts)
{
    for (const ScriptFacts::Fix& fix : facts.fixes)
    {
        if (fix.style == "dt/reset")
        {
            FatalIOErrorInFunction(demDict)
                << placeOf(fix.command).c_str() << "fix " << fix.id.c_str()
                << " changes the DEM step during the run, but a coupling step is a number of DEM steps of one length; "
                << "allowed: a script without 'dt/reset' and with a constant timestep" << exit(FatalIOError);
        }
    }
}

/// What is wrong with the DEM box along an axis; empty where it is periodic exactly where the mesh is.
/// \param patches  the cyclic ones at the ends of the mesh along the axis
std::string objectionToBox(
    const ScriptFacts& facts, const PeriodicBox& mesh, const std::string& patches, Eigen::Index axis)
{
    const char name = "xyz"[axis];
    std::ostringstream text;
    const auto range = [&text](double low, double length) { text << "from " << low << " to " << low + length << " m"; };
    if (!facts.periodic.isPeriodic(axis) && mesh.isPeriodic(axis))
    {
        text << placeOf(facts, "boundary") << "the fluid's mesh has the cyclic patches " << patches << " along " << name
             << ", but the DEM box is not periodic there; allowed: p in the command boundary, and a box ";
        range(mesh.low[axis], mesh.length[axis]);
    }
    else if (facts.periodic.isPeriodic(axis) && !mesh.isPeriodic(axis))
    {
        text << placeOf(facts, "boundary") << "the DEM box is periodic along " << name
             << ": a particle that leaves it appears at the other side, but the fluid's mesh has no cyclic patches "
             << "there; allowed: f, or a pair of cyclic patches at the ends of the box ";
        range(facts.periodic.low[axis], facts.periodic.length[axis]);
    }
    else if (mesh.isPeriodic(axis)
             && std::max(std::abs(facts.periodic.low[axis] - mesh.low[axis]),
                    std::abs(facts.periodic.length[axis] - mesh.length[axis]))
                    > roundingOfMeshPoints * mesh.length[axis])
    {
        text << placeOf(facts, "create_box") << "the periodic DEM box is ";
        range(facts.periodic.low[axis], facts.periodic.length[axis]);
        text << " along " << name << ", but the cyclic patches " << patches << " are at the ends of the mesh ";
        range(mesh.low[axis], mesh.length[axis]);
        text << "; allowed: the same in both";
    }
    return text.str();
}

} // namespace

void requireSamePeriodicBox(const CouplingSettings& settings, const ScriptFacts& facts, const fvMesh& mesh)
{
    const auto [periodic, patches] = periodicityOf(mesh);
    std::string objections;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
        const std::string objection = objectionToBox(facts, periodic, patches[static_cast<std::size_t>(axis)], axis);
        objections += objection.empty() ? "" : "    " + objection + '\n';
    }
    if (objections.empty() && periodic.isPeriodic() && facts.isTriclinic)
    {
        objections = "    " + placeOf(facts, "create_box")
                     + "the DEM box is sheared (triclinic); allowed: a box along the axes, as the mesh is periodic\n";
    }
    if (!objections.empty())
    {
        const dictionary& demDict = settings.demDict();
        FatalIOErrorInFunction(demDict) << "The DEM script " << demDict.get<fileName>("script").c_str()
                                        << " and the cyclic patches in constant/polyMesh/boundary do not agree:\n"
                                        << objections.c_str() << exit(FatalIOError);
    }
}

void requireKnownScript(const CouplingSettings& settings, const ScriptFacts& facts, const fvMesh& mesh, bool meshMoves)
{
    const dictionary& demDict = settings.demDict();
    requireConstantDemStep(demDict, facts);
    const wordRes allowed = demDict.getOrDefault<wordRes>("allowedInScript", {});
    if (!settings.hasFluid())
    {
        return;
    }
    requireRightWithFluid(demDict, facts);
    std::string text;
    std::set<std::string> names;
    for (const auto& [place, what, name] : unknownWithFluid(settings, facts, mesh, meshMoves))
    {
        if (!allowed.match(name))
        {
            text += "    " + place + what + '\n';
            names.insert('"' + name + '"');
        }
    }
    if (names.empty())
    {
        return;
    }
    std::string list;
    for (const std::string& name : names)
    {
        list += name + ' ';
    }
    FatalIOErrorInFunction(demDict)
        << "The DEM script " << demDict.get<fileName>("script").c_str()
        << " contains commands that are not known to work with a fluid:\n"
        << text.c_str() << "allowed: a script without it; or, where you know that the results are right, the entry\n"
        << "    allowedInScript ( " << list.c_str() << ");\nin the dictionary DEM" << exit(FatalIOError);
}

void warnOfUnreadProperties(const std::vector<ScriptCommand>& properties)
{
    for (const ScriptCommand& property : properties)
    {
        if (Pstream::master())
        {
            WarningInFunction << placeOf(property).c_str()
                              << "no model of pair_style and no wall or other fix reads these values, so they have no "
                              << "effect; allowed: a contact model that uses them (as 'rolling_friction cdt' uses "
                              << "coefficientRollingFriction), or a script without the line" << endl;
        }
    }
}

} // namespace clepsydra
