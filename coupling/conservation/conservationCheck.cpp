#include "conservation/conservationCheck.h"

#include "files/wholeFile.h"

#include "IOmanip.H"
#include "OSspecific.H"
#include "Pstream.H"
#include "ranks.h"
#include "runTimeSelection.h"
#include "tokens/jsonText.h"

#include <cmath>
#include <limits>

namespace clepsydra
{

namespace
{

double tolerance(const dictionary& dict, const word& entry, double byDefault)
{
    return dict.found(entry) ? positiveEntry(dict, entry) : byDefault;
}

// OpenFOAM traps comparisons of what is not a number, and its error would not say which quantity it is.

/// False also for an error that is not a number.
bool isWithin(double error, double tolerance)
{
    return !std::isnan(error) && error <= tolerance;
}

double larger(double largest, double error)
{
    return std::isnan(error) ? error : max(largest, error);
}

double relativeError(double error, double quantity)
{
    return std::isnan(error) || std::isnan(quantity) ? error + quantity : error / max(quantity, VSMALL);
}

} // namespace

const std::array<double HeatOfStep::*, 10> HeatOfStep::members = {&HeatOfStep::received, &HeatOfStep::fluidLost,
    &HeatOfStep::pendingBefore, &HeatOfStep::pending, &HeatOfStep::magnitudes, &HeatOfStep::inParticles,
    &HeatOfStep::inFluidBefore, &HeatOfStep::inFluid, &HeatOfStep::throughBoundary, &HeatOfStep::ofContinuityError};

ConservationCheck::ConservationCheck(const dictionary& couplingProperties, const Time& time)
    : time_(time),
      tolerances_(couplingProperties.subOrEmptyDict("conservationCheck")),
      solidVolumeTolerance_(tolerance(tolerances_, "solidVolumeTolerance", 1e-9)),
      clippedVolumeTolerance_(tolerance(tolerances_, "clippedVolumeTolerance", 1e-3)),
      momentumTolerance_(tolerance(tolerances_, "momentumTolerance", 1e-9)),
      pressureForceTolerance_(tolerance(tolerances_, "pressureForceTolerance", 1e-9)),
      continuityTolerance_(tolerance(tolerances_, "continuityTolerance", 1e-4)),
      filteredVolumeTolerance_(tolerance(tolerances_, "filteredVolumeTolerance", 1)),
      imbalanceTolerance_(tolerance(tolerances_, "imbalanceTolerance", 1e-3)),
      heatTolerance_(tolerance(tolerances_, "heatTolerance", 1e-9)),
      startTime_(time.timeName())
{
    requireKnownEntries(
        tolerances_, {"solidVolumeTolerance", "clippedVolumeTolerance", "momentumTolerance", "pressureForceTolerance",
                         "continuityTolerance", "filteredVolumeTolerance", "imbalanceTolerance", "heatTolerance"});
    if (tolerances_.found("heatTolerance") && !couplingProperties.found("energy"))
    {
        FatalIOErrorInFunction(tolerances_) << "Entry 'heatTolerance' has no effect without the dictionary 'energy' in "
                                            << "couplingProperties; allowed: together with it" << exit(FatalIOError);
    }
}

int ConservationCheck::countParticles(const ParticlesView& particles, RankTotals& totals)
{
    return census_.count(particles, totals);
}

int ConservationCheck::countParticles(const ParticlesView& particles)
{
    return census_.count(particles);
}

void ConservationCheck::countAfterRemoval(const ParticlesView& particles, label removed)
{
    census_.countAfterRemoval(particles, removed);
}

void ConservationCheck::recordSolidVolume(double particles, double cells, const ClippedVolume& clipped)
{
    solidVolume_ = particles;
    solidVolumeError_ = relativeError(mag(cells - particles), particles);
    largestSolidVolumeError_ = larger(largestSolidVolumeError_, solidVolumeError_);
    clippedVolume_ = clipped.sum;
    largestClippedVolume_ = larger(largestClippedVolume_, clipped.sum);
    largestClippedPart_ = larger(largestClippedPart_, clipped.largestPart);
    if (!isWithin(solidVolumeError_, solidVolumeTolerance_))
    {
        FatalErrorInFunction << "The cells hold " << cells << " m3 of particles, but the particles have a volume of "
                             << particles << " m3: the relative error is " << solidVolumeError_
                             << "; allowed: at most solidVolumeTolerance, which is " << solidVolumeTolerance_
                             << exit(FatalError);
    }
    mostSolidVolume_ = max(mostSolidVolume_, cells);
    insertionError_ = relativeError(mag(solidVolumeAtStart_ + netInsertedVolume_ - cells), mostSolidVolume_);
    largestInsertionError_ = larger(largestInsertionError_, insertionError_);
    if (!isWithin(insertionError_, solidVolumeTolerance_))
    {
        FatalErrorInFunction << "The cells hold " << cells << " m3 of particles. At the start they held "
                             << solidVolumeAtStart_ << " m3, and " << netInsertedVolume_
                             << " m3 more have been inserted than have left: the relative error is " << insertionError_
                             << "; allowed: at most solidVolumeTolerance, which is " << solidVolumeTolerance_
                             << exit(FatalError);
    }
    if (!isWithin(clipped.largestPart, clippedVolumeTolerance_))
    {
        FatalErrorInFunction << "The void fraction was clipped at alphaMin: in one cell a part of "
                             << clipped.largestPart << " of the particles' volume was cut off, in all cells "
                             << clipped.sum << " m3 of " << particles << " m3; allowed: at most "
                             << "clippedVolumeTolerance, which is " << clippedVolumeTolerance_
                             << " of the volume in any cell. The worst cell is "
                             << firstOfRanks(clipped.worstCell).c_str()
                             << ". Increase bandwidth in constDiffSmoothingProps, or lower alphaMin"
                             << exit(FatalError);
    }
}

void ConservationCheck::setInitialMomentum(const ExchangedMomentum& semiImplicit)
{
    semiImplicit_ = semiImplicit;
}

void ConservationCheck::recordMomentum(
    const ExchangedMomentum& received, const vector& fluidLost, const ExchangedMomentum& semiImplicit)
{
    particlesReceived_ += received.sum;
    fluidLost_ += fluidLost;
    const vector lost = received.sum + semiImplicit.sum - semiImplicit_.sum - fluidLost;
    const double magnitudes = received.sumOfMagnitudes + semiImplicit.sumOfMagnitudes + semiImplicit_.sumOfMagnitudes;
    momentumError_ = relativeError(mag(lost), magnitudes);
    largestMomentumError_ = larger(largestMomentumError_, momentumError_);
    if (!isWithin(momentumError_, momentumTolerance_))
    {
        FatalErrorInFunction << "In the last coupling step the particles received " << received.sum
                             << " N s from the fluid, and the fluid lost " << fluidLost
                             << " N s. The deferred correction of the drag changed from " << semiImplicit_.sum << " to "
                             << semiImplicit.sum << " N s: the relative error is " << momentumError_
                             << "; allowed: at most momentumTolerance, which is " << momentumTolerance_
                             << exit(FatalError);
    }
    semiImplicit_ = semiImplicit;
}

void ConservationCheck::recordPressureForce(
    const vector& onParticles, const vector& inFluid, double sumOfMagnitudes, bool leftOut)
{
    pressureForceError_ = mag(onParticles - inFluid) / max(sumOfMagnitudes, VSMALL);
    largestPressureForceError_ = max(largestPressureForceError_, pressureForceError_);
    if (!leftOut && !isWithin(pressureForceError_, pressureForceTolerance_))
    {
        FatalErrorInFunction
            << "The pressure gradient exerted a force of " << onParticles
            << " N on the particles in the last coupling step, but the fluid's equation holds the reaction to "
            << inFluid << " N: the relative error is " << pressureForceError_
            << "; allowed: at most pressureForceTolerance, which is " << pressureForceTolerance_ << exit(FatalError);
    }
}

void ConservationCheck::recordHeat(const HeatOfStep& heat)
{
    if (!heat_)
    {
        heat_.emplace();
        heat_->atStart = heat.inFluidBefore + heat.inParticles - heat.received + heat.pendingBefore;
    }
    heat_->last = heat;
    heat_->toParticles += heat.received;
    heat_->throughBoundary += heat.throughBoundary;
    heat_->ofContinuityError += heat.ofContinuityError;
    // Where hardly any heat is exchanged, the temperatures of the particles hold it to their own rounding only.
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * mag(heat.inParticles);
    const double lost = mag(heat.received + heat.pending - heat.pendingBefore - heat.fluidLost);
    heat_->exchangeError = relativeError(std::isnan(lost) ? lost : max(lost - rounding, 0.0), heat.magnitudes);
    heat_->largestExchangeError = larger(heat_->largestExchangeError, heat_->exchangeError);
    if (!isWithin(heat_->exchangeError, heatTolerance_))
    {
        FatalErrorInFunction << "In the last coupling step the particles received " << heat.received
                             << " J from the fluid, and the fluid lost " << heat.fluidLost
                             << " J. The deferred correction of the heat exchange changed from " << heat.pendingBefore
                             << " to " << heat.pending << " J: the relative error is " << heat_->exchangeError
                             << "; allowed: at most heatTolerance, which is " << heatTolerance_ << exit(FatalError);
    }
    const double created =
        heat.inFluid - heat.inFluidBefore + heat.throughBoundary - heat.ofContinuityError + heat.fluidLost;
    const double fluidError = relativeError(mag(created), mag(heat.inFluid));
    heat_->largestFluidError = larger(heat_->largestFluidError, fluidError);
    if (!isWithin(fluidError, heatTolerance_))
    {
        FatalErrorInFunction << "In the last coupling step the solution of the equation of the fluid's temperature "
                             << "created " << created << " J in a fluid that holds " << heat.inFluid
                             << " J: the relative error is " << fluidError
                             << "; allowed: at most heatTolerance, which is " << heatTolerance_
                             << ". Solve T to a smaller tolerance in system/fvSolution" << exit(FatalError);
    }
}

void ConservationCheck::addHeat(const HeatOfStep& ofRank, RankTotals& totals)
{
    totals.add(ofRank.numbers(), [this](const RankNumbers& all) { recordHeat(HeatOfStep::in(all)); });
}

void ConservationCheck::addContinuity(const volScalarField& error, RankTotals& totals)
{
    const scalarField& volumes = error.mesh().V().field();
    if (!meshVolume_)
    {
        meshVolume_ = gSum(volumes);
    }
    const scalarField& inCells = error.primitiveField();
    totals.add({{sum(volumes * mag(inCells)), sum(volumes * inCells)}, {}},
        [this](const RankNumbers& all) { recordContinuity(all.sums[0] / *meshVolume_, all.sums[1] / *meshVolume_); });
}

void ConservationCheck::recordContinuity(double meanMagnitude, double mean)
{
    localContinuityError_ = meanMagnitude;
    globalContinuityError_ = mean;
    cumulativeContinuityError_ += globalContinuityError_;
    largestContinuityError_ = larger(largestContinuityError_, localContinuityError_);
    if (!isWithin(localContinuityError_, continuityTolerance_))
    {
        FatalErrorInFunction
            << "The continuity error of one coupling step is " << localContinuityError_
            << " of the volume (mean of |d(eps)/dt + div(eps U)| times the coupling step); allowed: at "
            << "most continuityTolerance, which is " << continuityTolerance_
            << ". Solve p to a smaller tolerance in system/fvSolution, or use a shorter "
            << "couplingTimeStep" << exit(FatalError);
    }
}

void ConservationCheck::recordFilteredVolume(double volume)
{
    filteredVolume_ = relativeError(volume, mostSolidVolume_);
    largestFilteredVolume_ = larger(largestFilteredVolume_, filteredVolume_);
    if (!isWithin(filteredVolume_, filteredVolumeTolerance_))
    {
        FatalErrorInFunction
            << "The low-pass filter has not yet passed the motion of " << volume << " m3 of particles to the "
            << "fluid's continuity equation, which is " << filteredVolume_
            << " of the particles' largest volume so far; allowed: at most filteredVolumeTolerance, which is "
            << filteredVolumeTolerance_ << ". Decrease smoothingTime in useDDTvoidfractionProps" << exit(FatalError);
    }
}

void ConservationCheck::recordImbalance(double imbalance)
{
    imbalance_ += imbalance;
    if (!isWithin(mag(imbalance_), imbalanceTolerance_))
    {
        FatalErrorInFunction << "The volume of the particles in a tank that no fluid can leave or enter has changed by "
                             << imbalance_ << " of the tank's volume; allowed: at most imbalanceTolerance, which is "
                             << imbalanceTolerance_ << ". Give p a fixed value on a patch that fluid can pass"
                             << exit(FatalError);
    }
}

void ConservationCheck::report() const
{
    Info << "conservation check: time " << time_.timeName() << " s, particles " << census_.now() << " (inserted "
         << census_.inserted() << ", left " << census_.removed() << ", lost " << census_.lost() << ", outside the mesh "
         << outsideMesh_ << "), solid volume " << solidVolume_ << " m3 (error " << solidVolumeError_ << "), clipped "
         << clippedVolume_ << " m3, momentum to particles " << particlesReceived_ << " N s, from fluid " << fluidLost_
         << " N s, of which semi-implicit " << semiImplicit_.sum << " N s (error " << momentumError_
         << "), pressure force error " << pressureForceError_ << ", continuity error local " << localContinuityError_
         << ", global " << globalContinuityError_ << ", cumulative " << cumulativeContinuityError_
         << ", volume whose motion the filter has not passed " << filteredVolume_ << ", imbalance of a closed tank "
         << imbalance_;
    if (heat_)
    {
        Info << ", heat to particles " << heat_->toParticles << " J (error " << heat_->exchangeError
             << "), through the boundary " << heat_->throughBoundary << " J, in particles " << heat_->last.inParticles
             << " J, in the fluid " << heat_->last.inFluid << " J";
    }
    Info << endl;
}

void ConservationCheck::writeSummary(const PhaseTimers& timers, double exchangedBytes,
    const std::optional<EstimatedSeconds>& estimate, const std::optional<double>& reductionsPerStep) const
{
    if (!Pstream::master())
    {
        return;
    }
    const fileName folder = time_.globalPath() / "postProcessing" / "conservation" / startTime_;
    mkDir(folder);
    std::vector<std::pair<std::string, JsonValue>> summary = {{"timeStart", std::stod(startTime_)},
        {"timeEnd", time_.value()}, {"particlesStart", census_.atStart()}, {"particlesEnd", census_.now()},
        {"particlesLost", census_.lost()}, {"particlesInserted", census_.inserted()},
        {"particlesLeft", census_.removed()}, {"particlesOutsideMesh", outsideMesh_},
        {"particlesThatLeftMesh", leftMesh_}, {"insertionError", largestInsertionError_}, {"solidVolume", solidVolume_},
        {"solidVolumeError", largestSolidVolumeError_}, {"clippedVolume", largestClippedVolume_},
        {"clippedPart", largestClippedPart_}, {"momentumError", largestMomentumError_},
        {"pressureForceError", largestPressureForceError_}, {"continuityError", largestContinuityError_},
        {"cumulativeContinuityError", cumulativeContinuityError_}, {"filteredVolume", largestFilteredVolume_},
        {"imbalance", imbalance_}, {"wallSeconds", time_.elapsedClockTime()}, {"cpuSeconds", time_.elapsedCpuTime()},
        {"ranks", Pstream::nProcs()}, {"phaseSeconds", timers.wallSeconds()},
        {"phaseProcessorSeconds", timers.processorSeconds()}, {"exchangedBytes", exchangedBytes}};
    if (heat_)
    {
        summary.insert(summary.end(),
            {{"heatError", heat_->largestExchangeError}, {"heatErrorOfFluid", heat_->largestFluidError},
                {"heatStart", heat_->atStart}, {"heatEnd", heat_->now()}, {"heatToParticles", heat_->toParticles},
                {"heatInParticles", heat_->last.inParticles}, {"heatInFluid", heat_->last.inFluid},
                {"heatThroughBoundary", heat_->throughBoundary}, {"heatOfContinuityError", heat_->ofContinuityError}});
    }
    if (estimate)
    {
        summary.emplace_back("estimatedSeconds", estimate->wall);
        summary.emplace_back("estimatedProcessorSeconds", estimate->processor);
    }
    if (reductionsPerStep)
    {
        summary.emplace_back("reductionsPerStep", *reductionsPerStep);
    }
    writeWhole((folder / "summary.json").c_str(), jsonText(summary) + '\n');
}

} // namespace clepsydra
