#pragma once

#include "report/findings.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace clepsydra::identification
{

/// Pictures of measured and simulated curves, as HTML. They need the runs; everything else on the page is in report.json.
struct CurvePlots
{
    std::string fitted;  // of the conditions that were fitted
    std::string heldOut; // of those that no fit has seen
};

/// \param findings  with what was found on the held-out conditions
CurvePlots curvePlotsOf(const Findings& findings);

/// The report for people: one page without anything outside it. Without the curves where their runs are not stored.
/// \throws nlohmann::json::exception where the report lacks what the page shows
std::string htmlOf(const nlohmann::ordered_json& report, const std::optional<CurvePlots>& curves);

} // namespace clepsydra::identification
