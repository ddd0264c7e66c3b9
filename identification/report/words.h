#pragma once

#include "report/findings.h"

#include <ostream>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// The decision in sentences.
std::string inWords(const Findings& findings);

/// The effect, or the family, that was named.
std::string namedBy(const Study& study, const Answer& answer);

/// What the report takes for granted, in sentences.
std::vector<std::string> assumptionsOf(const Findings& findings);

/// What a run found, in a few lines.
void writeSummary(const Findings& findings, std::ostream& out);

} // namespace clepsydra::identification
