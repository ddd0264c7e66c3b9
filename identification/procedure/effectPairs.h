#pragma once

#include "procedure/answer.h"
#include "procedure/nullFit.h"

namespace clepsydra::identification
{

/// Two effects at once.
struct EffectPairs
{
    std::vector<Explanation> byColumns; // all, most likely first, as the library's columns show them
    std::vector<Explanation> simulated; // the best of these, switched on in the simulator

    /// Pairs that nobody simulated and that are as likely as this one. The columns, crude for the evidence itself, are
    /// believed for the difference between two pairs: a name for one of many alike would be a set reported as a name.
    std::vector<Explanation> like(const Explanation& pair, double setWidth) const;
};

/// \param singles  most likely first: pairs are simulated where they come close to the best of them
EffectPairs tryPairs(const TraceInputs& inputs, const NullFit& null, const Noise& noise, const Significance& test,
    const std::vector<Explanation>& singles);

} // namespace clepsydra::identification
