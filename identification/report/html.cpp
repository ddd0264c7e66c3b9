#include "report/report.h"

#include "lists.h"
#include "report/svg.h"
#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace clepsydra::identification
{

namespace
{

constexpr const char* page =
#include "report/page.mustache"
    ;

constexpr const char* blue = "#2a6fa8";
constexpr const char* red = "#c0392b";
constexpr double deviations95 = 1.96; // half width of a 95 % interval

//--- Curves ---------------------------------------------------------------------------------------------------------

/// Draws the mean and the range of simulated curves of a condition.
void drawRuns(Plot& plot, const Study& study, std::size_t condition, const std::vector<Simulation>& simulations,
    const std::string& colour, const std::string& label)
{
    constexpr int points = 80;
    double begin = std::numeric_limits<double>::infinity();
    double end = 0.0;
    std::vector<const Curve*> curves;
    for (const auto& one : simulations)
    {
        if (one.condition == condition && one.curve.time.size() > 1)
        {
            curves.push_back(&one.curve);
            begin = std::min(begin, one.curve.time.front());
            end = std::max(end, one.curve.time.back());
        }
    }
    if (curves.empty())
    {
        return;
    }
    const Measurement& measured = study.conditions[condition].measured;
    const Eigen::ArrayXd time = Eigen::ArrayXd::LinSpaced(points, begin, end);
    Eigen::ArrayXXd values(points, curves.size());
    for (Eigen::Index c = 0; c < values.cols(); ++c)
    {
        values.col(c) = time.unaryExpr([&](double t) { return valueAt(*curves[c], t); });
    }
    values /= measured.value.siUnits;
    const Eigen::ArrayXd shown = time / measured.time.siUnits;
    Eigen::ArrayXd around(2 * points);
    Eigen::ArrayXd band(2 * points);
    around << shown, shown.reverse();
    band << values.rowwise().minCoeff(), values.rowwise().maxCoeff().reverse();
    plot.line(around, band, "fill:" + colour + ";fill-opacity:.18;stroke:none");
    plot.line(shown, values.rowwise().mean(), "fill:none;stroke:" + colour, label);
}

/// Measured curves, and simulated curves without an effect and with the best explanation.
std::string curvePlots(const Study& study, const std::vector<std::size_t>& conditions,
    const std::vector<Simulation>& before, const std::vector<Simulation>& after, const std::string& afterName,
    const std::vector<MeasuredCondition>& measured)
{
    const auto label = [](const std::string& name, const std::string& unit) {
        return unit.empty() ? name : name + " [" + unit + ']';
    };
    std::string html = "<div class=\"plots\">";
    for (const auto c : conditions)
    {
        const Condition& condition = study.conditions[c];
        const auto& [files, time, value, numbers] = condition.measured;
        Plot plot{condition.name, time.unit.empty() ? "time [s]" : label("time", time.unit),
            label(study.valueColumn, value.unit)};
        // The measured curves are drawn first, so that they do not cover the simulated ones.
        for (const auto& curve : measured[c].curves)
        {
            using Values = Eigen::Map<const Eigen::ArrayXd>;
            const auto size = static_cast<Eigen::Index>(curve.time.size());
            plot.line(Values(curve.time.data(), size) / time.siUnits, Values(curve.value.data(), size) / value.siUnits,
                "fill:none;stroke:#999;stroke-width:3", "measured");
        }
        drawRuns(plot, study, c, before, red, "without effect");
        if (!plot.lines.empty())
        {
            drawRuns(plot, study, c, after, blue, afterName);
            html += plot.svg();
        }
    }
    return html + "</div>\n";
}

//--- Numbers --------------------------------------------------------------------------------------------------------

double numberOr(const Json& json, double otherwise)
{
    return json.is_number() ? json.get<double>() : otherwise;
}

/// Draws an estimate with its 95 % interval; nothing, if there is none. \param unit  in which it is shown
void drawEstimate(Plot& plot, const Json& estimate, double unit, double y, const char* colour, const std::string& label)
{
    if (estimate.is_object())
    {
        plot.dot(numberOr(estimate.at("value"), std::numeric_limits<double>::quiet_NaN()) / unit,
            deviations95 * numberOr(estimate.at("standardError"), 0.0) / unit, y, colour, label);
    }
}

/// Numbers of the report with the units in which they were measured, and in these units; in SI units where the report
/// does not give them.
Json inUnits(const Json& report, Json numbers)
{
    for (auto& row : numbers)
    {
        const Json unit = report.value("units", Json::object())
                              .value(row.at("feature").get<std::string>(), Json{{"unit", "SI units"}, {"si", 1.0}});
        row["unit"] = unit.at("unit");
        for (const auto* key : {"measured", "before", "after"})
        {
            for (auto& number : row.at(key)) // of an estimate; null has none
            {
                number = number.is_number() ? Json(number.get<double>() / unit.at("si").get<double>()) : number;
            }
        }
    }
    return numbers;
}

/// Measured and predicted numbers, one chart for each feature, in the units in which they were measured.
std::string numberCharts(const Json& report, const Json& numbers, const std::string& after)
{
    std::map<std::string, std::vector<Json>> byFeature;
    for (const auto& row : inUnits(report, numbers))
    {
        byFeature[row.at("feature")].push_back(row);
    }
    std::string html = "<div class=\"plots numbers\">";
    for (const auto& [feature, rows] : byFeature)
    {
        Plot plot{feature + " [" + rows.front().at("unit").get<std::string>() + "], 95 % intervals"};
        plot.rows = mapped(rows, [](const Json& row) { return row.at("condition").get<std::string>(); });
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            const auto draw = [&](const char* key, double within, const char* colour, const std::string& label) {
                drawEstimate(plot, rows[i].at(key), 1.0, static_cast<double>(i) + within, colour, label);
            };
            draw("measured", 0.25, "#000", "measured");
            draw("before", 0.5, red, "without effect");
            draw("after", 0.75, blue, after);
        }
        html += plot.svg();
    }
    return html + "</div>\n";
}

/// Errors of the predictions that are compared on held-out conditions.
std::string errorChart(const Json& heldOut)
{
    Plot plot{"Error (root mean square) on held-out conditions [%], 95 % intervals"};
    for (const auto& [key, label] : {std::pair("before", "without an effect"), std::pair("after", "with the effect"),
             std::pair("nearest", "with the nearest effect"),
             std::pair("oneMoreParameter", "one more free parameter instead"),
             std::pair("gaussianProcess", "a Gaussian process instead")})
    {
        if (const Json score = heldOut.value(key, Json()); score.is_object())
        {
            const Json& error = score.at("rmsLogError");
            plot.rows.push_back(label + (": " + rounded(100.0 * numberOr(error, std::nan("")))) + " %");
            drawEstimate(plot, {{"value", error}, {"standardError", score.at("standardError")}}, 0.01,
                static_cast<double>(plot.rows.size()) - 0.5, blue, "");
        }
    }
    return plot.svg();
}

/// The keys of an object as `name`, their values as `is`.
Json listOf(const Json& object)
{
    Json list = Json::array();
    for (const auto& [name, value] : object.items())
    {
        list.push_back({{"name", name}, {"is", value}});
    }
    return list;
}

constexpr const char* withoutCurves =
    "<p class=\"small\">The curves are not drawn, because their runs are not stored here. "
    "<code>traceResidual run</code> makes the runs.</p>\n";

} // namespace

CurvePlots curvePlotsOf(const Findings& findings)
{
    const auto& [study, answer, heldOut, next, simulator, data, heldOutData] = findings;
    const Explanation* best = bestOf(*answer);
    const std::string with = answer->nearest ? "with the nearest effect" : "with effect";
    return {curvePlots(*study, study->conditionsOf(Role::training), answer->null.runs,
                best == nullptr ? std::vector<Simulation>{} : best->runs, with, *data),
        heldOut->conditions.empty()
            ? ""
            : curvePlots(*study, heldOut->conditions, heldOut->simulations.front(),
                heldOut->simulations.size() > 1 ? heldOut->simulations[1] : std::vector<Simulation>{}, with,
                *heldOutData)};
}

std::string htmlOf(const Json& report, const std::optional<CurvePlots>& curves)
{
    for (const auto* key :
        {"study", "summary", "details", "fitted", "measureNext", "assumptions", "remarks", "program"})
    {
        report.at(key);
    }
    const std::string with = report.value("nearest", Json()).is_object() ? "with the nearest effect" : "with effect";
    Json shown = report;
    shown["plots"] = {{"fitted", curves ? curves->fitted : withoutCurves},
        {"heldOut", curves ? curves->heldOut : withoutCurves},
        {"fittedNumbers", numberCharts(report, report.value("numbers", Json::array()), with)}};
    if (const Json& heldOut = report.at("heldOut"); heldOut.at("before").is_object())
    {
        shown["plots"]["heldOutNumbers"] = numberCharts(report, heldOut.at("numbers"), with);
        shown["plots"]["errors"] = errorChart(heldOut);
        shown["heldOut"]["numbers"] = inUnits(report, heldOut.at("numbers"));
    }
    for (auto& effect : shown.at("effects"))
    {
        const double reach = std::max(effect.at("range").at(1).get<double>(), -effect.at("range").at(0).get<double>());
        for (const auto* key : {"smallestDetectable", "smallestNamed"})
        {
            effect[key] = numberOr(effect.at(key), reach + 1.0) > reach ? Json() : effect[key];
        }
    }
    for (auto& condition : shown.at("residual"))
    {
        auto& features = condition.at("measuredMinusSimulated");
        features = listOf(features);
        for (auto& feature : features)
        {
            constexpr double large = 2.0;
            const double ratio =
                feature["is"].at("value").get<double>() / feature["is"].at("standardError").get<double>();
            feature["inErrors"] = ratio;
            feature["isLarge"] = std::abs(ratio) > large;
        }
    }
    for (auto& next : shown.at("nextExperiment"))
    {
        for (auto& outcome : next.at("predicted"))
        {
            outcome["features"] = listOf(outcome.at("features"));
        }
    }
    shown["runs"]["byPurpose"] = listOf(report.at("runs").at("byPurpose"));
    return filled(page, shown, Escape::html);
}

} // namespace clepsydra::identification
