#include "report/svg.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <utility>

namespace clepsydra::identification
{

namespace
{

constexpr double width = 460;
constexpr double height = 280;
constexpr double left = 62;
constexpr double right = 12;
constexpr double top = 40;
constexpr double bottom = 42;

std::string shown(double value)
{
    std::ostringstream text;
    text << std::setprecision(3) << (std::abs(value) < 1e-12 ? 0.0 : value);
    return text.str();
}

/// Distance between ticks: 1, 2 or 5 times a power of ten, about six in the range.
double niceStep(double range)
{
    const double raw = range / 6.0;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0})
    {
        if (factor * power >= raw)
        {
            return factor * power;
        }
    }
    return 10.0 * power;
}

struct Range
{
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void take(double value)
    {
        if (std::isfinite(value))
        {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    void widen()
    {
        if (!(high > low))
        {
            const double middle = std::isfinite(low) ? low : 0.0;
            low = middle - 0.5;
            high = middle + 0.5;
        }
    }
};

/// Legend in one line above the plot, where there are no data. \param style  of a line of each label
std::string legendOf(const std::vector<std::pair<std::string, std::string>>& labels, double from)
{
    constexpr double perLetter = 5.6;
    std::ostringstream text;
    text << std::fixed << std::setprecision(1);
    double x = from;
    for (const auto& [label, style] : labels)
    {
        text << R"(<line style=")" << style << R"(;stroke-width:3" x1=")" << x << R"(" x2=")" << x + 16
             << R"(" y1="29" y2="29"/><text class="tick" x=")" << x + 20 << R"(" y="32">)" << escaped(label)
             << "</text>\n";
        x += 34 + perLetter * static_cast<double>(label.size());
    }
    return text.str();
}

} // namespace

std::string escaped(const std::string& text)
{
    std::string safe;
    for (const char c : text)
    {
        safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    }
    return safe;
}

Plot::Plot(std::string title, std::string xLabel, std::string yLabel)
    : title_(std::move(title)),
      xLabel_(std::move(xLabel)),
      yLabel_(std::move(yLabel))
{}

void Plot::line(
    const std::vector<double>& x, const std::vector<double>& y, const std::string& style, const std::string& label)
{
    shapes_.push_back({x, y, style, label, false});
}

void Plot::band(const std::vector<double>& x, const std::vector<double>& lower, const std::vector<double>& upper,
    const std::string& style)
{
    Shape shape{x, lower, style, "", true};
    shape.x.insert(shape.x.end(), x.rbegin(), x.rend());
    shape.y.insert(shape.y.end(), upper.rbegin(), upper.rend());
    shapes_.push_back(std::move(shape));
}

std::string Plot::svg() const
{
    Range xs;
    Range ys;
    for (const auto& shape : shapes_)
    {
        for (std::size_t i = 0; i < shape.x.size(); ++i)
        {
            xs.take(shape.x[i]);
            ys.take(shape.y[i]);
        }
    }
    xs.widen();
    ys.widen();
    const auto px = [&](double x) { return left + (x - xs.low) / (xs.high - xs.low) * (width - left - right); };
    const auto py = [&](double y) {
        return height - bottom - (y - ys.low) / (ys.high - ys.low) * (height - top - bottom);
    };

    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << R"(<svg viewBox="0 0 )" << width << ' ' << height
         << R"(" class="plot" role="img" aria-label=")" << escaped(title_) << "\">\n<text x=\"" << left
         << R"(" y="16" class="title">)" << escaped(title_) << "</text>\n";
    const double xStep = niceStep(xs.high - xs.low);
    for (double x = std::ceil(xs.low / xStep) * xStep; x <= xs.high + 1e-9 * xStep; x += xStep)
    {
        text << R"(<line class="grid" x1=")" << px(x) << R"(" x2=")" << px(x) << R"(" y1=")" << top << R"(" y2=")"
             << height - bottom << R"("/><text class="tick" text-anchor="middle" x=")" << px(x) << R"(" y=")"
             << height - bottom + 14 << R"(">)" << shown(x) << "</text>\n";
    }
    const double yStep = niceStep(ys.high - ys.low);
    for (double y = std::ceil(ys.low / yStep) * yStep; y <= ys.high + 1e-9 * yStep; y += yStep)
    {
        text << R"(<line class="grid" x1=")" << left << R"(" x2=")" << width - right << R"(" y1=")" << py(y)
             << R"(" y2=")" << py(y) << R"("/><text class="tick" text-anchor="end" x=")" << left - 5 << R"(" y=")"
             << py(y) + 3 << R"(">)" << shown(y) << "</text>\n";
    }
    std::vector<std::pair<std::string, std::string>> labels;
    for (const auto& shape : shapes_)
    {
        text << "<" << (shape.closed ? "polygon" : "polyline") << R"( style=")" << shape.style << R"(" points=")";
        for (std::size_t i = 0; i < shape.x.size(); ++i)
        {
            if (std::isfinite(shape.y[i]))
            {
                text << px(shape.x[i]) << ',' << py(shape.y[i]) << ' ';
            }
        }
        text << "\"/>\n";
        if (!shape.label.empty())
        {
            labels.emplace_back(shape.label, shape.style);
        }
    }
    text << legendOf(labels, left) << R"(<text class="label" text-anchor="middle" x=")" << (left + width - right) / 2
         << R"(" y=")" << height - 8 << R"(">)" << escaped(xLabel_)
         << "</text>\n<text class=\"label\" text-anchor=\"middle\" transform=\"translate(13 "
         << (top + height - bottom) / 2 << ") rotate(-90)\">" << escaped(yLabel_) << "</text>\n</svg>\n";
    return text.str();
}

std::string DotChart::svg() const
{
    constexpr double row = 20;
    constexpr double names = 150;
    constexpr double farApart = 5.0;
    Range range;
    bool isPositive = true;
    for (const auto& [name, dots] : rows)
    {
        for (const auto& [value, error] : dots)
        {
            range.take(value - error);
            range.take(value + error);
            isPositive = isPositive && !(value - error <= 0.0);
        }
    }
    range.widen();
    const bool isLog = isPositive && range.high > farApart * range.low;
    const auto scaled = [&](double value) { return isLog ? std::log10(value) : value; };
    const double margin = 0.03 * (scaled(range.high) - scaled(range.low));
    const double low = scaled(range.low) - margin;
    const double high = scaled(range.high) + margin;
    const auto px = [&](double x) { return names + (scaled(x) - low) / (high - low) * (width - names - right); };
    const double end = top + row * static_cast<double>(rows.size());
    std::vector<double> ticks;
    if (isLog)
    {
        for (double power = std::pow(10.0, std::floor(low)); power <= range.high; power *= 10.0)
        {
            ticks.insert(ticks.end(), {power, 2.0 * power, 5.0 * power});
        }
    }
    else
    {
        const double step = niceStep(high - low);
        for (double x = std::ceil(low / step) * step; x <= high; x += step)
        {
            ticks.push_back(x);
        }
    }
    std::vector<std::pair<std::string, std::string>> labels;
    for (const auto& [label, colour] : series)
    {
        labels.emplace_back(label, "stroke:" + colour);
    }
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << R"(<svg viewBox="0 0 )" << width << ' ' << end + 20
         << R"(" class="plot" role="img" aria-label=")" << escaped(title)
         << "\">\n<text x=\"4\" y=\"16\" class=\"title\">" << escaped(title) << "</text>\n"
         << legendOf(labels, 4);
    for (const double tick : ticks)
    {
        if (scaled(tick) >= low && scaled(tick) <= high)
        {
            text << R"(<line class="grid" x1=")" << px(tick) << R"(" x2=")" << px(tick) << R"(" y1=")" << top
                 << R"(" y2=")" << end << R"("/><text class="tick" text-anchor="middle" x=")" << px(tick) << R"(" y=")"
                 << end + 14 << R"(">)" << shown(tick) << "</text>\n";
        }
    }
    double y = top;
    for (const auto& [name, dots] : rows)
    {
        text << R"(<text class="tick" text-anchor="end" x=")" << names - 6 << R"(" y=")" << y + 13 << R"(">)"
             << escaped(name) << "</text>\n";
        for (std::size_t i = 0; i < dots.size(); ++i)
        {
            const auto& [value, error] = dots[i];
            if (std::isfinite(value))
            {
                const double at = y + row * static_cast<double>(i + 1) / static_cast<double>(dots.size() + 1);
                text << R"(<line style="stroke:)" << series[i].second << R"(" x1=")" << px(value - error) << R"(" x2=")"
                     << px(value + error) << R"(" y1=")" << at << R"(" y2=")" << at << R"("/><circle style="fill:)"
                     << series[i].second << R"(" r="2.8" cx=")" << px(value) << R"(" cy=")" << at << "\"/>\n";
            }
        }
        y += row;
    }
    text << "</svg>\n";
    return text.str();
}

std::string barChart(const std::string& title, const std::vector<Bar>& bars, const std::string& unit)
{
    constexpr double row = 22;
    constexpr double labels = 250;
    constexpr double all = 640;
    Range range;
    range.take(0.0);
    for (const auto& bar : bars)
    {
        range.take(bar.value - bar.error);
        range.take(bar.value + bar.error);
    }
    range.widen();
    const auto px = [&](double x) { return labels + (x - range.low) / (range.high - range.low) * (all - labels - 90); };
    const double tall = top + row * static_cast<double>(bars.size()) + 8;
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << R"(<svg viewBox="0 0 )" << all << ' ' << tall
         << R"(" class="bars" role="img" aria-label=")" << escaped(title)
         << "\">\n<text x=\"4\" y=\"16\" class=\"title\">" << escaped(title) << "</text>\n";
    double y = top;
    for (const auto& bar : bars)
    {
        const double from = std::min(px(0.0), px(bar.value));
        text << R"(<text class="tick" text-anchor="end" x=")" << labels - 6 << R"(" y=")" << y + 14 << R"(">)"
             << escaped(bar.label) << "</text>";
        if (std::isfinite(bar.value))
        {
            text << R"(<rect style=")" << bar.style << R"(" x=")" << from << R"(" y=")" << y + 3 << R"(" height=")"
                 << row - 7 << R"(" width=")" << std::abs(px(bar.value) - px(0.0)) << R"("/>)";
            if (bar.error > 0.0)
            {
                text << R"(<line class="error" x1=")" << px(bar.value - bar.error) << R"(" x2=")"
                     << px(bar.value + bar.error) << R"(" y1=")" << y + 10.5 << R"(" y2=")" << y + 10.5 << R"("/>)";
            }
            text << R"(<text class="tick" x=")" << std::max(px(bar.value + bar.error), px(0.0)) + 6 << R"(" y=")"
                 << y + 14 << R"(">)" << shown(bar.value) << ' ' << unit << "</text>\n";
        }
        y += row;
    }
    text << R"(<line class="axis" x1=")" << px(0.0) << R"(" x2=")" << px(0.0) << R"(" y1=")" << top << R"(" y2=")" << y
         << "\"/>\n</svg>\n";
    return text.str();
}

} // namespace clepsydra::identification
