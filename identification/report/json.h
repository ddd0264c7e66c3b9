#pragma once

#include "report/findings.h"

#include <nlohmann/json.hpp>

namespace clepsydra::identification
{

/// report.json: keys are described in README.md.
nlohmann::ordered_json jsonOf(const Findings& findings);

} // namespace clepsydra::identification
