#pragma once

#include "checkpoint/checkpoints.h"
#include "checkpoint/runTime.h"
#include "checkpoint/stopRequest.h"
#include "functionObjects/observedParticles.h"
#include "couplingStep/couplingStep.h"
#include "output/particleWriter.h"
#include "run/costModel.h"
#include "run/progress.h"
#include "run/runChecks.h"
#include "run/scratchFolder.h"

#include <memory>
#include <optional>

namespace clepsydra
{

/// What a run prints and writes: the report at its start, progress, and at write times OpenFOAM's fields, the particles
/// for ParaView and the conservation check's line. Or, of a run that only tries the case (`-dryRun`), the report and what one
/// interval has taken; files of function objects then go to a scratch folder.
class RunOutput
{
public:
    /// Prints the report. Collective. FatalIOError where the DEM step is above the stable one.
    /// \param models  null in a dry run
    RunOutput(RunTime& time, const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
        DemEngine& engine, const FluidModels* models, CouplingStep& couplingStep, const Checkpoints& checkpoints,
        bool dryRun = false);

    /// Starts the function objects and writes the first particles. Collective; once all fields exist.
    void start();

    /// True where a bar shows the progress, and other lines would break it.
    bool onTerminal() const
    {
        return progress_.isTerminal();
    }

    /// Collective; after each interval, when the fluid is solved. The state at the end of the run is a checkpoint, too.
    /// \return true if a checkpoint was written: the run must restart in place.
    bool afterCouplingStep();

    /// True where the run was asked to stop before its end.
    bool stopped() const
    {
        return stopped_;
    }

    /// Collective; after the last interval: the table of phases, and the conservation check's summary.
    void finish();

private:
    void checkDemStepOnce();
    void writeCheckpoint();
    void printReport(const FluidProperties& fluid, const FluidModels* models);
    /// After each couplingStep. \return wall time that is left [s], negative while it is not known
    double estimate();

    RunTime& time_;
    const Foam::fvMesh& mesh_;
    const CouplingSettings& settings_;
    DemEngine& engine_;
    CouplingStep& couplingStep_;
    const Checkpoints& checkpoints_;
    /// For function objects.
    ObservedParticles observedParticles_;
    std::unique_ptr<ParticleWriter> particleWriter_;
    Progress progress_;
    StopRequest stopRequest_;
    std::unique_ptr<RunChecks> runChecks_;
    /// Empty unless the run only tries the case.
    std::unique_ptr<ScratchFolder> scratch_;
    /// By wall and by processor time.
    CostModel wallCost_;
    CostModel processorCost_;
    std::optional<double> firstStepSeconds_;
    std::optional<EstimatedSeconds> estimateOfRun_;
    double startTime_ = 0;
    double couplingStepCount_ = 0;
    /// False while there are no particles yet: filling starts without.
    bool demStepChecked_ = false;
    bool stopped_ = false;
};

} // namespace clepsydra
