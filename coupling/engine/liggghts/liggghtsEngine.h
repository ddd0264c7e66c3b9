#pragma once

#include "engine/demEngine.h"
#include "engine/liggghts/scriptFacts.h"
#include "engine/liggghts/setup.h"
#include "engine/particleTemperatures.h"

#include <memory>
#include <vector>

namespace clepsydra
{

/// LIGGGHTS 3.8 in this process. The script sets up particles, walls, contacts and gravity. It must not define
/// `fix external`, which the coupling adds as the last fix, so that it has access to all other forces, and no fix that
/// changes the DEM step.
class LiggghtsEngine final : public DemEngine, public ParticleTemperatures
{
public:
    /// Runs the script. \throws DemEngineError that names the script, the line and LIGGGHTS' own message
    explicit LiggghtsEngine(const LiggghtsSetup& setup);
    ~LiggghtsEngine() override;

    /// What the script has made of LIGGGHTS. Collective. \pre not yet initialised
    ScriptFacts scriptFacts() const;

    /// See the function of this name. Local. \pre initialised
    std::vector<ScriptCommand> unreadProperties() const;

    void requestPairs(double reach, std::size_t ofState) override;
    void requestState(const std::vector<double>& ofNewParticle) override;
    void requestMemory(int numbers) override;
    void requestTemperatures(const HeatOfParticles& heat) override;
    TemperaturesView temperatures() override;
    void initialise(FluidForces* forces) override;
    void advance(int steps) override;
    void prepare() override;
    void evaluateFluidForces() override;
    void remove(const std::vector<int>& ids) override;
    ParticlesView particles() override;
    double timeStep() const override;
    Vector3d gravity() const override;
    PeriodicBox periodicBox() const override;
    Vector3d unwrappedPosition(Eigen::Index particle) override;
    std::vector<WallTriangle> movingWalls() const override;
    std::vector<ContactMaterial> contactMaterials() const override;
    std::vector<std::filesystem::path> writeCheckpoint(const std::filesystem::path& name) override;
    std::vector<EngineOutput> outputs() override;
    std::string version() const override;

private:
    void runSteps(int steps);

    struct Parts;
    const std::unique_ptr<Parts> parts_;
};

} // namespace clepsydra
