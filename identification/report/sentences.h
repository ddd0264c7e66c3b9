#pragma once

#include "report/report.h"

namespace clepsydra::identification
{

/// Adds what a report says in words, for readers who do not know the procedure: `summary`, `details`, `measureNext` and
/// `assumptions`.
void addSentences(nlohmann::ordered_json& report, const Findings& findings);

} // namespace clepsydra::identification
