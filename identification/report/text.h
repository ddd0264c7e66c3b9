#pragma once

#include "study/study.h"

#include <nlohmann/json.hpp>

#include <ostream>
#include <string>

namespace clepsydra::identification
{

/// Writes the main results of a report: the answer, its certainty, the fitted quantities, and what to measure next.
void writeText(const nlohmann::ordered_json& report, std::ostream& out);

/// A text with paths relative to the study's folder, since a report is read on other machines too.
std::string fromStudy(const Study& study, std::string text);

} // namespace clepsydra::identification
