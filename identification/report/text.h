#pragma once

#include "heldOut/predictive.h"
#include "study/study.h"

#include <nlohmann/json.hpp>

#include <ios>
#include <ostream>
#include <string>

namespace clepsydra::identification
{

using Json = nlohmann::ordered_json; // keeps the order of its keys

/// \param format  std::fixed, std::scientific or std::defaultfloat
std::string formatted(double value, std::ios_base& (*format)(std::ios_base&), int digits);

/// A number with a few significant digits.
std::string rounded(double value, int digits = 2);

/// A share in percent; "<1 %" and ">99 %" at the ends of the scale.
std::string percent(double share);

/// A p-value: "p = 0.03"; "p below 1e-6" where no test of the program can tell smaller ones apart.
std::string pValueText(double pValue);

void to_json(Json& json, const Estimate& estimate);

/// A value with its standard error, with as many digits as the error allows: "0.173 ± 0.012".
std::string withError(const Estimate& estimate);

enum class Escape
{
    none,
    html
};

/// Fills a mustache template (https://mustache.github.io/mustache.5.html). What is null or empty counts as false, and a
/// number is an object of its forms:
///     text     three significant digits, or all digits of an integer
///     short    two significant digits
///     p        a p-value: "p = 0.03"
///     share    a share in percent: "<1 %"
///     percent  "2.1 %"
/// An estimate, an object with `value` and `standardError` or `sd`, has besides these keys its `text`: "0.17 ± 0.01".
std::string filled(const char* pattern, const Json& data, Escape escape);

/// Writes the main results of a report: the answer, its certainty, the fitted quantities, and what to measure next.
void writeText(const Json& report, std::ostream& out);

/// A text with paths relative to the study's folder, since a report is read on other machines too.
std::string fromStudy(const Study& study, std::string text);

} // namespace clepsydra::identification
