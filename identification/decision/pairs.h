#pragma once

#include "decision/calibration.h"

#include <random>
#include <vector>

namespace clepsydra::identification
{

/// Two effects at once.
struct PairFinding
{
    std::vector<std::size_t> effects;
    std::vector<Fit> fits; // by effect
    double logPrior = 0.0;
    double logOdds = 0.0;     // against no effect, prior weight included
    double probability = 0.0; // among pairs and something that is not in the library
    bool inSet = false;
    bool fitsWell = false; // as well as its own trials do
};

/// Whether both set an entry of the case such that nothing is left of one: no run has these two on.
bool undoEachOther(const Effect& one, const Effect& other);

/// Pairs of effects, for data that no single effect explains: all pairs together weigh as much as one effect. The likeliest
/// come first, down to those that are hopeless.
std::vector<PairFinding> leadingPairs(const Study& study, Evidence& evidence, const Measured& measured);

/// Which of these pairs belong to the set, by trials in known worlds with each of them in: such as fit as well as their own
/// trials do, and are as likely as most of them. \return the probability of something that is not in the library, beside them
double judgePairs(std::vector<PairFinding>& pairs, const Study& study, const Evidence& evidence, Replicas& replicas,
    const Measured& measured, std::mt19937_64& random);

/// Whether the effects of two pairs are the same or variants of each other.
bool areVariants(const Study& study, const PairFinding& one, const PairFinding& other);

/// "effect with family": what all pairs of a set that may be named have in common.
std::string sharedName(const Study& study, const std::vector<PairFinding>& pairs);

/// Whether pairs, once judged, leave one name: they are the only one or variants of the likeliest one, which fits well, and they
/// leave no room for anything else. How often something that is not in the library passes for a pair is not learnt from decoys.
bool mayBeNamed(const Study& study, const std::vector<PairFinding>& pairs);

} // namespace clepsydra::identification
