#include "report/html.h"

#include "lists.h"
#include "report/numbers.h"
#include "report/svg.h"
#include "report/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>

namespace clepsydra::identification
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr const char* style = R"(<style>
body{font:15px/1.5 sans-serif;max-width:1000px;margin:2em auto;padding:0 1em;color:#222}
h1{font-size:1.6em}h2{font-size:1.2em;margin-top:2em;border-bottom:1px solid #ccc}
.answer{background:#eef4fa;border-left:4px solid #2a6fa8;padding:.8em 1em;font-size:1.25em}
table{border-collapse:collapse;width:100%;font-size:.9em}th,td{text-align:left;padding:.25em .6em;border-bottom:1px solid #ddd}
td.n,th.n{text-align:right}tr.in{background:#fff4d6}
.plots{display:flex;flex-wrap:wrap;gap:8px}.plot{width:460px;max-width:100%}.bars{width:100%;max-width:760px}
svg text{font-family:sans-serif}.title{font-size:13px;font-weight:bold}.tick{font-size:10.5px;fill:#333}.label{font-size:11.5px}
.grid{stroke:#ddd;stroke-width:.7}.axis{stroke:#333}.error{stroke:#000;stroke-width:1.4}
.small{font-size:.85em;color:#555}
</style>
)";

constexpr const char* measuredStyle = "fill:none;stroke:#999;stroke-width:3";
constexpr const char* beforeStyle = "fill:none;stroke:#c0392b;stroke-width:1.3";
constexpr const char* afterStyle = "fill:none;stroke:#2a6fa8;stroke-width:1.3";
constexpr const char* beforeBand = "fill:#c0392b;fill-opacity:.18;stroke:none";
constexpr const char* afterBand = "fill:#2a6fa8;fill-opacity:.18;stroke:none";

std::string shown(double value, int digits = 3)
{
    std::ostringstream text;
    text << std::setprecision(digits) << value;
    return std::isfinite(value) ? text.str() : "-";
}

std::string shown(const Json& value, int digits = 3)
{
    return value.is_number() ? shown(value.get<double>(), digits) : value.is_string() ? escaped(value) : "-";
}

std::string share(const Json& value)
{
    return value.is_number() ? escaped(percent(value.get<double>())) : "-";
}

std::string cell(const std::string& text, bool isNumber = false)
{
    return std::string("<td") + (isNumber ? " class=\"n\">" : ">") + text + "</td>";
}

//--- Curves ---------------------------------------------------------------------------------------------------------

/// Mean and range of several curves at common times.
struct Bundle
{
    std::vector<double> time;
    std::vector<double> mean;
    std::vector<double> lower;
    std::vector<double> upper;
};

Bundle bundleOf(const std::vector<Simulation>& simulations, std::size_t condition)
{
    constexpr int points = 80;
    std::vector<const Curve*> curves;
    double end = 0.0;
    double begin = std::numeric_limits<double>::infinity();
    for (const auto& simulation : simulations)
    {
        if (simulation.condition == condition && simulation.curve.time.size() > 1)
        {
            curves.push_back(&simulation.curve);
            end = std::max(end, simulation.curve.time.back());
            begin = std::min(begin, simulation.curve.time.front());
        }
    }
    Bundle bundle;
    if (curves.empty())
    {
        return bundle;
    }
    for (int i = 0; i < points; ++i)
    {
        const double t = begin + (end - begin) * i / (points - 1);
        const auto values = mapped(curves, [&](const Curve* curve) { return valueAt(*curve, t); });
        const auto [lower, upper] = std::minmax_element(values.begin(), values.end());
        bundle.time.push_back(t);
        bundle.mean.push_back(std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()));
        bundle.lower.push_back(*lower);
        bundle.upper.push_back(*upper);
    }
    return bundle;
}

/// Plot of one condition: measured curves, and simulated curves without an effect and with the best explanation. Empty
/// if there are no curves.
std::string curvePlot(const Study& study, std::size_t condition, const std::vector<Simulation>& before,
    const std::vector<Simulation>& after, const std::string& afterName, const std::vector<Curve>& measured)
{
    const Bundle without = bundleOf(before, condition);
    const Bundle with = bundleOf(after, condition);
    if (without.time.empty() && measured.empty())
    {
        return "";
    }
    const ColumnSpecification& time = study.conditions[condition].measured.time;
    const ColumnSpecification& value = study.conditions[condition].measured.value;
    const auto label = [](const std::string& name, const ColumnSpecification& column) {
        return name + (column.unit.empty() ? "" : " [" + column.unit + ']');
    };
    const auto in = [](std::vector<double> values, const ColumnSpecification& column) {
        std::for_each(values.begin(), values.end(), [&](double& one) { one /= column.siUnits; });
        return values;
    };
    Plot plot(study.conditions[condition].name, time.unit.empty() ? "time [s]" : label("time", time),
        label(study.valueColumn, value));
    // The measured curves are drawn first, so that they do not cover the simulated ones.
    for (std::size_t i = 0; i < measured.size(); ++i)
    {
        plot.line(in(measured[i].time, time), in(measured[i].value, value), measuredStyle, i == 0 ? "measured" : "");
    }
    const auto draw = [&](const Bundle& bundle, const char* line, const char* band, const std::string& name) {
        if (!bundle.time.empty())
        {
            const auto times = in(bundle.time, time);
            plot.band(times, in(bundle.lower, value), in(bundle.upper, value), band);
            plot.line(times, in(bundle.mean, value), line, name);
        }
    };
    draw(without, beforeStyle, beforeBand, "without effect");
    draw(with, afterStyle, afterBand, afterName);
    return plot.svg();
}

std::string curvePlots(const Study& study, const std::vector<std::size_t>& conditions,
    const std::vector<Simulation>& before, const std::vector<Simulation>& after, const std::string& afterName,
    const std::vector<MeasuredCondition>& measured)
{
    std::string html = "<div class=\"plots\">";
    for (const auto c : conditions)
    {
        html += curvePlot(study, c, before, after, afterName, measured[c].curves);
    }
    return html + "</div>\n";
}

std::string trainingCurves(const Findings& findings)
{
    const auto simulationsOf = [](const Explanation& explanation) {
        return mapped(explanation.runs, [](const Run& run) { return run.simulation; });
    };
    const Answer& answer = *findings.answer;
    const Explanation* best = bestOf(answer);
    return curvePlots(*findings.study, findings.study->conditionsOf(Role::training), simulationsOf(answer.null),
        simulationsOf(best == nullptr ? Explanation{} : *best),
        answer.nearest ? "with the nearest effect" : "with effect", *findings.data);
}

std::string heldOutCurves(const Findings& findings)
{
    const HeldOutResult& heldOut = *findings.heldOut;
    return curvePlots(*findings.study, heldOut.conditions, heldOut.simulations.front(),
        heldOut.after ? heldOut.simulations.back() : std::vector<Simulation>{}, "with effect", *findings.heldOutData);
}

//--- Tables ---------------------------------------------------------------------------------------------------------

/// Measured and predicted numbers, one chart for each feature, in the units in which they were measured.
std::string numberCharts(const Json& report, const Json& numbers, const std::string& after)
{
    const Json units = report.value("units", Json::object());
    std::vector<std::string> features;
    std::map<std::string, DotChart> charts;
    for (const auto& row : numbers)
    {
        const std::string feature = row.at("feature").get<std::string>();
        const Json unit = units.value(feature, Json{{"unit", "SI units"}, {"si", 1.0}});
        const auto dot = [&](const char* key) {
            constexpr double deviations = 1.96;
            const double si = unit.at("si").get<double>();
            const Json& value = row.at(key);
            return value.is_object() && value.at("value").is_number() ? Dot{value.at("value").get<double>() / si,
                       value.at("standardError").is_number() ? deviations * value.at("standardError").get<double>() / si
                                                             : 0.0}
                                                                      : Dot{std::numeric_limits<double>::quiet_NaN(),
                                                                          0.0};
        };
        auto& chart = charts[feature];
        if (chart.rows.empty())
        {
            features.push_back(feature);
            chart.title = feature + " [" + unit.at("unit").get<std::string>() + "], 95 % intervals";
            chart.series = {{"measured", "#000"}, {"without effect", "#c0392b"}};
            if (row.at("after").is_object())
            {
                chart.series.emplace_back(after, "#2a6fa8");
            }
        }
        std::vector<Dot> dots = {dot("measured"), dot("before"), dot("after")};
        dots.resize(chart.series.size());
        chart.rows.emplace_back(row.at("condition").get<std::string>(), std::move(dots));
    }
    std::string html = "<div class=\"plots numbers\">";
    for (const auto& feature : features)
    {
        html += charts.at(feature).svg();
    }
    return html + "</div>\n";
}

std::string residualTable(const Json& report)
{
    std::ostringstream html;
    html << "<table><tr><th>condition</th><th>feature</th><th class=\"n\">measured minus simulated, without an "
            "effect</th><th class=\"n\">standard error</th><th class=\"n\">in standard errors</th></tr>\n";
    for (const auto& condition : report.at("residual"))
    {
        for (const auto& [name, value] : condition.at("measuredMinusSimulated").items())
        {
            const double residual = value.at("value").get<double>();
            const double error = value.at("standardError").get<double>();
            html << (std::abs(residual) > 2.0 * error ? "<tr class=\"in\">" : "<tr>")
                 << cell(shown(condition.at("condition"))) << cell(escaped(name)) << cell(shown(residual), true)
                 << cell(shown(error), true) << cell(shown(residual / error, 2), true) << "</tr>\n";
        }
    }
    html << "</table>\n";
    return html.str();
}

std::string inRange(const Json& effect, const char* key)
{
    const Json& smallest = effect.at(key);
    const Bounds range{effect.at("range").at(0).get<double>(), effect.at("range").at(1).get<double>()};
    return smallest.is_null() || smallest > range.reach() ? "not in range" : shown(smallest, 2);
}

std::string meaningOf(const Json& effect)
{
    const std::string meaning = shown(effect.at("meaning"));
    return (meaning.empty() ? shown(effect.at("name"))
                            : meaning + " <span class=\"small\">" + shown(effect.at("name")) + "</span>");
}

/// Why a probable effect is not in the set.
std::string reasonOf(const Json& effect)
{
    const Json& reason = effect.value("notInSetBecause", Json());
    return reason.is_string() ? " <span class=\"small\">" + shown(reason) + "</span>" : "";
}

std::string effectTable(const Json& report)
{
    std::ostringstream html;
    html << "<table><tr><th>effect</th><th class=\"n\">size (95 %)</th><th class=\"n\">probability</th><th "
            "class=\"n\">needed for the set</th><th class=\"n\">detected from size</th><th class=\"n\">named from "
            "size</th></tr>\n";
    for (const auto& effect : report.at("effects"))
    {
        const bool judged = effect.at("judged").get<bool>();
        html << (effect.at("inSet").get<bool>() ? "<tr class=\"in\">" : "<tr>") << cell(meaningOf(effect))
             << cell(judged ? shown(effect.at("amplitude"), 2) + " (" + shown(effect.at("interval95").at(0), 2) + " to "
                                  + shown(effect.at("interval95").at(1), 2) + ")"
                            : "its runs have failed",
                    true)
             << cell((judged ? share(effect.at("probability")) : "-") + reasonOf(effect), true)
             << cell(share(effect.at("probabilityNeeded")), true) << cell(inRange(effect, "smallestDetectable"), true)
             << cell(inRange(effect, "smallestNamed"), true) << "</tr>\n";
    }
    html << "</table>\n<p class=\"small\">Size 1 is the end of an effect's plausible range. Effects that the data "
            "cannot "
            "distinguish are highlighted. Probabilities assume that an effect is missing; that of a cause that the "
            "library "
            "does not list is "
         << share(report.at("somethingElse").at("probability"))
         << " (needed: " << share(report.at("somethingElse").at("probabilityNeeded")) << ").</p>\n";
    return html.str();
}

/// Predictions that are compared on held-out conditions: key of the report, label, colour.
constexpr std::array<std::array<const char*, 3>, 4> predictions = {{{"before", "without an effect", "#c0392b"},
    {"after", "with the effect", "#2a6fa8"}, {"oneMoreParameter", "with one more free parameter instead", "#999"},
    {"gaussianProcess", "with a Gaussian process instead", "#bbb"}}};

std::string heldOutBars(const Json& heldOut)
{
    std::vector<Bar> bars;
    for (const auto& [key, label, colour] : predictions)
    {
        const Json& score = heldOut.at(key);
        if (score.is_object() && score.at("rmsLogError").is_number())
        {
            bars.push_back({label, 100.0 * score.at("rmsLogError").get<double>(),
                196.0 * score.at("standardError").get<double>(), std::string("fill:") + colour});
        }
    }
    return barChart("Error (root mean square) on held-out conditions, 95 % intervals", bars, "%");
}

/// Table of texts and numbers with errors. \param columns  keys of the rows and titles; columns without values are left
/// out
std::string numberTable(const Json& rows, const std::vector<std::pair<std::string, std::string>>& columns)
{
    const auto isThere = [](const Json& value) {
        return value.is_object() || (value.is_string() && !value.get<std::string>().empty());
    };
    const auto at = [](const Json& row, const std::string& key) { return row.value(key, Json()); };
    std::vector<std::string> kept;
    std::string html = "<table><tr>";
    for (const auto& column : columns)
    {
        const auto& key = column.first;
        if (std::any_of(rows.begin(), rows.end(), [&](const Json& row) { return isThere(at(row, key)); }))
        {
            kept.push_back(key);
            html += (at(rows.front(), key).is_string() ? "<th>" : "<th class=\"n\">") + column.second + "</th>";
        }
    }
    html += "</tr>\n";
    for (const auto& row : rows)
    {
        html += "<tr>";
        for (const auto& key : kept)
        {
            const Json value = at(row, key);
            html += value.is_string() ? cell(shown(value)) : cell(estimateText(value), true);
        }
        html += "</tr>\n";
    }
    return html + "</table>\n";
}

/// Measured and predicted features of the held-out conditions.
std::string heldOutTable(const Json& heldOut)
{
    return numberTable(
               heldOut.at("numbers"), {{"condition", "condition"}, {"feature", "feature"}, {"measured", "measured"},
                                          {"before", "without an effect"}, {"after", "with the effect"}})
           + "<p class=\"small\">Instead of logarithms, the quantities themselves are shown, in SI units. Noise alone "
             "gives an error of "
           + rounded(100.0 * heldOut.at("noiseFloor").get<double>()) + " %.</p>\n";
}

std::string heldOutSection(const std::string& curves, const Json& report)
{
    const Json& heldOut = report.at("heldOut");
    return heldOut.at("before").is_object()
               ? curves + numberCharts(report, heldOut.at("numbers"), "with effect") + heldOutBars(heldOut)
                     + heldOutTable(heldOut)
               : "<p>No condition was held out, so the prediction has not been tested.</p>\n";
}

std::string fittedTable(const Json& report)
{
    if (report.at("fitted").empty())
    {
        return "<p>Nothing was fitted.</p>\n";
    }
    return numberTable(report.at("fitted"),
               {{"name", "quantity"}, {"unit", "unit"}, {"withEffect", "with the effect"},
                   {"withoutEffect", "without an effect"}, {"independent", "measured independently"},
                   {"assumed", "expected before"}, {"from", "origin of that"}})
           + "<p class=\"small\">Quantities without a unit have that of the case's entry.</p>\n";
}

std::string listOf(const Json& sentences)
{
    std::string html = "<ul>";
    for (const auto& sentence : sentences)
    {
        html += "<li>" + shown(sentence) + "</li>\n";
    }
    return html + "</ul>\n";
}

std::string nextSection(const Json& report)
{
    std::string html = report.at("measureNext").empty()
                           ? "<p>There is nothing to distinguish, or the study lists no candidate conditions.</p>\n"
                           : listOf(report.at("measureNext"));
    for (const auto& next : report.at("nextExperiment"))
    {
        html += "<h3>" + shown(next.at("condition"))
                + "</h3><p class=\"small\">The expected divergence between the explanations after one measurement is "
                + rounded(next.at("separation").get<double>()) + ", and " + rounded(next.at("perCost").get<double>())
                + " per unit of cost.</p><table><tr><th>if the cause is</th><th class=\"n\">probability</th>"
                  "<th>one measurement gives</th></tr>\n";
        for (const auto& outcome : next.at("predicted"))
        {
            std::string features;
            for (const auto& [name, value] : outcome.at("features").items())
            {
                features +=
                    escaped(name) + " " + shown(value.at("value"), 4) + " &plusmn; " + shown(value.at("sd"), 2) + "; ";
            }
            html += "<tr>" + cell(shown(outcome.at("if"))) + cell(share(outcome.at("probability")), true)
                    + cell(features) + "</tr>\n";
        }
        html += "</table>\n";
    }
    return html;
}

std::string runsSection(const Json& report)
{
    const Json& runs = report.at("runs");
    std::string html = "<p>The answer rests on " + shown(runs.at("used")) + " runs. Of these, "
                       + shown(runs.at("executed")) + " were made now and took " + shown(runs.at("seconds"))
                       + " s of wall-clock time, summed over the runs; the others were stored and took "
                       + shown(runs.at("secondsOfStored")) + " s when they were made.</p>\n<table>";
    for (const auto& [purpose, count] : runs.at("byPurpose").items())
    {
        html += "<tr>" + cell(escaped(purpose)) + cell(shown(count), true) + "</tr>\n";
    }
    html += "</table>\n";
    if (!runs.at("failures").empty())
    {
        html += "<p>These runs failed:</p><ul>";
        for (const auto& failure : runs.at("failures"))
        {
            html += "<li>" + shown(failure.at("purpose")) + ", " + shown(failure.at("condition")) + ", seed "
                    + std::to_string(failure.at("seed").get<long>()) + ": "
                    + (failure.at("repeatedWithAnotherSeed").get<bool>() ? "repeated with another seed" : "excluded")
                    + "<pre>" + shown(failure.at("reason")) + "</pre></li>";
        }
        html += "</ul>\n";
    }
    return html;
}

std::string lookAlikesOf(const Json& report)
{
    const Json& pairs = report.at("calibration").at("lookAlikes");
    if (pairs.empty())
    {
        return "<p>All effects that these conditions show can be distinguished at full size.</p>\n";
    }
    std::string html =
        "<p>For these pairs, most data with the first effect at full size also admit the second:</p><ul>";
    for (const auto& pair : pairs)
    {
        html += "<li>" + shown(pair.at(0)) + " and " + shown(pair.at(1)) + "</li>\n";
    }
    return html + "</ul>\n";
}

constexpr const char* withoutCurves =
    "<p class=\"small\">The curves are not drawn, because their runs are not stored here. "
    "<code>traceResidual run</code> makes the runs.</p>\n";

} // namespace

CurvePlots curvePlotsOf(const Findings& findings)
{
    return {trainingCurves(findings), findings.heldOut->conditions.empty() ? "" : heldOutCurves(findings)};
}

std::string htmlOf(const Json& report, const std::optional<CurvePlots>& curves)
{
    const CurvePlots plots = curves.value_or(CurvePlots{withoutCurves, withoutCurves});
    const std::string title = shown(report.at("study"));
    std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + title + "</title>\n"
                       + style + "</head><body>\n<h1>" + title + "</h1>\n<p class=\"answer\">"
                       + shown(report.at("summary")) + "</p>\n" + listOf(report.at("details"));
    html += "<h2>Fitted quantities</h2>\n" + fittedTable(report);
    html += "<h2>Held-out conditions, without and with the effect</h2>\n" + heldOutSection(plots.heldOut, report);
    html += "<h2>What to measure next</h2>\n" + nextSection(report);
    html += "<h2>Evidence</h2>\n" + effectTable(report);
    html += "<h2>Indistinguishable effects</h2>\n" + lookAlikesOf(report);
    html += "<h2>Training conditions, measured and simulated</h2>\n" + plots.fitted
            + numberCharts(report, report.value("numbers", Json::array()),
                report.value("nearest", Json()).is_object() ? "with the nearest effect" : "with effect")
            + residualTable(report);
    html += "<h2>Runs</h2>\n" + runsSection(report);
    html += "<h2>Assumptions</h2>\n" + listOf(report.at("assumptions"));
    if (!report.at("remarks").empty())
    {
        html += "<h2>Remarks</h2>\n" + listOf(report.at("remarks"));
    }
    html += "<p class=\"small\">" + shown(report.at("program")) + "</p>\n</body></html>\n";
    // Reports of earlier versions contain "+-".
    for (auto at = html.find("+-"); at != std::string::npos; at = html.find("+-", at))
    {
        html.replace(at, 2, "&plusmn;");
    }
    return html;
}

} // namespace clepsydra::identification
