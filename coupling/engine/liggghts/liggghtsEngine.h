#pragma once

#include "engine/demEngine.h"
#include "engine/liggghts/groupChanges.h"
#include "engine/liggghts/scriptFacts.h"

#include <mpi.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace clepsydra
{

/// Settings of a LIGGGHTS run.
struct LiggghtsSetup
{
    std::filesystem::path script;
    /// Each becomes `variable <name> equal|string <value>` before the first line of the script.
    std::vector<std::pair<std::string, std::string>> variables;
    std::filesystem::path logFile;
    /// Leaves out the script's commands that write files.
    bool writesNothing = false;
    /// Name of a checkpoint to resume from, as it was passed to DemEngine::writeCheckpoint(); empty for a fresh start.
    /// With a checkpoint, the script's first `create_box`, `read_data` or `read_restart` reads the checkpoint instead,
    /// and other commands whose result it holds (`create_atoms`, `group`, `set`, `velocity`, `replicate`, ...) or that
    /// wrote a file at the start are left out; see onResume(). Materials, walls and fixes are created as in a fresh
    /// start.
    std::filesystem::path resumeFrom;
    /// The files that the run had open at the checkpoint, on all ranks, with their sizes then. They are continued from
    /// there.
    std::vector<EngineOutput> outputs;
    /// Applied in this order after each coupling step.
    std::vector<GroupChange> groupChanges;
    /// Called on the first rank with each warning that LIGGGHTS prints, and the place in the script.
    std::function<void(const std::string&)> onWarning;
    MPI_Comm communicator = MPI_COMM_WORLD;
};

/// LIGGGHTS 3.8 in this process. The script sets up particles, walls, contacts and gravity. It must not define
/// `fix external`, which the coupling adds as the last fix, so that it has access to all other forces, and no fix that
/// changes the DEM step.
class LiggghtsEngine final : public DemEngine
{
public:
    /// Runs the script. \throws DemEngineError that names the script, the line and LIGGGHTS' own message
    explicit LiggghtsEngine(const LiggghtsSetup& setup);
    ~LiggghtsEngine() override;

    /// What the script has made of LIGGGHTS. Collective. \pre not yet initialised
    ScriptFacts scriptFacts() const;

    /// See the function of this name. Local. \pre initialised
    std::vector<ScriptCommand> unreadProperties() const;

    void requestPairs(double reach) override;
    void requestState(const std::vector<double>& ofNewParticle) override;
    void requestMemory(int numbers) override;
    void initialise(FluidForces* forces) override;
    void advance(int steps) override;
    void prepare() override;
    void evaluateFluidForces() override;
    void remove(const std::vector<int>& ids) override;
    ParticlesView particles() override;
    double timeStep() const override;
    Vector3d gravity() const override;
    std::vector<ContactMaterial> contactMaterials() const override;
    std::vector<std::filesystem::path> writeCheckpoint(const std::filesystem::path& name) override;
    std::vector<EngineOutput> outputs() override;
    std::string version() const override;

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace clepsydra
