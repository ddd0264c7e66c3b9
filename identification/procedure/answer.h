#pragma once

#include "inference/evidence.h"
#include "inference/significance.h"
#include "noise/spread.h"
#include "runner/simulator.h"

#include <optional>
#include <string>
#include <vector>

namespace clepsydra::identification
{

enum class Decision
{
    noResidual, // nothing beyond noise
    named,      // one effect is left
    set,        // several that the data cannot tell apart
    unknown     // a residual that the library does not explain
};

std::string nameOf(Decision decision);

/// What was found about one effect of the library.
struct EffectFinding
{
    Score linear;                   // from the library's columns
    Eigen::VectorXd parameters;     // physical values that go with it
    std::optional<Score> confirmed; // from simulations with the effect switched on
    double logOdds = 0.0;           // log evidence + log prior weight, of the best score there is
    double misfitLimit = 0.0;       // 99 % of the cases that it explains lie below
    bool inSet = false;

    const Score& score() const
    {
        return confirmed ? *confirmed : linear;
    }
};

/// One explanation: no effect, one or two, with the setting that predicts with it.
struct Explanation
{
    std::vector<std::size_t> effects;
    Setting setting;
    double logOdds = 0.0;
    double misfit = 0.0;
    double misfitLimit = 0.0;
    bool confirmed = false;
    std::vector<Simulation> simulations; // the last ones with it switched on; empty: it was not simulated
};

/// "effect" or "effect with other effect"
std::string nameOf(const Study& study, const Explanation& explanation);

/// All that the training data say. Held-out data have no part in it.
struct Answer
{
    Decision decision = Decision::noResidual;
    std::vector<Explanation> set; // best first; more than one is never given as a name
    std::vector<std::string>
        somethingElseBecause; // why something outside the library belongs to the set; empty: it does not
    std::optional<Explanation> bestOfUnknown; // the most likely one where none is enough; no part of the answer
    Explanation null;                         // refitted parameters, no effect
    double otherLogOdds = 0.0;
    std::vector<EffectFinding> effects;  // as in the study
    std::vector<Explanation> pairs;      // those simulated
    std::vector<Explanation> pairsAlike; // not simulated; by the effects' columns as likely as the best one, a pair

    Noise noise;
    Spread spread;
    Significance significance;
    ResidualProblem problem;          // at the null fit
    Eigen::VectorXd parameterSd;      // of the refitted parameters, in prior sd
    std::vector<Simulation> atFit;    // the null's simulations on the training conditions
    std::vector<std::string> remarks; // what had to be left out or could not be done
};

} // namespace clepsydra::identification
