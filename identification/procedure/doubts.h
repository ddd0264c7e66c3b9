#pragma once

#include "procedure/answer.h"
#include "procedure/traceInputs.h"

#include <random>

namespace clepsydra::identification
{

/// Repeats of data and simulation whose spreads differ by as much as in fewer cases than this scatter differently.
constexpr double otherSpread = 0.01;

/// A pattern of another shape than an explanation must be noticed from this size on, as a share (root of squares) of what
/// the explanation takes off the residual, or the shape has not been tested.
constexpr double otherShape = 0.7;

/// Why something that is not in the library may be behind the best explanation as well, each reason a clause for people;
/// empty where it is ruled out.
///
/// - It is as likely, within the study's `setWidth`.
/// - The residual is too small for its shape to be tested: whatever looks roughly like this explanation would bear its
///   name.
/// - Repeats of the measurement scatter in a way of their own, and runs with the explanation switched on do not.
///
/// \param answer  with noise, spread, test, and the odds of something else
/// \param nullMisfit  what the null fit leaves
/// \param measured  repeats of the measurements
std::vector<std::string> doubtsAbout(const Explanation& best, const Answer& answer, double nullMisfit,
    const Scatter& measured, const TraceInputs& inputs, std::mt19937_64& random);

} // namespace clepsydra::identification
