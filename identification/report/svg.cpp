#include "report/svg.h"

#include "lists.h"
#include "report/text.h"

#include <kainjow/mustache.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <set>
#include <sstream>

namespace clepsydra::identification
{

namespace
{

constexpr double width = 460;
constexpr double right = width - 12;
constexpr double top = 40;
constexpr double perLetter = 5.6;

/// Places of values along one side of a plot, in pixels.
class Axis
{
public:
    /// \param values  what it shows
    /// \param mayBeLog  leaves a margin, and is logarithmic where the values are positive and far apart
    Axis(std::vector<double> values, double from, double to, bool mayBeLog = false)
        : from_(from),
          to_(to)
    {
        constexpr double farApart = 5.0;
        eraseIf(values, [](double one) { return !std::isfinite(one); });
        values.resize(std::max<std::size_t>(1, values.size()));
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        isLog_ = mayBeLog && *low > 0.0 && *high > farApart * *low;
        const double margin = *high > *low ? (mayBeLog ? 0.03 * (scaled(*high) - scaled(*low)) : 0.0) : 0.5;
        low_ = scaled(*low) - margin;
        high_ = scaled(*high) + margin;
    }

    double operator()(double value) const
    {
        return from_ + (scaled(value) - low_) / (high_ - low_) * (to_ - from_);
    }

    /// 1, 2 and 5 times powers of ten, or about six at equal distances of this kind.
    std::vector<double> ticks() const
    {
        std::vector<double> all;
        for (double power = std::floor(low_); isLog_ && power <= high_; ++power)
        {
            for (const double digit : {1.0, 2.0, 5.0})
            {
                all.push_back(digit * std::pow(10.0, power));
            }
        }
        const double raw = (high_ - low_) / 6.0;
        const double power = std::pow(10.0, std::floor(std::log10(raw)));
        const double step = power * (raw <= power ? 1.0 : raw <= 2.0 * power ? 2.0 : raw <= 5.0 * power ? 5.0 : 10.0);
        for (double i = std::ceil(low_ / step); !isLog_ && (i - 1e-9) * step <= high_; ++i)
        {
            all.push_back(i * step + 0.0); // no -0
        }
        return all;
    }

private:
    double scaled(double value) const
    {
        return isLog_ ? std::log10(value) : value;
    }

    double low_ = 0.0; // of the logarithm, if it is logarithmic
    double high_ = 1.0;
    double from_;
    double to_;
    bool isLog_ = false;
};

} // namespace

void Plot::line(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y, const std::string& style, const std::string& label)
{
    lines.push_back({x, y, style, label});
}

void Plot::dot(double value, double halfInterval, double y, const std::string& colour, const std::string& label)
{
    const Eigen::ArrayXd height = Eigen::ArrayXd::Constant(2, y);
    line(Eigen::Array2d(value - halfInterval, value + halfInterval), height, "stroke:" + colour, label);
    line(Eigen::Array2d(value, value), height, "stroke-linecap:round;stroke-width:5.6;stroke:" + colour);
}

std::string Plot::svg() const
{
    std::vector<double> xs;
    std::vector<double> ys;
    for (const auto& line : lines)
    {
        xs.insert(xs.end(), line.x.begin(), line.x.end());
        ys.insert(ys.end(), line.y.begin(), line.y.end());
    }
    const auto rowCount = static_cast<double>(rows.size());
    const bool hasRows = !rows.empty();
    std::size_t letters = 9;
    for (const auto& row : rows)
    {
        letters = std::max(letters, row.size());
    }
    const double left = 12.0 + perLetter * static_cast<double>(letters);
    const double bottom = hasRows ? top + 20.0 * rowCount : 238.0;
    const Axis x(xs, left, right, hasRows);
    const Axis y = hasRows ? Axis({0.0, rowCount}, top, bottom) : Axis(ys, bottom, top);

    std::ostringstream svg;
    svg << std::fixed << std::setprecision(1);
    const auto draw = [&](const std::string& look, double x1, double y1, double x2, double y2) {
        svg << "<line " << look << " x1=\"" << x1 << "\" y1=\"" << y1 << "\" x2=\"" << x2 << "\" y2=\"" << y2
            << "\"/>\n";
    };
    const auto write = [&](const std::string& look, double atX, double atY, const std::string& text) {
        svg << "<text class=" << look << " x=\"" << atX << "\" y=\"" << atY << "\">"
            << kainjow::mustache::html_escape(text) << "</text>\n";
    };
    const auto number = [](double value) { return formatted(value, std::defaultfloat, 3); };
    svg << "<svg viewBox=\"0 0 " << width << ' ' << bottom + (hasRows ? 20.0 : 42.0)
        << R"(" class="plot" role="img" aria-label=")" << kainjow::mustache::html_escape(title) << "\">\n";
    write("\"title\"", 4.0, 16.0, title);
    for (const double tick : x.ticks())
    {
        if (x(tick) >= left && x(tick) <= right)
        {
            draw("class=\"grid\"", x(tick), top, x(tick), bottom);
            write(R"("tick" text-anchor="middle")", x(tick), bottom + 14.0, number(tick));
        }
    }
    for (const double tick : hasRows ? std::vector<double>{} : y.ticks())
    {
        draw("class=\"grid\"", left, y(tick), right, y(tick));
        write(R"("tick" text-anchor="end")", left - 5.0, y(tick) + 3.0, number(tick));
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        write(R"("tick" text-anchor="end")", left - 6.0, y(static_cast<double>(i)) + 13.0, rows[i]);
    }
    std::set<std::string> labels = {""};
    double legend = 4.0;
    for (const auto& line : lines)
    {
        svg << R"(<polyline style=")" << line.style << R"(" points=")";
        for (Eigen::Index i = 0; i < line.x.size(); ++i)
        {
            if (std::isfinite(line.x(i)) && std::isfinite(line.y(i)))
            {
                svg << x(line.x(i)) << ',' << y(line.y(i)) << ' ';
            }
        }
        svg << "\"/>\n";
        if (labels.insert(line.label).second)
        {
            draw("style=\"" + line.style + ";stroke-width:3\"", legend, 29.0, legend + 16.0, 29.0);
            write("\"tick\"", legend + 20.0, 32.0, line.label);
            legend += 34.0 + perLetter * static_cast<double>(line.label.size());
        }
    }
    write(R"("label" text-anchor="middle")", (left + right) / 2.0, bottom + 34.0, xLabel);
    write("\"label\" text-anchor=\"middle\" transform=\"rotate(-90)\"", -(top + bottom) / 2.0, 13.0, yLabel);
    return svg.str() + "</svg>\n";
}

} // namespace clepsydra::identification
