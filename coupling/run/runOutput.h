#pragma once

#include "checkpoint/checkpoints.h"
#include "checkpoint/runTime.h"
#include "checkpoint/stopRequest.h"
#include "functionObjects/observedParticles.h"
#include "couplingStep/couplingStep.h"
#include "couplingStep/energy.h"
#include "output/particleWriter.h"
#include "run/costModel.h"
#include "run/progress.h"
#include "run/runChecks.h"
#include "run/scratchFolder.h"

#include <memory>
#include <optional>

namespace clepsydra
{

/// Output of a run: the report at its start, the progress, and at write times OpenFOAM's fields, the particles for
/// ParaView and the line of the conservation check. With `-dryRun` it is the report and the duration of one coupling
/// step; files of function objects then go to a scratch folder.
class RunOutput
{
public:
    /// Prints the report. Collective. FatalIOError where the DEM step is above the stable one.
    /// \param models  null for DEM only
    /// \param energy  empty where the case has no temperatures
    /// \param dryRun  whether the case is only checked
    RunOutput(RunTime& time, const Foam::fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
        DemEngine& engine, const FluidModels* models, const std::optional<Energy>& energy, CouplingStep& couplingStep,
        const Checkpoints& checkpoints, bool dryRun = false);

    /// Starts the function objects and writes the first particles. Call when all fields exist. Collective.
    void start();

    /// Whether a progress bar is shown, which other lines would break.
    bool onTerminal() const
    {
        return progress_.isTerminal();
    }

    /// Adds what afterCouplingStep() needs of all ranks to the totals at the end of a coupling step. Local.
    void addTo(RankTotals& totals);

    /// Call after each coupling step, when these totals have been reduced. The state at the end of the run is a
    /// checkpoint, too. Collective.
    /// \return true if a checkpoint was written; the run must then restart in place
    bool afterCouplingStep();

    /// Whether the run was asked to stop before its end.
    bool stopped() const
    {
        return stopped_;
    }

    /// Prints the table of phases and writes the summary of the conservation check. Call after the last coupling step.
    /// Collective.
    void finish();

private:
    /// At the first step that has particles, and whenever a time is written: smaller ones may have been inserted.
    void checkDemStepOfParticles();
    void checkBedOnce();
    void requireTablesWritten() const;
    void writeCheckpoint();
    void writeParticles();
    /// Counts the reductions of a coupling step, unless this one or the last one wrote a checkpoint.
    void countReductions(bool atWriteTime);
    void printReport(const FluidProperties& fluid, const FluidModels* models, const std::optional<Energy>& energy);
    /// Updates the estimates of the run time after each coupling step. \return wall time that is left [s], negative
    /// where not known yet
    double estimate();

    RunTime& time_;
    const Foam::fvMesh& mesh_;
    const CouplingSettings& settings_;
    DemEngine& engine_;
    /// Null where the case has no temperatures.
    ParticleTemperatures* const temperatures_;
    CouplingStep& couplingStep_;
    const Checkpoints& checkpoints_;
    /// Gives function objects access to the particles.
    ObservedParticles observedParticles_;
    std::unique_ptr<ParticleWriter> particleWriter_;
    Progress progress_;
    StopRequest stopRequest_;
    std::unique_ptr<RunChecks> runChecks_;
    /// Null unless the case is only checked.
    std::unique_ptr<ScratchFolder> scratch_;
    /// Estimates of wall time and of processor time.
    CostModel wallCost_;
    CostModel processorCost_;
    std::optional<double> firstStepSeconds_;
    std::optional<EstimatedSeconds> estimateOfRun_;
    /// Reductions of RankTotals: before the coupling step, and in all that are counted.
    long reductionsBefore_ = 0;
    long reductions_ = 0;
    long stepsWithCount_ = 0;
    bool countsReductions_ = true;
    double startTime_ = 0;
    double couplingStepCount_ = 0;
    /// False while there are no particles yet, as at the start of a filling.
    bool demStepChecked_ = false;
    bool isFirstStep_ = true;
    /// False while there is no bed yet.
    bool bedChecked_ = false;
    bool stopped_ = false;
};

} // namespace clepsydra
