#pragma once

#include "report/findings.h"

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// What was found, in one sentence for people who know nothing of the procedure.
std::string sentenceOf(const Findings& findings);

/// How sure that is, how well it predicts, and whether it may enter the model, in sentences.
std::vector<std::string> detailsOf(const Findings& findings);

/// What to measure next, and what it would tell, in sentences.
std::vector<std::string> nextOf(const Findings& findings);

/// The effect, or the family, that was named.
std::string namedBy(const Study& study, const Answer& answer);

/// What the report takes for granted, in sentences.
std::vector<std::string> assumptionsOf(const Findings& findings);

} // namespace clepsydra::identification
