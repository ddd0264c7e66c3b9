#pragma once

#include "report/json.h"

#include <ostream>

namespace clepsydra::identification
{

/// What a plan tells, as text.
void writePlan(const Study& study, const EffectLibrary& library, const Noise& noise, const Identifiability& table,
    std::ostream& out);

/// What a run found, in a few lines.
void writeSummary(const Findings& findings, std::ostream& out);

/// The decision in sentences.
std::string inWords(const Findings& findings);

} // namespace clepsydra::identification
