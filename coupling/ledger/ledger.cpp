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
      continuityTolerance_(tolerance(tolerances_, "continuityTolerance", 1e-4)),
      imbalanceTolerance_(tolerance(tolerances_, "imbalanceTolerance", 1e-3)),
      startTime_(time.timeName())
{
    requireKnownEntries(tolerances_, {"solidVolumeTolerance", "clippedVolumeTolerance", "momentumTolerance",
                                         "pressureForceTolerance", "continuityTolerance", "imbalanceTolerance"});
}

int Ledger::countBeads(const BeadsView& beads)
{
    return census_.count(beads);
}

void Ledger::countAfterRemoval(const BeadsView& beads, label removed)
{
    census_.countAfterRemoval(beads, removed);
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
    mostSolidVolume_ = max(mostSolidVolume_, cells);
    trafficError_ = mag(solidVolumeAtStart_ + trafficVolume_ - cells) / max(mostSolidVolume_, VSMALL);
    largestTrafficError_ = max(largestTrafficError_, trafficError_);
    if (trafficError_ > solidVolumeTolerance_)
    {
        FatalErrorInFunction << "The cells hold " << cells << " m3 of beads; at the start these had "
                             << solidVolumeAtStart_ << " m3, and " << trafficVolume_
                             << " m3 more have come in than left: relative error " << trafficError_
                             << ", solidVolumeTolerance is " << solidVolumeTolerance_ << exit(FatalError);
    }
    if (clipped > clippedVolumeTolerance_ * beads)
    {
        FatalErrorInFunction << "The void fraction was clipped at alphaMin: " << clipped << " m3 of " << beads
                             << " m3 of beads cut off, clippedVolumeTolerance is " << clippedVolumeTolerance_
                             << " of the beads. Worst: " << worstCell.c_str()
                             << ". Smooth more (smoothingLength) or lower alphaMin." << exit(FatalError);
    }
}

void Ledger::openMomentum(const vector& givenInAdvance)
{
    givenInAdvanceAtStart_ = givenInAdvance;
    givenInAdvance_ = givenInAdvance;
}

void Ledger::bookMomentum(const ReceivedMomentum& received, const vector& fluidLost, const vector& givenInAdvance)
{
    beadsReceived_ += received.sum;
    fluidLost_ += fluidLost;
    givenInAdvance_ = givenInAdvance;
    momentumTurnover_ += received.turnover;
    if (momentumError() > momentumTolerance_)
    {
        FatalErrorInFunction << "Beads received " << beadsReceived_ << " N s from the fluid, which lost " << fluidLost_
                             << " N s, " << givenInAdvance_ << " N s of it in advance: relative error "
                             << momentumError() << ", momentumTolerance is " << momentumTolerance_ << exit(FatalError);
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
    largestContinuityError_ = max(largestContinuityError_, localContinuityError_);
    if (localContinuityError_ > continuityTolerance_)
    {
        FatalErrorInFunction << "Fluid of " << localContinuityError_
                             << " of the volume was made of nothing or lost in one "
                             << "interval (mean of |d(eps)/dt + div(eps U)|), continuityTolerance is "
                             << continuityTolerance_ << ". Solve p to a smaller tolerance (system/fvSolution), or "
                             << "couple more often." << exit(FatalError);
    }
}

void Ledger::bookImbalance(double imbalance)
{
    imbalance_ += imbalance;
    if (mag(imbalance_) > imbalanceTolerance_)
    {
        FatalErrorInFunction << "The beads' volume in a tank that no fluid can leave or enter changed by " << imbalance_
                             << " of the tank's, imbalanceTolerance is " << imbalanceTolerance_
                             << ". Give p a fixed value on a patch that fluid can pass." << exit(FatalError);
    }
}

double Ledger::momentumError() const
{
    return momentumTurnover_ > 0
               ? mag(beadsReceived_ + givenInAdvance_ - givenInAdvanceAtStart_ - fluidLost_) / momentumTurnover_
               : 0;
}

void Ledger::report() const
{
    Info << "ledger: time " << time_.timeName() << " s, beads " << census_.now() << " (inserted " << census_.inserted()
         << ", left " << census_.removed() << ", lost " << census_.lost() << "), solid volume " << solidVolume_
         << " m3 (error " << solidVolumeError_ << "), clipped " << clippedVolume_ << " m3, momentum to beads "
         << beadsReceived_ << " N s, from fluid " << fluidLost_ << ", in advance " << givenInAdvance_ << " (error "
         << momentumError() << "), pressure force error " << pressureForceError_ << ", continuity error local "
         << localContinuityError_ << ", global " << globalContinuityError_ << ", cumulative "
         << cumulativeContinuityError_ << ", spread over the closed tank " << imbalance_ << endl;
}

void Ledger::writeSummary(
    const PhaseTimers& timers, double exchangedBytes, const std::optional<EstimatedSeconds>& estimate) const
{
    if (!Pstream::master())
    {
        return;
    }
    const fileName folder = time_.globalPath() / "postProcessing" / "ledger" / startTime_;
    mkDir(folder);
    nlohmann::ordered_json summary = {{"timeStart", std::stod(startTime_)}, {"timeEnd", time_.value()},
        {"beadsStart", census_.atStart()}, {"beadsEnd", census_.now()}, {"beadsLost", census_.lost()},
        {"beadsInserted", census_.inserted()}, {"beadsLeft", census_.removed()}, {"trafficError", largestTrafficError_},
        {"solidVolume", solidVolume_}, {"solidVolumeError", largestSolidVolumeError_},
        {"clippedVolume", largestClippedVolume_}, {"momentumError", momentumError()},
        {"pressureForceError", largestPressureForceError_}, {"continuityError", largestContinuityError_},
        {"cumulativeContinuityError", cumulativeContinuityError_}, {"imbalance", imbalance_},
        {"wallSeconds", time_.elapsedClockTime()}, {"cpuSeconds", time_.elapsedCpuTime()}, {"ranks", Pstream::nProcs()},
        {"phaseSeconds", timers.wallSeconds()}, {"phaseProcessorSeconds", timers.processorSeconds()},
        {"exchangedBytes", exchangedBytes}};
    if (estimate)
    {
        summary["estimatedSeconds"] = estimate->wall;
        summary["estimatedProcessorSeconds"] = estimate->processor;
    }
    writeWhole((folder / "summary.json").c_str(), summary.dump(2) + '\n');
}

} // namespace clepsydra
