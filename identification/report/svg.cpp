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
constexpr double top = 26;
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
    double legend = top + 12;
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
            text << R"(<line style=")" << shape.style << R"(;stroke-width:3" x1=")" << width - right - 128
                 << R"(" x2=")" << width - right - 110 << R"(" y1=")" << legend - 3 << R"(" y2=")" << legend - 3
                 << R"("/><text class="tick" x=")" << width - right - 104 << R"(" y=")" << legend << R"(">)"
                 << escaped(shape.label) << "</text>\n";
            legend += 13;
        }
    }
    text << R"(<text class="label" text-anchor="middle" x=")" << (left + width - right) / 2 << R"(" y=")" << height - 8
         << R"(">)" << escaped(xLabel_)
         << "</text>\n<text class=\"label\" text-anchor=\"middle\" transform=\"translate(13 "
         << (top + height - bottom) / 2 << ") rotate(-90)\">" << escaped(yLabel_) << "</text>\n</svg>\n";
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
