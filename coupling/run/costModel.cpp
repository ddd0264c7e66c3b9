#include "run/costModel.h"

#include <algorithm>
#include <utility>

namespace clepsydra
{

namespace
{

/// Where there are no beads yet, steps take their time all the same.
double atLeastOne(double beads)
{
    return std::max(beads, 1.0);
}

} // namespace

CostModel::CostModel(std::map<std::string, double> seconds)
    : before_(std::move(seconds))
{}

void CostModel::add(double beads, double demSteps)
{
    ++intervals_;
    beadIntervals_ += atLeastOne(beads);
    beadSteps_ += atLeastOne(beads) * demSteps;
}

double CostModel::secondsLeft(
    const std::map<std::string, double>& seconds, double beads, double demSteps, double intervals) const
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
            left += taken / beadSteps_ * atLeastOne(beads) * demSteps;
        }
        else if (phase == "locate" || phase == "exchange")
        {
            left += taken / beadIntervals_ * atLeastOne(beads) * intervals;
        }
        else
        {
            left += taken / intervals_ * intervals;
        }
    }
    return left;
}

} // namespace clepsydra
