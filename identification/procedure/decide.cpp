#include "procedure/decide.h"

#include <algorithm>
#include <iterator>

namespace clepsydra::identification
{

Verdict decide(const std::vector<Explanation>& explanations, double otherLogOdds, bool others, double setWidth)
{
    Verdict verdict;
    const Explanation& best = explanations.front();
    if (best.misfit > best.misfitLimit || otherLogOdds > best.logOdds)
    {
        verdict.bestOfUnknown = best;
        return verdict;
    }
    std::copy_if(
        explanations.begin(), explanations.end(), std::back_inserter(verdict.set), [&](const Explanation& explanation) {
            return explanation.logOdds > best.logOdds - setWidth && explanation.misfit <= explanation.misfitLimit;
        });
    verdict.decision = verdict.set.size() == 1 && !others ? Decision::named : Decision::set;
    return verdict;
}

} // namespace clepsydra::identification
