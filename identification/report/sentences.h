#pragma once

#include "report/findings.h"

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// The answer in one sentence, for readers who do not know the procedure.
std::string sentenceOf(const Findings& findings);

/// Sentences on which condition decided, what the parameters alone could do, what would refute the answer, how certain it
/// is, how well it predicts, and whether the effect may enter the model.
std::vector<std::string> detailsOf(const Findings& findings);

/// Sentences on what to measure next, and which result is expected.
std::vector<std::string> nextOf(const Findings& findings);

/// How far a name is supported:
///     named      it is the only effect tried that fits
///     better     it also predicts held-out conditions better than no effect, one more parameter and a Gaussian process
///     measured   its amplitude was measured independently besides, and agrees
/// Empty if nothing is named.
std::string gradeOf(const Findings& findings);

/// Name of the effect or family that was found.
std::string namedBy(const Study& study, const Answer& answer);

/// The failed runs, by purpose and condition, and why the first of each failed.
std::vector<std::string> failedRunsOf(const Study& study, const Effort& effort);

/// Sentences on the assumptions behind the answer.
std::vector<std::string> assumptionsOf(const Findings& findings);

} // namespace clepsydra::identification
