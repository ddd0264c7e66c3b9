#include "output/runOutput.h"

#include "output/costModel.h"
#include "output/massInHopper.h"
#include "output/startReport.h"

#include "IOmanip.H"
#include "globalMeshData.H"

#include <cstdlib>

namespace clepsydra
{

using namespace Foam;

RunOutput::RunOutput(RunTime& time, const fvMesh& mesh, const CouplingSettings& settings, const FluidProperties& fluid,
    DemEngine& engine, const FluidModels* models, CouplingInterval& interval, const Checkpoints& checkpoints)
    : time_(time),
      mesh_(mesh),
      settings_(settings),
      engine_(engine),
      interval_(interval),
      checkpoints_(checkpoints),
      stopRequest_(time)
{
    printReport(fluid, models);
}

void RunOutput::printReport(const FluidProperties& fluid, const FluidModels* models)
{
    std::vector<std::string> lines;
    if (models)
    {
        for (const ForceModel& force : models->forces.models())
        {
            lines.push_back("force          " + force.description());
        }
        lines.push_back("void fraction  " + models->distribution.voidFractionModel().description());
        lines.push_back("smoothing      " + models->distribution.smoothingModel().description());
    }
    for (const std::string& choice : settings_.descriptions())
    {
        lines.push_back(choice);
    }
    const DemTimeScales scales = demTimeScales(engine_, settings_.couplingInterval(), models ? &fluid : nullptr, mesh_);
    printStartReport(engine_, lines, scales, settings_.demDict());
    printEstimate(static_cast<double>(scales.beads), models != nullptr);
    checkDemStep(scales, settings_.demDict());
    demStepChecked_ = scales.beads > 0;
}

void RunOutput::printEstimate(double beads, bool withFluid) const
{
    const char* clepsydra = std::getenv("CLEPSYDRA");
    const std::optional<CostModel> model =
        clepsydra ? CostModel::read(std::filesystem::path(clepsydra) / "scripts/benchmarks/costModel.json")
                  : std::nullopt;
    if (!model || !(beads > 0))
    {
        return;
    }
    const double duration = time_.endTime().value() - time_.value();
    const RunWork work{beads, withFluid ? static_cast<double>(mesh_.globalData().nTotalCells()) : 0,
        duration / engine_.timeStep(), duration / settings_.couplingInterval()};
    Info << "Estimated wall time: " << round(model->seconds(work, Pstream::nProcs())) << " s to "
         << time_.endTime().value() << " s, from costs measured on " << model->machine.c_str() << nl << endl;
}

void RunOutput::start()
{
    // They check their entries now, before anything of an earlier run is replaced.
    time_.functionObjects().start();
    if (settings_.writeVtk())
    {
        beadWriter_ = std::make_unique<BeadWriter>(time_);
        beadWriter_->write(engine_.beads(), time_.value());
    }
}

void RunOutput::checkDemStepOnce()
{
    if (!demStepChecked_)
    {
        const DemTimeScales scales = demTimeScales(engine_, settings_.couplingInterval(), nullptr, mesh_);
        checkDemStep(scales, settings_.demDict());
        demStepChecked_ = scales.beads > 0;
    }
}

bool RunOutput::afterInterval()
{
    const PhaseTimers::Scope timing = interval_.timers().time("output");
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
    // Their state is part of the checkpoint.
    time_.functionObjects().execute();
    if (atWriteTime)
    {
        writeCheckpoint();
        progress_.clear();
        if (beadWriter_)
        {
            beadWriter_->write(engine_.beads(), time_.value());
        }
        interval_.ledger().report();
        checkDemStepOnce();
    }
    progress_.update(time_.value(), time_.endTime().value(), MassInHopper::lastCount(time_), atWriteTime);
    return atWriteTime;
}

void RunOutput::writeCheckpoint()
{
    if (!time_.write())
    {
        FatalErrorInFunction << "The fields of time " << time_.timeName() << " could not be written to "
                             << time_.timePath() << ": is the disk full? The same command goes on from the checkpoint "
                             << "before" << exit(FatalError);
    }
    checkpoints_.complete(engine_);
}

void RunOutput::finish()
{
    progress_.clear();
    time_.functionObjects().end();
    interval_.ledger().report();

    const PhaseTimers& timers = interval_.timers();
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
    const double sent = settings_.hasFluid() ? static_cast<double>(interval_.fluid().exchange().bytesSent()) : 0;
    interval_.ledger().writeSummary(timers, returnReduce(sent, sumOp<scalar>()));
}

} // namespace clepsydra
