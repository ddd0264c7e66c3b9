#pragma once

#include "decision/calibration.h"

#include <random>
#include <vector>

namespace clepsydra::identification
{

/// Two effects that act together.
struct PairFinding
{
    std::vector<std::size_t> effects;
    std::vector<Fit> fits; // by effect
    double logPrior = 0.0;
    double logOdds = 0.0;     // against no effect, including the prior weight
    double probability = 0.0; // among the pairs and an unlisted cause
    bool inSet = false;
    bool fitsWell = false; // whether it fits as well as its own synthetic data
};

/// Whether both effects set the same entry in such a way that one of them is lost. Such pairs are not simulated.
bool undoEachOther(const Effect& one, const Effect& other);

/// The most likely pairs of effects, for data that no single effect explains, most likely first. Pairs with negligible
/// odds are left out. All pairs together have the prior weight of one effect.
std::vector<PairFinding> leadingPairs(const Study& study, Evidence& evidence, const Measured& measured);

/// Decides which of the pairs belong to the set: those that fit as well, and are as probable, as they are for synthetic
/// data that contain them. \return the probability of an unlisted cause beside the pairs
double judgePairs(std::vector<PairFinding>& pairs, const Study& study, const Evidence& evidence, Replicas& replicas,
    const Measured& measured, std::mt19937_64& random);

/// Common name of all pairs in the set: the effects that they share and, for the others, the name of the family.
std::string sharedName(const Study& study, const std::vector<PairFinding>& pairs);

/// Whether judged pairs may be named: all pairs in the set are variants of the most likely one, which fits well, and
/// the other causes have a negligible probability. This is strict, because no decoys tell how often an unlisted cause
/// looks like a pair.
bool mayBeNamed(const Study& study, const std::vector<PairFinding>& pairs);

} // namespace clepsydra::identification
