#pragma once

#include "engine/demEngine.h"
#include "engine/liggghts/script.h"
#include "engine/periodicBox.h"

#include <string>
#include <vector>

namespace clepsydra
{

class LiggghtsProgram;

/// What LIGGGHTS holds when the script has run, for the program that decides what of this it can work with.
struct ScriptFacts
{
    /// A fix with the command that has made it; without a place and a command where LIGGGHTS has made it by itself, or
    /// an `if` of the script.
    struct Fix
    {
        std::string id;
        std::string style;
        std::string group;
        ScriptCommand command;
        bool integrates;
    };

    /// Two fixes that integrate the same particles, which therefore move twice in each step.
    struct SharedParticles
    {
        std::string first;
        std::string second;
    };

    /// Ids of the fixes with a style, in the script's order.
    std::vector<std::string> fixesOfStyle(const std::string& style) const;

    /// The last command with a name, and for fixes with an id: "boundary", "fix gravity"; nullptr where the script has
    /// none.
    const ScriptCommand* lastCommand(const std::string& name) const;

    std::string unitStyle;
    std::string atomStyle;
    std::string runStyle;
    std::string pairStyle;
    /// Corners of the box.
    Box box;
    PeriodicBox periodic;
    /// Whether the box is sheared.
    bool isTriclinic = false;
    std::vector<Fix> fixes;
    std::vector<SharedParticles> integratedTwice;
    std::vector<ScriptCommand> commands;
    /// Whether the script gives each particle a temperature (`fix heat/gran`, or `fix property/atom Temp`), whether that is
    /// in restart files, and whether it gives each material a specific heat (`fix property/global thermalCapacity`).
    bool hasTemperature = false;
    bool temperatureInRestartFiles = false;
    bool hasSpecificHeat = false;
};

/// Names that LIGGGHTS' own heat conduction uses.
constexpr const char* temperatureName = "Temp";
constexpr const char* specificHeatName = "thermalCapacity";

/// The periodic directions of LIGGGHTS' box. Local.
PeriodicBox periodicBoxOf(const LiggghtsProgram& program);

/// \param commands  the script's that have been executed, each with the values of its variables
/// Collective.
ScriptFacts factsOf(const LiggghtsProgram& program, std::vector<ScriptCommand> commands);

/// Gravity, the sum of all fixes [m/s2]. Local.
Vector3d gravityOf(const LiggghtsProgram& program);

/// Contact materials of the fixes youngsModulus and poissonsRatio; empty where there are none. Local.
std::vector<ContactMaterial> contactMaterialsOf(const LiggghtsProgram& program);

/// Specific heat of each material [J/(kg K)]. \pre ScriptFacts::hasSpecificHeat. Local.
std::vector<double> specificHeatsOf(const LiggghtsProgram& program);

/// Commands `fix ... property/global` whose values no model, no fix and no other command has looked up, so that they
/// have no effect. Values that are all zero are left out, because they would have none either. Complete when LIGGGHTS
/// has been initialised.
/// \param commands  as for factsOf()
std::vector<ScriptCommand> unreadProperties(const LiggghtsProgram& program, const std::vector<ScriptCommand>& commands);

} // namespace clepsydra
