#pragma once

#include "report/json.h"

#include <string>

namespace clepsydra::identification
{

/// The report for people: one page without anything outside it.
std::string htmlOf(const Findings& findings, const nlohmann::ordered_json& report);

} // namespace clepsydra::identification
