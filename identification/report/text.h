#pragma once

#include "study/study.h"

#include <nlohmann/json.hpp>

#include <ostream>
#include <string>

namespace clepsydra::identification
{

/// What a report says first: the answer in a sentence, how sure it is, what was fitted, what to measure next.
void writeText(const nlohmann::ordered_json& report, std::ostream& out);

/// A text with paths as they are from the study's folder: a report is read on other machines, too.
std::string fromStudy(const Study& study, std::string text);

/// A number of the report: "0.17 +- 0.01", or "-" where there is none.
std::string estimateText(const nlohmann::ordered_json& estimate);

} // namespace clepsydra::identification
