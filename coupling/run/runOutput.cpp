#include "run/runOutput.h"

#include "couplingStep/heatTransferModel.h"
#include "files/writeFailures.h"
#include "functionObjects/massInHopper.h"
#include "run/caseSizes.h"
#include "run/equations.h"
#include "run/startReport.h"
#include "run/unreadFields.h"

#include "IOmanip.H"
#include "functionObject.H"
#include "globalMeshData.H"
#include "memInfo.H"

#include <cmath>
#include <numeric>
#include <sstream>

namespace clepsydra
{

using namespace Foam;

namespace
{

std::string describe(const closures::Stratification& liquid)
{
    std::ostringstream line;
    line << "viscosity      stratified: ln(nu) decreases by " << liquid.step << " at " << liquid.height
         << " m over an edge of standard deviation " << liquid.width << " m, gradient " << liquid.gradient
         << " 1/m; a particle has the viscosity " << liquid.lag << " d above it";
    return line.str();
}

std::string describe(const PeriodicBox& periodic)
{
    std::ostringstream line;
    line << "periodic      ";
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
        if (periodic.isPeriodic(axis))
        {
            line << " along "
                 << "xyz"[axis] << " over " << periodic.length[axis] << " m";
        }
    }
    return line.str();
}

double sum(const std::map<std::string, double>& secondsByPhase)
{
    return std::accumulate(secondsByPhase.begin(), secondsByPhase.end(), 0.0,
        [](double all, const auto& phase) { return all + phase.second; });
}

} // namespace

RunOutput::RunOutput(RunTime& time, const fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
    DemEngine& engine, const FluidModels* models, const std::optional<Energy>& energy, CouplingStep& couplingStep,
    const Checkpoints& checkpoints, bool dryRun)
    : time_(time),
      mesh_(mesh),
      settings_(settings),
      engine_(engine),
      temperatures_(energy ? dynamic_cast<ParticleTemperatures*>(&engine) : nullptr),
      couplingStep_(couplingStep),
      checkpoints_(checkpoints),
      observedParticles_(mesh, engine),
      stopRequest_(time)
{
    if (dryRun)
    {
        scratch_ = std::make_unique<ScratchFolder>();
    }
    startTime_ = time_.value();
    couplingStepCount_ = (time_.endTime().value() - startTime_) / settings_.couplingTimeStep();
    printReport(fluid, models, energy);
    if (models)
    {
        const double smoothingBandwidth = models->distribution.smoothingModel().bandwidth();
        checkCaseSizes(mesh_, engine_.particles(), smoothingBandwidth, settings_.dict());
        runChecks_ = std::make_unique<RunChecks>(mesh_, smoothingBandwidth);
    }
}

void RunOutput::printReport(
    const FluidProperties& fluid, const FluidModels* models, const std::optional<Energy>& energy)
{
    std::vector<std::string> lines;
    if (models)
    {
        for (const ForceModel& force : models->forces.models())
        {
            lines.push_back("force          " + force.description());
        }
        if (fluid.stratification.isThere())
        {
            lines.push_back(describe(fluid.stratification));
        }
        if (energy)
        {
            lines.push_back("heat           " + HeatTransferModel::New(energy->dict)->description());
        }
        lines.push_back("void fraction  " + models->distribution.voidFractionModel().description());
        lines.push_back("smoothing      " + models->distribution.smoothingModel().description());
        if (const PeriodicBox& periodic = models->distribution.periodicBox(); periodic.isPeriodic())
        {
            lines.push_back(describe(periodic));
            lines.push_back("mean grad(p)   " + models->meanPressureGradient.description() + "; grad(p) contains it");
        }
    }
    for (const std::string& choice : settings_.descriptions())
    {
        lines.push_back(choice);
    }
    const DemTimeScales scales = demTimeScales(
        engine_, settings_.couplingTimeStep(), models ? &fluid : nullptr, mesh_, settings_.coarseGraining());
    printStartReport(engine_, lines, equations(settings_, fluid, models ? &models->forces : nullptr, energy), scales,
        settings_.demDict());
    checkDemStep(scales, settings_.demDict());
    demStepChecked_ = scales.particles > 0;
}

double RunOutput::estimate()
{
    const PhaseTimers& timers = couplingStep_.timers();
    const auto particles = static_cast<double>(couplingStep_.conservation().particles());
    const double couplingTimeStep = time_.deltaTValue();
    const double timeLeft = std::max(0.0, time_.endTime().value() - time_.value());
    const auto left = [&](CostModel& cost, const std::map<std::string, double>& seconds) {
        cost.add(particles, couplingTimeStep / engine_.timeStep());
        return cost.secondsLeft(seconds, particles, timeLeft / engine_.timeStep(), timeLeft / couplingTimeStep);
    };
    const double wall = left(wallCost_, timers.wallSeconds());
    const double processor = left(processorCost_, timers.processorSeconds());
    constexpr double firstPart = 0.01;
    constexpr double fewest = 5;
    if (!firstStepSeconds_)
    {
        firstStepSeconds_ =
            wallCost_.secondsLeft(timers.wallSeconds(), particles, couplingTimeStep / engine_.timeStep(), 1);
        // Its time is not counted from here on, because it also contains that of first access to memory.
        wallCost_ = CostModel(timers.wallSeconds());
        processorCost_ = CostModel(timers.processorSeconds());
        return -1;
    }
    const double done = time_.value() - startTime_;
    if (!estimateOfRun_ && wallCost_.couplingSteps() >= fewest && done >= firstPart * (done + timeLeft))
    {
        estimateOfRun_ = EstimatedSeconds{sum(timers.wallSeconds()) + wall, sum(timers.processorSeconds()) + processor};
        progress_.clear();
        Info << "Estimated wall time: " << round(wall) << " s until " << time_.endTime().value() << " s, from the last "
             << wallCost_.couplingSteps() << " coupling steps" << nl << endl;
    }
    return wall;
}

void RunOutput::start()
{
    reductionsBefore_ = RankTotals::reductions();
    if (!checkpoints_.resumed())
    {
        reportUnreadFields(mesh_);
    }
    if (scratch_)
    {
        // Without the check for characters that a word should not have, because this path leads out of the case.
        functionObject::outputPrefix =
            word(std::filesystem::relative(scratch_->path(), std::string(time_.globalPath())).string(), false);
    }
    const PhaseTimers& timers = couplingStep_.timers();
    wallCost_ = CostModel(timers.wallSeconds());
    processorCost_ = CostModel(timers.processorSeconds());
    // Function objects check their entries at this point, before any output of an earlier run is replaced.
    if (!time_.functionObjects().start())
    {
        // OpenFOAM itself would only warn, and the run would end without the table.
        FatalErrorInFunction << "A function object could not be started; the warning above gives the cause"
                             << exit(FatalError);
    }
    requireTablesWritten();
    if (scratch_)
    {
        return;
    }
    if (settings_.writeVtk())
    {
        particleWriter_ = std::make_unique<ParticleWriter>(time_);
        writeParticles();
    }
}

void RunOutput::checkDemStepOfParticles()
{
    if ((!demStepChecked_ || time_.writeTime()) && couplingStep_.conservation().particles() > 0)
    {
        const DemTimeScales scales = demTimeScales(engine_, settings_.couplingTimeStep(), nullptr, mesh_);
        checkDemStep(scales, settings_.demDict());
        demStepChecked_ = scales.particles > 0;
    }
}

void RunOutput::checkBedOnce()
{
    // A vessel that empties ends with a low bed; what counts is the bed that the user has set up.
    if (const std::optional<double> partNearClearFluid = couplingStep_.fluid().partNearClearFluid())
    {
        runChecks_->checkBed(*partNearClearFluid);
        bedChecked_ = true;
    }
}

void RunOutput::addTo(RankTotals& totals)
{
    if (runChecks_)
    {
        runChecks_->addTo(engine_.particles(), totals);
    }
    stopRequest_.addTo(totals);
}

void RunOutput::countReductions(bool atWriteTime)
{
    const long now = RankTotals::reductions();
    if (countsReductions_ && !atWriteTime)
    {
        reductions_ += now - reductionsBefore_;
        ++stepsWithCount_;
    }
    reductionsBefore_ = now;
    // After a checkpoint the run restarts in place.
    countsReductions_ = !atWriteTime;
}

bool RunOutput::afterCouplingStep()
{
    const PhaseTimers::Scope timing = couplingStep_.timers().time("output");
    checkDemStepOfParticles();
    if (runChecks_)
    {
        runChecks_->afterCouplingStep(couplingStep_.courantNumber());
        if (isFirstStep_ || (!bedChecked_ && time_.writeTime()))
        {
            checkBedOnce();
        }
        isFirstStep_ = false;
    }
    const double wallLeft = estimate();
    if (scratch_)
    {
        time_.endHere();
        return false;
    }
    if (stopRequest_.asked())
    {
        Info << "Asked to stop: writing a checkpoint" << endl;
        stopped_ = true;
        time_.endHere();
    }
    else if (time_.atEnd())
    {
        time_.writeHere();
    }
    const bool atWriteTime = time_.writeTime();
    if (atWriteTime)
    {
        checkpoints_.begin();
    }
    // The state of function objects is part of the checkpoint.
    time_.functionObjects().execute();
    requireTablesWritten();
    if (atWriteTime)
    {
        writeCheckpoint();
        progress_.clear();
        if (particleWriter_)
        {
            writeParticles();
        }
        couplingStep_.conservation().report();
    }
    countReductions(atWriteTime);
    progress_.update(time_.value(), time_.endTime().value(), MassInHopper::lastCount(time_), wallLeft, atWriteTime);
    return atWriteTime;
}

void RunOutput::requireTablesWritten() const
{
    const std::string failure = firstWriteFailure();
    if (!failure.empty())
    {
        FatalErrorInFunction << failure.c_str() << ". With `startFrom latestTime` the same command resumes "
                             << "from the last checkpoint" << exit(FatalError);
    }
}

void RunOutput::writeCheckpoint()
{
    if (!time_.write())
    {
        FatalErrorInFunction << "The fields of time " << time_.timeName() << " could not be written to "
                             << time_.timePath() << ": is the disk full? With `startFrom latestTime` the same command "
                             << "resumes from the previous checkpoint" << exit(FatalError);
    }
    requireTablesWritten();
    checkpoints_.complete(engine_);
}

void RunOutput::writeParticles()
{
    particleWriter_->write(
        engine_.particles(), time_.value(), temperatures_ ? temperatures_->temperatures().temperature.data() : nullptr);
}

void RunOutput::finish()
{
    progress_.clear();
    if (!scratch_)
    {
        time_.functionObjects().end();
        requireTablesWritten();
    }
    couplingStep_.conservation().report();
    if (runChecks_)
    {
        runChecks_->report();
    }

    const PhaseTimers& timers = couplingStep_.timers();
    double total = 0;
    for (const auto& [phase, time] : timers.wallSeconds())
    {
        total += time;
    }
    Info << nl << "Wall time by phase, and processor time (this rank)" << nl;
    for (const auto& [phase, time] : timers.wallSeconds())
    {
        Info << "    " << setw(12) << phase.c_str() << ' ' << setw(10) << time << " s " << setw(6)
             << round(1000 * time / total) / 10 << " % " << setw(10) << timers.processorSeconds().at(phase) << " s"
             << nl;
    }
    Info << endl;
    if (scratch_ && !firstStepSeconds_)
    {
        Info << "Case check: the case has reached its end, " << time_.value()
             << " s, so there is no coupling step to try. Nothing was written" << nl << endl;
        return;
    }
    if (scratch_)
    {
        const memInfo memory;
        const scalar mebibytes = returnReduce(scalar(memory.peak()), sumOp<scalar>()) / 1024;
        Info << "Case check: one coupling step took " << *firstStepSeconds_ << " s, so the "
             << round(couplingStepCount_) << " coupling steps to endTime take about "
             << round(couplingStepCount_ * *firstStepSeconds_) << " s if each takes as long; all ranks together use "
             << round(mebibytes) << " MiB of memory. The case would start; nothing was written" << nl << endl;
        return;
    }
    const double sent = settings_.hasFluid() ? static_cast<double>(couplingStep_.fluid().mapping().bytesSent()) : 0;
    const std::optional<double> reductionsPerStep =
        stepsWithCount_ > 0 ? std::optional(static_cast<double>(reductions_) / static_cast<double>(stepsWithCount_))
                            : std::nullopt;
    couplingStep_.conservation().writeSummary(
        timers, returnReduce(sent, sumOp<scalar>()), estimateOfRun_, reductionsPerStep);
}

} // namespace clepsydra
