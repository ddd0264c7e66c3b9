#pragma once

#include "report/findings.h"

#include <ostream>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// The decision in sentences.
std::string inWords(const Findings& findings);

/// What the report takes for granted, in sentences.
std::vector<std::string> assumptionsOf(const Findings& findings);

/// What a run found, in a few lines.
void writeSummary(const Findings& findings, std::ostream& out);

} // namespace clepsydra::identification
