#include "couplingStep/energy.h"
#include "demProgram.h"
#include "engine/liggghts/liggghtsEngine.h"
#include "engine/liggghts/script.h"
#include "liggghtsSetup.h"
#include "movingWalls.h"
#include "scriptRules.h"
#include "wallsOfMovingMesh.h"

#include "addToRunTimeSelectionTable.H"

#include <memory>

namespace clepsydra
{

namespace
{

/// The DEM script gives the particles' weight and constant/g their buoyancy, so both must have the same gravity.
void requireSameGravity(const FluidProperties& fluid, const DemEngine& engine, const ScriptFacts& script)
{
    const Vector3d dem = engine.gravity();
    if ((fluid.gravity - dem).norm() > 1e-6 * fluid.gravity.norm())
    {
        const std::vector<std::string> fixes = script.fixesOfStyle("gravity");
        std::string together;
        for (const std::string& id : fixes)
        {
            together += fixes.size() > 1 ? (together.empty() ? " (together: " : ", ") + id : "";
        }
        together += together.empty() ? "" : ")";
        FatalErrorInFunction << "constant/g is (" << fluid.gravity.x() << ' ' << fluid.gravity.y() << ' '
                             << fluid.gravity.z() << ") m/s2, but fix gravity of the DEM script" << together.c_str()
                             << " gives (" << dem.x() << ' ' << dem.y() << ' ' << dem.z()
                             << ") m/s2; allowed: the same in both" << exit(FatalError);
    }
}

/// The temperature and the specific heat of the particles are stated once: in the script, where LIGGGHTS' own heat
/// conduction reads them, or in the dictionary `energy`.
void requireHeatStatedOnce(const dictionary& energy, const ScriptFacts& script)
{
    const auto requireOnce = [&](const word& entry, bool inScript, const char* command) {
        if (energy.found(entry) == inScript)
        {
            FatalIOErrorInFunction(energy)
                << "'" << entry << "' is given " << (inScript ? "both by the entry" : "neither by an entry")
                << " in the dictionary 'energy' " << (inScript ? "and" : "nor") << " by '" << command
                << "' in the DEM script; allowed: exactly one of the two" << exit(FatalIOError);
        }
    };
    requireOnce("particleTemperature", script.hasTemperature, "fix heat/gran' or 'fix property/atom Temp scalar");
    requireOnce("particleCp", script.hasSpecificHeat, "fix property/global thermalCapacity peratomtype");
    if (script.hasTemperature && !script.temperatureInRestartFiles)
    {
        FatalIOErrorInFunction(energy)
            << "'fix property/atom Temp scalar' in the DEM script is not in restart files, so "
            << "that a resumed run would lose the particles' temperatures; allowed: "
            << "'property/atom Temp scalar yes yes no <temperature>'" << exit(FatalIOError);
    }
}

/// A case whose particles LIGGGHTS moves.
class LiggghtsCase final : public DemProgram
{
public:
    TypeName("liggghts");

    LiggghtsCase(const CouplingSettings& settings, bool writesNothing)
        : settings_(settings),
          setup_(liggghtsSetup(settings, writesNothing))
    {}

    std::vector<std::filesystem::path> inputs() const override
    {
        return filesOfScript(setup_.script, setup_.variables);
    }

    DemEngine& start(
        const Checkpoints& checkpoints, const fvMesh& mesh, bool meshMoves, const FluidProperties* fluid) override
    {
        if (checkpoints.resumed())
        {
            resume(setup_, checkpoints);
        }
        engine_ = std::make_unique<LiggghtsEngine>(setup_);
        const ScriptFacts script = engine_->scriptFacts();
        requireKnownScript(settings_, script, mesh, meshMoves);
        if (hasEnergy(settings_))
        {
            requireHeatStatedOnce(settings_.dict().subDict("energy"), script);
        }
        if (fluid)
        {
            requireSameGravity(*fluid, *engine_, script);
            requireSamePeriodicBox(settings_, script, mesh);
            if (meshMoves)
            {
                walls_ = std::make_unique<WallsOfMovingMesh>(mesh, settings_, *engine_, wallMotions(script));
            }
            else
            {
                warnOfPatchesWithoutWall(mesh, wallMotions(script));
            }
        }
        return *engine_;
    }

    void checkMovedWalls(const volVectorField& U) override
    {
        walls_->check(U);
    }

    void warnOfUnreadInput() const override
    {
        warnOfUnreadProperties(engine_->unreadProperties());
    }

private:
    const CouplingSettings& settings_;
    LiggghtsSetup setup_;
    std::unique_ptr<LiggghtsEngine> engine_;
    /// Null where the mesh of the fluid is at rest.
    std::unique_ptr<WallsOfMovingMesh> walls_;
};

defineTypeNameAndDebug(LiggghtsCase, 0);
addToRunTimeSelectionTable(DemProgram, LiggghtsCase, settings);
const ModelLines lines("DEM/engine", {{LiggghtsCase::typeName_(), "LIGGGHTS 3.8, driven by a script"}});

} // namespace

} // namespace clepsydra
