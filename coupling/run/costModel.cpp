#include "run/costModel.h"

#include <algorithm>
#include <utility>

namespace clepsydra
{

namespace
{

/// Without particles, steps still take some time.
double atLeastOne(double particles)
{
    return std::max(particles, 1.0);
}

} // namespace

CostModel::CostModel(std::map<std::string, double> seconds)
    : before_(std::move(seconds))
{}

void CostModel::add(double particles, double demSteps)
{
    ++couplingSteps_;
    particleCouplingSteps_ += atLeastOne(particles);
    particleSteps_ += atLeastOne(particles) * demSteps;
}

double CostModel::secondsLeft(
    const std::map<std::string, double>& seconds, double particles, double demSteps, double couplingSteps) const
{
    double left = 0;
    for (const auto& [phase, total] : seconds)
    {
        if (phase == "other")
        {
            continue;
        }
        const auto earlier = before_.find(phase);
        const double taken = total - (earlier == before_.end() ? 0 : earlier->second);
        if (phase == "DEM" || phase == "forces")
        {
            left += taken / particleSteps_ * atLeastOne(particles) * demSteps;
        }
        else if (phase == "locate" || phase == "exchange")
        {
            left += taken / particleCouplingSteps_ * atLeastOne(particles) * couplingSteps;
        }
        else
        {
            left += taken / couplingSteps_ * couplingSteps;
        }
    }
    return left;
}

} // namespace clepsydra
