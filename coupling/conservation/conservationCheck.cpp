#include "conservation/conservationCheck.h"

#include "files/wholeFile.h"

#include "IOmanip.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "runTimeSelection.h"
#include "tokens/jsonText.h"

namespace clepsydra
{

namespace
{

double tolerance(const dictionary& dict, const word& entry, double byDefault)
{
    return dict.found(entry) ? positiveEntry(dict, entry) : byDefault;
}

} // namespace

ConservationCheck::ConservationCheck(const dictionary& couplingProperties, const Time& time)
    : time_(time),
      tolerances_(couplingProperties.subOrEmptyDict("conservationCheck")),
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

int ConservationCheck::countParticles(const ParticlesView& particles)
{
    return census_.count(particles);
}

void ConservationCheck::countAfterRemoval(const ParticlesView& particles, label removed)
{
    census_.countAfterRemoval(particles, removed);
}

void ConservationCheck::recordSolidVolume(double particles, double cells, double clipped, const string& worstCell)
{
    solidVolume_ = particles;
    solidVolumeError_ = particles > 0 ? mag(cells - particles) / particles : mag(cells);
    largestSolidVolumeError_ = max(largestSolidVolumeError_, solidVolumeError_);
    clippedVolume_ = clipped;
    largestClippedVolume_ = max(largestClippedVolume_, clipped);
    if (solidVolumeError_ > solidVolumeTolerance_)
    {
        FatalErrorInFunction << "The cells hold " << cells << " m3 of particles, the particles are " << particles
                             << " m3: relative error " << solidVolumeError_ << ", solidVolumeTolerance is "
                             << solidVolumeTolerance_ << exit(FatalError);
    }
    mostSolidVolume_ = max(mostSolidVolume_, cells);
    insertionError_ = mag(solidVolumeAtStart_ + netInsertedVolume_ - cells) / max(mostSolidVolume_, VSMALL);
    largestInsertionError_ = max(largestInsertionError_, insertionError_);
    if (insertionError_ > solidVolumeTolerance_)
    {
        FatalErrorInFunction << "The cells hold " << cells << " m3 of particles; at the start these had "
                             << solidVolumeAtStart_ << " m3, and " << netInsertedVolume_
                             << " m3 more have come in than left: relative error " << insertionError_
                             << ", solidVolumeTolerance is " << solidVolumeTolerance_ << exit(FatalError);
    }
    if (clipped > clippedVolumeTolerance_ * particles)
    {
        FatalErrorInFunction << "The void fraction was clipped at alphaMin: " << clipped << " m3 of " << particles
                             << " m3 of particles cut off, clippedVolumeTolerance is " << clippedVolumeTolerance_
                             << " of the particles. Worst: " << worstCell.c_str()
                             << ". Smooth more (bandwidth of constDiffSmoothingProps) or lower alphaMin." << exit(FatalError);
    }
}

void ConservationCheck::openMomentum(const vector& semiImplicitMomentum)
{
    semiImplicitMomentumAtStart_ = semiImplicitMomentum;
    semiImplicitMomentum_ = semiImplicitMomentum;
}

void ConservationCheck::recordMomentum(
    const ReceivedMomentum& received, const vector& fluidLost, const vector& semiImplicitMomentum)
{
    particlesReceived_ += received.sum;
    fluidLost_ += fluidLost;
    semiImplicitMomentum_ = semiImplicitMomentum;
    momentumMagnitudes_ += received.sumOfMagnitudes;
    if (momentumError() > momentumTolerance_)
    {
        FatalErrorInFunction << "Particles received " << particlesReceived_ << " N s from the fluid, which lost "
                             << fluidLost_ << " N s, " << semiImplicitMomentum_
                             << " N s of it in advance: relative error " << momentumError() << ", momentumTolerance is "
                             << momentumTolerance_ << exit(FatalError);
    }
}

void ConservationCheck::recordPressureForce(const vector& onParticles, const vector& inFluid, double sumOfMagnitudes)
{
    pressureForceError_ = mag(onParticles - inFluid) / max(sumOfMagnitudes, VSMALL);
    largestPressureForceError_ = max(largestPressureForceError_, pressureForceError_);
    if (pressureForceError_ > pressureForceTolerance_)
    {
        FatalErrorInFunction << "The pressure gradient gives the particles " << onParticles
                             << " N, and the fluid's equation "
                             << "holds the reaction to " << inFluid << " N: relative error " << pressureForceError_
                             << ", pressureForceTolerance is " << pressureForceTolerance_ << exit(FatalError);
    }
}

void ConservationCheck::recordContinuity(const volScalarField& error)
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

void ConservationCheck::recordImbalance(double imbalance)
{
    imbalance_ += imbalance;
    if (mag(imbalance_) > imbalanceTolerance_)
    {
        FatalErrorInFunction << "The particles' volume in a tank that no fluid can leave or enter changed by "
                             << imbalance_ << " of the tank's, imbalanceTolerance is " << imbalanceTolerance_
                             << ". Give p a fixed value on a patch that fluid can pass." << exit(FatalError);
    }
}

double ConservationCheck::momentumError() const
{
    return momentumMagnitudes_ > 0
               ? mag(particlesReceived_ + semiImplicitMomentum_ - semiImplicitMomentumAtStart_ - fluidLost_)
                     / momentumMagnitudes_
               : 0;
}

void ConservationCheck::report() const
{
    Info << "conservation check: time " << time_.timeName() << " s, particles " << census_.now() << " (inserted "
         << census_.inserted() << ", left " << census_.removed() << ", lost " << census_.lost() << "), solid volume "
         << solidVolume_ << " m3 (error " << solidVolumeError_ << "), clipped " << clippedVolume_
         << " m3, momentum to particles " << particlesReceived_ << " N s, from fluid " << fluidLost_ << ", in advance "
         << semiImplicitMomentum_ << " (error " << momentumError() << "), pressure force error " << pressureForceError_
         << ", continuity error local " << localContinuityError_ << ", global " << globalContinuityError_
         << ", cumulative " << cumulativeContinuityError_ << ", spread over the closed tank " << imbalance_ << endl;
}

void ConservationCheck::writeSummary(
    const PhaseTimers& timers, double exchangedBytes, const std::optional<EstimatedSeconds>& estimate) const
{
    if (!Pstream::master())
    {
        return;
    }
    const fileName folder = time_.globalPath() / "postProcessing" / "conservation" / startTime_;
    mkDir(folder);
    JsonObject summary;
    summary.add("timeStart", std::stod(startTime_));
    summary.add("timeEnd", time_.value());
    summary.add("particlesStart", census_.atStart());
    summary.add("particlesEnd", census_.now());
    summary.add("particlesLost", census_.lost());
    summary.add("particlesInserted", census_.inserted());
    summary.add("particlesLeft", census_.removed());
    summary.add("insertionError", largestInsertionError_);
    summary.add("solidVolume", solidVolume_);
    summary.add("solidVolumeError", largestSolidVolumeError_);
    summary.add("clippedVolume", largestClippedVolume_);
    summary.add("momentumError", momentumError());
    summary.add("pressureForceError", largestPressureForceError_);
    summary.add("continuityError", largestContinuityError_);
    summary.add("cumulativeContinuityError", cumulativeContinuityError_);
    summary.add("imbalance", imbalance_);
    summary.add("wallSeconds", time_.elapsedClockTime());
    summary.add("cpuSeconds", time_.elapsedCpuTime());
    summary.add("ranks", Pstream::nProcs());
    summary.add("phaseSeconds", timers.wallSeconds());
    summary.add("phaseProcessorSeconds", timers.processorSeconds());
    summary.add("exchangedBytes", exchangedBytes);
    if (estimate)
    {
        summary.add("estimatedSeconds", estimate->wall);
        summary.add("estimatedProcessorSeconds", estimate->processor);
    }
    writeWhole((folder / "summary.json").c_str(), summary.text() + '\n');
}

} // namespace clepsydra
