#include "report/html.h"

#include "report/words.h"
#include "report/svg.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace clepsydra::identification
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr const char* style = R"(<style>
body{font:15px/1.5 sans-serif;max-width:1000px;margin:2em auto;padding:0 1em;color:#222}
h1{font-size:1.6em}h2{font-size:1.2em;margin-top:2em;border-bottom:1px solid #ccc}
.answer{background:#eef4fa;border-left:4px solid #2a6fa8;padding:.8em 1em;font-size:1.1em}
table{border-collapse:collapse;width:100%;font-size:.9em}th,td{text-align:left;padding:.25em .6em;border-bottom:1px solid #ddd}
td.n,th.n{text-align:right}tr.in{background:#fff4d6}
.plots{display:flex;flex-wrap:wrap;gap:8px}.plot{width:460px;max-width:100%}.bars{width:100%;max-width:760px}
svg text{font-family:sans-serif}.title{font-size:13px;font-weight:bold}.tick{font-size:10.5px;fill:#333}.label{font-size:11.5px}
.grid{stroke:#ddd;stroke-width:.7}.axis{stroke:#333}.error{stroke:#000;stroke-width:1.4}
.small{font-size:.85em;color:#555}
</style>
)";

constexpr const char* measuredStyle = "fill:none;stroke:#000;stroke-width:1.2";
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

std::string cell(const std::string& text, bool isNumber = false)
{
    return std::string("<td") + (isNumber ? " class=\"n\">" : ">") + text + "</td>";
}

//--- Curves ---------------------------------------------------------------------------------------------------------

/// Mean and extent of curves on a common axis of time.
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
        std::vector<double> values;
        values.reserve(curves.size());
        for (const auto* curve : curves)
        {
            values.push_back(valueAt(*curve, t));
        }
        double sum = 0.0;
        for (const double value : values)
        {
            sum += value;
        }
        bundle.time.push_back(t);
        bundle.mean.push_back(sum / static_cast<double>(values.size()));
        bundle.lower.push_back(*std::min_element(values.begin(), values.end()));
        bundle.upper.push_back(*std::max_element(values.begin(), values.end()));
    }
    return bundle;
}

void draw(Plot& plot, const Bundle& bundle, const char* line, const char* band, const std::string& label)
{
    if (!bundle.time.empty())
    {
        plot.band(bundle.time, bundle.lower, bundle.upper, band);
        plot.line(bundle.time, bundle.mean, line, label);
    }
}

std::string curvePlots(const Findings& findings)
{
    const Study& study = *findings.study;
    std::string html = "<div class=\"plots\">";
    for (const auto c : study.conditionsOf(Role::training))
    {
        Plot plot(study.conditions[c].name, "time [s]", study.valueColumn);
        draw(plot, bundleOf(findings.answer->null.simulations, c), beforeStyle, beforeBand, "without effect");
        if (!findings.answer->set.empty())
        {
            draw(plot, bundleOf(findings.answer->set.front().simulations, c), afterStyle, afterBand, "with the best");
        }
        bool first = true;
        for (const auto& curve : (*findings.data)[c].curves)
        {
            plot.line(curve.time, curve.value, measuredStyle, first ? "measured" : "");
            first = false;
        }
        html += plot.svg();
    }
    return html + "</div>\n";
}

//--- Tables ---------------------------------------------------------------------------------------------------------

std::string residualTable(const Json& report)
{
    std::ostringstream html;
    html << "<table><tr><th>condition</th><th>feature</th><th class=\"n\">measured - simulated</th><th "
            "class=\"n\">standard "
            "error</th><th class=\"n\">in standard errors</th></tr>\n";
    for (const auto& condition : report["residual"])
    {
        for (const auto& [name, value] : condition["measuredMinusSimulated"].items())
        {
            const double residual = value["value"].get<double>();
            const double error = value["standardError"].get<double>();
            html << (std::abs(residual) > 2.0 * error ? "<tr class=\"in\">" : "<tr>")
                 << cell(shown(condition["condition"])) << cell(escaped(name)) << cell(shown(residual), true)
                 << cell(shown(error), true) << cell(shown(residual / error, 2), true) << "</tr>\n";
        }
    }
    html << "</table>\n";
    return html.str();
}

std::string inRange(const Json& effect, const char* key)
{
    const Json& smallest = effect[key];
    const Bounds range{effect["range"][0].get<double>(), effect["range"][1].get<double>()};
    return smallest.is_null() || smallest > range.reach() ? "not in range" : shown(smallest, 2);
}

std::string effectTable(const Json& report)
{
    std::ostringstream html;
    html << "<table><tr><th>effect</th><th>meaning</th><th class=\"n\">amplitude (95 %)</th><th class=\"n\">probability "
            "(needed)</th><th class=\"n\">misfit</th><th class=\"n\">smallest detectable</th><th class=\"n\">smallest "
            "named</th></tr>\n";
    for (const auto& effect : report["effects"])
    {
        html << (effect["inSet"].get<bool>() ? "<tr class=\"in\">" : "<tr>") << cell(shown(effect["name"]))
             << cell(shown(effect["meaning"]))
             << cell(shown(effect["amplitude"], 2) + " (" + shown(effect["interval95"][0], 2) + " to "
                         + shown(effect["interval95"][1], 2) + ")",
                    true)
             << cell(shown(effect["probability"], 2) + " (" + shown(effect["probabilityNeeded"], 2) + ")", true)
             << cell(shown(effect["misfit"]), true) << cell(inRange(effect, "smallestDetectable"), true)
             << cell(inRange(effect, "smallestNamed"), true) << "</tr>\n";
    }
    html << "</table>\n<p class=\"small\">Amplitude 1 is the end of the effect's plausible range. Highlighted: the set "
            "that the data cannot tell apart. Probability that it is something outside the library: "
         << shown(report["somethingElse"]["probability"], 2) << " (needed: "
         << shown(report["somethingElse"]["probabilityNeeded"], 2) << ").</p>\n";
    return html.str();
}

std::string evidenceBars(const Json& report)
{
    std::vector<Bar> bars;
    for (const auto& effect : report["effects"])
    {
        bars.push_back({effect["name"], 100.0 * effect["probability"].get<double>(), 0.0,
            effect["inSet"].get<bool>() ? "fill:#e0a100" : "fill:#9bb"});
    }
    bars.push_back({"something else", 100.0 * report["somethingElse"]["probability"].get<double>(), 0.0, "fill:#bbb"});
    return barChart("Probability, given that there is something", bars, "%");
}

std::string heldOutBars(const Json& heldOut)
{
    std::vector<Bar> bars;
    const auto add = [&](const std::string& label, const Json& score, const std::string& color) {
        if (score.is_object() && score["rmsLogError"].is_number())
        {
            bars.push_back({label, 100.0 * score["rmsLogError"].get<double>(),
                196.0 * score["standardError"].get<double>(), "fill:" + color});
        }
    };
    add("before: no effect", heldOut["before"], "#c0392b");
    add("after: the best", heldOut["after"], "#2a6fa8");
    add("one more free parameter", heldOut["oneMoreParameter"], "#999");
    add("Gaussian process", heldOut["gaussianProcess"], "#bbb");
    return barChart("Root mean square log error on held-out conditions, 95 % intervals", bars, "%");
}

std::string heldOutSection(const Json& report)
{
    const Json& heldOut = report["heldOut"];
    if (!heldOut.is_object() || !heldOut["before"].is_object())
    {
        return "<p>No condition was held out: nothing shows that the answer predicts.</p>\n";
    }
    std::string html = heldOutBars(heldOut);
    html += "<table><tr><th>prediction</th><th class=\"n\">rms log error</th><th class=\"n\">CRPS</th></tr>\n";
    for (const auto* key : {"before", "after", "oneMoreParameter", "gaussianProcess"})
    {
        const Json& score = heldOut[key];
        if (score.is_object())
        {
            html +=
                "<tr>" + cell(key)
                + cell(shown(score["rmsLogError"]) + " &plusmn; " + shown(score["standardError"], 2), true)
                + cell(shown(score["crps"]["value"]) + " &plusmn; " + shown(score["crps"]["standardError"], 2), true)
                + "</tr>\n";
        }
    }
    html += "</table>\n<p class=\"small\">Noise alone would give " + shown(heldOut["noiseFloor"], 2)
            + ", and rarely more than " + shown(heldOut["noiseLimit"], 2) + ". Conditions: ";
    for (const auto& name : heldOut["conditions"])
    {
        html += shown(name) + ' ';
    }
    return html + "</p>\n";
}

std::string nextSection(const Json& report)
{
    if (report["nextExperiment"].empty())
    {
        return "<p>The study names no candidate conditions, or nothing is left to be told apart.</p>\n";
    }
    std::string html;
    for (const auto& next : report["nextExperiment"])
    {
        html += "<h3>" + shown(next["condition"]) + "</h3><p>Expected decision per measurement: "
                + shown(next["separation"]) + " (per cost " + shown(next["perCost"])
                + ").</p><table><tr><th>if</th><th "
                  "class=\"n\">probability</th><th>then</th></tr>\n";
        for (const auto& outcome : next["predicted"])
        {
            std::string features;
            for (const auto& [name, value] : outcome["features"].items())
            {
                features +=
                    escaped(name) + " " + shown(value["value"], 4) + " &plusmn; " + shown(value["sd"], 2) + "; ";
            }
            html += "<tr>" + cell(shown(outcome["if"])) + cell(shown(outcome["probability"], 2), true) + cell(features)
                    + "</tr>\n";
        }
        html += "</table>\n";
    }
    return html;
}

std::string runsSection(const Json& report)
{
    const Json& runs = report["runs"];
    std::string html = "<p>" + shown(runs["used"]) + " runs, " + shown(runs["executed"]) + " of them executed now ("
                       + shown(runs["seconds"]) + " s of computing time), the others from the store ("
                       + shown(runs["secondsOfStored"]) + " s when they were made).</p>\n<table>";
    for (const auto& [purpose, count] : runs["byPurpose"].items())
    {
        html += "<tr>" + cell(escaped(purpose)) + cell(shown(count), true) + "</tr>\n";
    }
    html += "</table>\n";
    if (!runs["failures"].empty())
    {
        html += "<p>Failed runs:</p><ul>";
        for (const auto& failure : runs["failures"])
        {
            html += "<li>" + shown(failure["purpose"]) + ", " + shown(failure["condition"]) + ", seed "
                    + std::to_string(failure["seed"].get<long>()) + ": "
                    + (failure["repeatedWithAnotherSeed"].get<bool>() ? "repeated with another seed" : "excluded")
                    + "<pre>" + shown(failure["reason"]) + "</pre></li>";
        }
        html += "</ul>\n";
    }
    return html;
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

std::string lookAlikesOf(const Json& report)
{
    const Json& pairs = report["calibration"]["lookAlikes"];
    if (pairs.empty())
    {
        return "<p>All effects that show in these conditions could be told apart at full size.</p>\n";
    }
    std::string html = "<p>Even at full size, sets for the first mostly hold the second:</p><ul>";
    for (const auto& pair : pairs)
    {
        html += "<li>" + shown(pair[0]) + " and " + shown(pair[1]) + "</li>\n";
    }
    return html + "</ul>\n";
}

} // namespace

std::string htmlOf(const Findings& findings, const Json& report)
{
    std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>"
                       + escaped(findings.study->name) + "</title>\n" + style + "</head><body>\n<h1>"
                       + escaped(findings.study->name) + "</h1>\n<p class=\"answer\">" + escaped(inWords(findings))
                       + "</p>\n";
    html += "<h2>Before and after, on conditions that no fit has seen</h2>\n" + heldOutSection(report);
    html += "<h2>Evidence</h2>\n" + evidenceBars(report) + effectTable(report);
    html += "<h2>Measured and simulated</h2>\n" + curvePlots(findings);
    html += "<h2>Residual at the refitted null</h2>\n" + residualTable(report);
    html += "<h2>What could not be told apart</h2>\n" + lookAlikesOf(report);
    html += "<h2>Next experiment</h2>\n" + nextSection(report);
    html += "<h2>Runs</h2>\n" + runsSection(report);
    html += "<h2>Assumed</h2>\n" + listOf(report["assumptions"]);
    if (!report["remarks"].empty())
    {
        html += "<h2>Remarks</h2>\n" + listOf(report["remarks"]);
    }
    return html + "<p class=\"small\">" + shown(report["program"]) + "</p>\n</body></html>\n";
}

} // namespace clepsydra::identification
