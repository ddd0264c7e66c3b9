#pragma once

#include "decision/answer.h"
#include "heldOut/heldOut.h"
#include "nextRuns/nextExperiment.h"
#include "report/text.h"

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace clepsydra::identification
{

/// All results that a report is written from.
struct Findings
{
    const Study* study = nullptr;
    const Answer* answer = nullptr;
    const HeldOutResult* heldOut = nullptr; // null while the answer is written
    const std::vector<NextExperiment>* next = nullptr;
    const StudySimulator* studySimulator = nullptr;
    const std::vector<MeasuredCondition>* data = nullptr;        // of the training conditions
    const std::vector<MeasuredCondition>* heldOutData = nullptr; // null while the answer is written
};

/// Content of report.json, whose keys docs/reference/report.md describes.
Json jsonOf(const Findings& findings);

/// Adds what a report says in words, for readers who do not know the procedure: `summary`, `details`, `measureNext` and
/// `assumptions`.
void addSentences(Json& report, const Findings& findings);

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
std::string htmlOf(const Json& report, const std::optional<CurvePlots>& curves);

/// Writes the result of a plan as text: the effects that can be detected, named and distinguished.
void writePlan(const Study& study, const Emulator& emulator, const Layout& layout, const Measured& planned,
    const Evidence& evidence, const Calibration& calibration, const Visibility& visibility, std::ostream& out);

} // namespace clepsydra::identification
