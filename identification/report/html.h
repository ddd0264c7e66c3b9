#pragma once

#include "report/findings.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace clepsydra::identification
{

/// Plots of measured and simulated curves as HTML. They need the runs; all other parts of the page are in report.json.
struct CurvePlots
{
    std::string fitted;  // of the training conditions
    std::string heldOut; // of the held-out conditions
};

/// Draws the curves of a study. \param findings  including the results of the held-out conditions
CurvePlots curvePlotsOf(const Findings& findings);

/// Content of report.html, a page that refers to no other files. \param curves  empty if the runs are not stored
/// \throws nlohmann::json::exception if the report lacks a key that the page shows
std::string htmlOf(const nlohmann::ordered_json& report, const std::optional<CurvePlots>& curves);

} // namespace clepsydra::identification
