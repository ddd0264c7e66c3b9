#pragma once

#include "decision/visibility.h"
#include "emulator/library.h"

#include <memory>
#include <string>
#include <vector>

namespace clepsydra::identification
{

enum class Decision
{
    noResidual, // nothing beyond noise
    named,      // one effect, or one family of variants, is left
    set,        // several that the data cannot distinguish
    unknown     // a residual that the library does not explain
};

std::string nameOf(Decision decision);

/// What was found about one effect of the library, taken by itself.
struct EffectFinding
{
    Fit fit;
    Eigen::VectorXd parameters; // physical values that go with it
    double logOdds = 0.0;       // against no effect, prior weight included
    double probability = 0.0;   // given that there is something
    double threshold = 0.0;     // of the probability, from which it belongs to the set
    bool known = true;          // otherwise its runs have failed, and nothing is said of it
    bool inSet = false;
};

/// One explanation: no effect, one or two, with the setting that predicts with it.
struct Explanation
{
    std::vector<std::size_t> effects;
    Setting setting;
    std::vector<Fit> fits;    // by effect
    double logOdds = 0.0;     // against no effect
    double probability = 0.0; // given that there is something; of two effects: that no single one explains
    double chiSquare = 0.0;
    std::vector<Run> runs; // with it switched on, where its fits were, one after the other; empty: it was not simulated
};

/// "effect" or "effect with other effect", or "no effect"
std::string nameOf(const Study& study, const std::vector<std::size_t>& effects);

/// All that the training data say. Held-out data have no part in it.
struct Answer
{
    Decision decision = Decision::noResidual;
    std::vector<Explanation> set;    // best first
    bool somethingElseInSet = false; // beside them
    std::string family;              // where all members are variants of one thing
    double pValue = 1.0;
    double logOdds = 0.0;          // of anything against no effect
    double otherProbability = 0.0; // beside single effects
    double otherBesideSet = 0.0;   // among what the set's probabilities are among: the same, or beside pairs
    double otherThreshold = 0.0;
    Explanation null;                   // refitted parameters, no effect
    std::vector<EffectFinding> effects; // as in the study
    Calibration calibration;
    Visibility visibility; // what these data could have shown
    std::shared_ptr<const Emulator> emulator;
    Layout layout;
    Measured measured;
    std::vector<std::string> remarks; // what had to be left out or could not be done
};

} // namespace clepsydra::identification
