#include "couplingStep/couplingStepLength.h"

#include "openfoam/objectFile.h"

#include "OSspecific.H"
#include "PstreamReduceOps.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Rounding error of a quotient of times that is a whole number.
constexpr double rounding = 1e-6;

/// The coupling step may grow by a part of 1/partsToGrowBy from one step to the next.
constexpr int partsToGrowBy = 5;

const word stepsEntry = "steps";

int wholeStepsIn(double time, double demTimeStep)
{
    return static_cast<int>(
        std::min(std::floor(time / demTimeStep * (1 + rounding)), double(std::numeric_limits<int>::max())));
}

} // namespace

CouplingStepLength::CouplingStepLength(
    const CouplingSettings& settings, const Time& time, double demTimeStep, bool resumed)
    : settings_(settings),
      time_(time),
      demTimeStep_(demTimeStep),
      steps_(settings.demStepsPerCouplingStep(demTimeStep))
{
    if (!isAdjustable())
    {
        return;
    }
    checkTimes();
    fewestSteps_ =
        static_cast<int>(std::ceil(settings_.adjustableCouplingTimeStep()->shortest / demTimeStep_ * (1 - rounding)));
    mostSteps_ = wholeStepsIn(settings_.adjustableCouplingTimeStep()->longest, demTimeStep_);

    IOobject file("couplingTimeStep", time.timeName(), "uniform", time, IOobject::NO_READ, IOobject::AUTO_WRITE);
    if (resumed && hasFile<IOdictionary>(file))
    {
        file.readOpt() = IOobject::MUST_READ;
    }
    state_.reset(new IOdictionary(file));
    setSteps(state_->getOrDefault<label>(stepsEntry, steps_));
}

void CouplingStepLength::checkTimes() const
{
    const IOdictionary& coupling = settings_.dict();
    const double shortest = settings_.adjustableCouplingTimeStep()->shortest;
    if (shortest < demTimeStep_ * (1 - rounding))
    {
        FatalIOErrorInFunction(coupling) << "Entry 'minCouplingTimeStep' is " << shortest
                                         << " s; allowed: at least the DEM step, which is " << demTimeStep_ << " s"
                                         << exit(FatalIOError);
    }
    const dictionary& control = time_.controlDict();
    const word writeControl = control.getOrDefault<word>("writeControl", "timeStep");
    if (writeControl == "runTime" || writeControl == "adjustableRunTime")
    {
        settings_.wholeSteps(control, "writeInterval", control.get<scalar>("writeInterval"), demTimeStep_);
    }
    const double timeLeft = time_.endTime().value() - time_.value();
    if (time_.stopAt() == Time::saEndTime && timeLeft > 0.5 * demTimeStep_)
    {
        settings_.wholeSteps(control, "endTime", timeLeft, demTimeStep_);
    }
}

void CouplingStepLength::setSteps(int steps)
{
    steps_ = steps;
    state_->set(stepsEntry, label(steps_));
}

void CouplingStepLength::choose(const std::vector<CouplingStepLimit>& limits, double timeLeft)
{
    const auto strictest = std::min_element(limits.begin(), limits.end(),
        [](const CouplingStepLimit& a, const CouplingStepLimit& b) { return a.longest < b.longest; });
    const int allowed = wholeStepsIn(strictest->longest, demTimeStep_);
    if (allowed < fewestSteps_ && !warned_)
    {
        warned_ = true;
        WarningInFunction << "The " << strictest->reason.c_str() << " asks for a coupling step of "
                          << strictest->longest << " s, but minCouplingTimeStep is "
                          << settings_.adjustableCouplingTimeStep()->shortest << " s. This warning is printed once"
                          << endl;
    }
    const int fastestGrowth = steps_ + std::max(1, steps_ / partsToGrowBy);
    setSteps(std::min(std::clamp(allowed, fewestSteps_, mostSteps_), fastestGrowth));
    divideTimeLeft(timeLeft);
}

void CouplingStepLength::fitInto(double timeLeft)
{
    const double left = std::round(timeLeft / demTimeStep_);
    if (isAdjustable() && steps_ != left && 2.0 * steps_ > left)
    {
        divideTimeLeft(timeLeft);
    }
}

void CouplingStepLength::divideTimeLeft(double timeLeft)
{
    const double left = std::round(timeLeft / demTimeStep_);
    const double stepCount = std::ceil(left / steps_);
    if (left > std::numeric_limits<int>::max())
    {
        return;
    }
    // The last coupling step but one is not longer than the last, because OpenFOAM treats a time that is closer than
    // half a time step as reached.
    const double share = left / stepCount;
    setSteps(std::max(1, static_cast<int>(stepCount == 2 ? std::floor(share) : std::ceil(share))));
}

} // namespace clepsydra
