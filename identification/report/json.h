#pragma once

#include "report/findings.h"

#include <nlohmann/json.hpp>

namespace clepsydra::identification
{

/// Content of report.json, whose keys README.md describes.
nlohmann::ordered_json jsonOf(const Findings& findings);

} // namespace clepsydra::identification
