#include "ledger/ledger.h"

#include "files/wholeFile.h"

#include "IOmanip.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "runTimeSelection.h"

#include <nlohmann/json.hpp>

namespace clepsydra
{

namespace
{

double tolerance(const dictionary& dict, const word& entry, double byDefault)
{
    return dict.found(entry) ? positiveEntry(dict, entry) : byDefault;
}

} // namespace

Ledger::Ledger(const dictionary& couplingProperties, const Time& time)
    : time_(time),
      tolerances_(couplingProperties.subOrEmptyDict("ledger")),
      solidVolumeTolerance_(tolerance(tolerances_, "solidVolumeTolerance", 1e-9)),
      clippedVolumeTolerance_(tolerance(tolerances_, "clippedVolumeTolerance", 1e-3)),
      momentumTolerance_(tolerance(tolerances_, "momentumTolerance", 1e-9)),
      pressureForceTolerance_(tolerance(tolerances_, "pressureForceTolerance", 1e-9)),
      startTime_(time.timeName())
{
    requireKnownEntries(
        tolerances_, {"solidVolumeTolerance", "clippedVolumeTolerance", "momentumTolerance", "pressureForceTolerance"});
}

void Ledger::countBeads(const BeadsView& beads)
{
    census_.count(beads);
}

void Ledger::bookSolidVolume(double beads, double cells, double clipped, const string& worstCell)
{
    solidVolume_ = beads;
    solidVolumeError_ = beads > 0 ? mag(cells - beads) / beads : mag(cells);
    largestSolidVolumeError_ = max(largestSolidVolumeError_, solidVolumeError_);
    clippedVolume_ = clipped;
    largestClippedVolume_ = max(largestClippedVolume_, clipped);
    if (solidVolumeError_ > solidVolumeTolerance_)
    {
        FatalErrorInFunction << "The cells hold " << cells << " m3 of beads, the beads are " << beads
                             << " m3: relative error " << solidVolumeError_ << ", solidVolumeTolerance is "
                             << solidVolumeTolerance_ << exit(FatalError);
    }
    if (clipped > clippedVolumeTolerance_ * beads)
    {
        FatalErrorInFunction << "The void fraction was clipped at alphaMin: " << clipped << " m3 of " << beads
                             << " m3 of beads cut off, clippedVolumeTolerance is " << clippedVolumeTolerance_
                             << " of the beads. Worst: " << worstCell.c_str()
                             << ". Smooth more (smoothingLength) or lower alphaMin." << exit(FatalError);
    }
}

void Ledger::openMomentum(const vector& outstanding)
{
    outstandingAtStart_ = outstanding;
    outstanding_ = outstanding;
}

void Ledger::bookMomentum(const vector& beadsReceived, const vector& fluidLost, const vector& outstanding)
{
    beadsReceived_ += beadsReceived;
    fluidLost_ += fluidLost;
    outstanding_ = outstanding;
    momentumTurnover_ += mag(beadsReceived);
    if (momentumError() > momentumTolerance_)
    {
        FatalErrorInFunction << "Beads received " << beadsReceived_ << " N s from the fluid, which lost " << fluidLost_
                             << " N s with " << outstanding_ << " N s outstanding: relative error " << momentumError()
                             << ", momentumTolerance is " << momentumTolerance_ << exit(FatalError);
    }
}

void Ledger::bookPressureForce(const vector& onBeads, const vector& inFluid, double turnover)
{
    pressureForceError_ = mag(onBeads - inFluid) / max(turnover, VSMALL);
    largestPressureForceError_ = max(largestPressureForceError_, pressureForceError_);
    if (pressureForceError_ > pressureForceTolerance_)
    {
        FatalErrorInFunction << "The pressure gradient gives the beads " << onBeads << " N, and the fluid's equation "
                             << "holds the reaction to " << inFluid << " N: relative error " << pressureForceError_
                             << ", pressureForceTolerance is " << pressureForceTolerance_ << exit(FatalError);
    }
}

void Ledger::bookContinuity(const volScalarField& error)
{
    localContinuityError_ = mag(error)().weightedAverage(error.mesh().V()).value();
    globalContinuityError_ = error.weightedAverage(error.mesh().V()).value();
    cumulativeContinuityError_ += globalContinuityError_;
}

double Ledger::momentumError() const
{
    return momentumTurnover_ > 0
               ? mag(beadsReceived_ + outstandingAtStart_ - fluidLost_ - outstanding_) / momentumTurnover_
               : 0;
}

void Ledger::report() const
{
    Info << "ledger: time " << time_.timeName() << " s, beads " << census_.now() << " (lost " << census_.lost()
         << "), solid volume " << solidVolume_ << " m3 (error " << solidVolumeError_ << "), clipped " << clippedVolume_
         << " m3, momentum to beads " << beadsReceived_ << " N s, from fluid " << fluidLost_ << ", outstanding "
         << outstanding_ << " (error " << momentumError() << "), pressure force error " << pressureForceError_
         << ", continuity error local " << localContinuityError_ << ", global " << globalContinuityError_
         << ", cumulative " << cumulativeContinuityError_ << endl;
}

void Ledger::writeSummary(const PhaseTimers& timers, double exchangedBytes) const
{
    if (!Pstream::master())
    {
        return;
    }
    const fileName folder = time_.globalPath() / "postProcessing" / "ledger" / startTime_;
    mkDir(folder);
    const nlohmann::ordered_json summary = {{"timeStart", std::stod(startTime_)}, {"timeEnd", time_.value()},
        {"beadsStart", census_.atStart()}, {"beadsEnd", census_.now()}, {"beadsLost", census_.lost()},
        {"solidVolume", solidVolume_}, {"solidVolumeError", largestSolidVolumeError_},
        {"clippedVolume", largestClippedVolume_}, {"momentumError", momentumError()},
        {"pressureForceError", largestPressureForceError_}, {"cumulativeContinuityError", cumulativeContinuityError_},
        {"wallSeconds", time_.elapsedClockTime()}, {"cpuSeconds", time_.elapsedCpuTime()}, {"ranks", Pstream::nProcs()},
        {"phaseSeconds", timers.wallSeconds()}, {"phaseProcessorSeconds", timers.processorSeconds()},
        {"exchangedBytes", exchangedBytes}};
    writeWhole((folder / "summary.json").c_str(), summary.dump(2) + '\n');
}

} // namespace clepsydra
