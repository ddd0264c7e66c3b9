#pragma once

#include "decision/calibration.h"
#include "emulator/library.h"
#include "tokens/didYouMean.h"

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clepsydra::identification
{

enum class Decision
{
    noResidual, // no residual beyond noise
    named,      // one effect, or one family of variants, explains the residual
    set,        // several effects explain the residual, and the data cannot distinguish them
    unknown     // no effect of the library explains the residual
};

inline std::string nameOf(Decision decision)
{
    constexpr std::array names = {"noResidual", "named", "set", "unknown"};
    return names[static_cast<std::size_t>(decision)];
}

/// Result for one effect of the library by itself.
struct EffectFinding
{
    Fit fit;
    Eigen::VectorXd parameters; // fitted physical values
    double logOdds = 0.0;       // against no effect, including the prior weight
    double probability = 0.0;   // given that there is a cause
    double threshold = 0.0;     // smallest probability at which it belongs to the set
    double chiSquare = 0.0;     // at its most likely amplitude
    bool known = true;          // false if all its runs have failed
    bool inSet = false;
    std::string notInSetBecause; // of an effect whose probability is large enough for the set
    std::optional<Fit> alone;    // without the independent measurement of its amplitude, if there is one
};

/// Whether the amplitude that the data give without its independent measurement agrees with this measurement, to within
/// two standard deviations; empty where it was not measured.
inline std::optional<bool> agreesWithMeasurement(const Effect& effect, const EffectFinding& finding)
{
    if (!effect.measured || !finding.alone)
    {
        return std::nullopt;
    }
    return std::abs(finding.alone->amplitude - effect.measured->mean)
           <= 2.0 * std::hypot(finding.alone->sd, effect.measured->sd);
}

/// One explanation: no effect, one or two effects, with the setting that fits best.
struct Explanation
{
    std::vector<std::size_t> effects;
    Setting setting;
    std::vector<Fit> fits;    // by effect
    double logOdds = 0.0;     // against no effect
    double probability = 0.0; // given that there is a cause; for a pair, given that no single effect explains the data
    double chiSquare = 0.0;
    std::vector<Simulation> runs; // runs with these effects, at the fits of all rounds; empty if there are none
};

/// Name of an explanation: "no effect", "effect", or "effect with other effect".
inline std::string nameOf(const Study& study, const std::vector<std::size_t>& effects)
{
    const auto names = mapped(effects, [&](std::size_t e) { return study.effects[e].name; });
    return names.empty() ? "no effect" : listed(names, " with ");
}

/// Result of the training data. Held-out data do not enter it.
struct Answer
{
    Decision decision = Decision::noResidual;
    std::vector<Explanation> set;    // best first
    bool unlistedCauseInSet = false; // whether the set also contains an unlisted cause
    std::string family;              // common family of all members, if there is one
    double pValue = 1.0;
    double logOdds = 0.0;          // of any cause against no effect
    double otherProbability = 0.0; // of an unlisted cause beside the kind of the set's members: single effects or pairs
    double otherThreshold = 0.0;   // smallest probability at which it belongs to the set; NaN beside pairs
    /// Log odds of a set's only member against all other causes, and those that a name needs.
    std::optional<std::pair<double, double>> oddsOfName;
    std::vector<Explanation> rivals;    // beside a set of one member: the next probable effect that nothing excludes
    Explanation null;                   // null fit: no effect
    std::optional<Explanation> nearest; // the single effect of the smallest chi-square, if none explains the residual
    std::vector<EffectFinding> effects; // in the study's sequence
    Calibration calibration;
    Visibility visibility; // effects that these data could have shown
    std::shared_ptr<const Emulator> emulator;
    Layout layout;
    Measured measured;
    std::vector<std::string> remarks; // features and effects that were left out, and why
};

/// The most probable explanation of the set, or the nearest effect where none explains the residual; null if there is
/// neither.
inline const Explanation* bestOf(const Answer& answer)
{
    return !answer.set.empty() ? &answer.set.front() : answer.nearest ? &*answer.nearest : nullptr;
}

/// Share of the chi-square without an effect that an explanation takes away.
inline double shareTaken(const Answer& answer, const Explanation& explanation)
{
    return 1.0 - explanation.chiSquare / answer.null.chiSquare;
}

} // namespace clepsydra::identification
