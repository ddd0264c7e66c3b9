#include "report/svg.h"

#include "study/study.h"

#include <kainjow/mustache.hpp>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
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
    Axis(const Bounds& range, double from, double to, bool isLog = false)
        : range_(range),
          from_(from),
          to_(to),
          isLog_(isLog)
    {}

    double operator()(double value) const
    {
        return from_
               + (scaled(value) - scaled(range_.lower)) / (scaled(range_.upper) - scaled(range_.lower)) * (to_ - from_);
    }

    /// 1, 2 and 5 times powers of ten, or about six at equal distances of this kind.
    std::vector<double> ticks() const
    {
        const double raw = (range_.upper - range_.lower) / 6.0;
        double power = std::pow(10.0, std::floor(std::log10(isLog_ ? range_.lower : raw)));
        std::vector<double> all;
        if (isLog_)
        {
            for (; power <= range_.upper; power *= 10.0)
            {
                all.insert(all.end(), {power, 2.0 * power, 5.0 * power});
            }
        }
        else
        {
            const double step = power
                                * (raw <= power          ? 1.0
                                    : raw <= 2.0 * power ? 2.0
                                    : raw <= 5.0 * power ? 5.0
                                                         : 10.0);
            for (double i = std::ceil(range_.lower / step); i * step <= range_.upper; ++i)
            {
                all.push_back(i * step + 0.0); // no -0
            }
        }
        all.erase(std::remove_if(
                      all.begin(), all.end(), [&](double tick) { return tick < range_.lower || tick > range_.upper; }),
            all.end());
        return all;
    }

private:
    double scaled(double value) const
    {
        return isLog_ ? std::log10(value) : value;
    }

    Bounds range_;
    double from_;
    double to_;
    bool isLog_;
};

/// Range of finite values, which is never empty.
Bounds rangeOf(const std::vector<double>& values)
{
    Bounds range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const double value : values)
    {
        if (std::isfinite(value))
        {
            range = {std::min(range.lower, value), std::max(range.upper, value)};
        }
    }
    const double middle = std::isfinite(range.lower) ? range.lower : 0.0;
    return range.upper > range.lower ? range : Bounds{middle - 0.5, middle + 0.5};
}

/// The x axis: logarithmic, if that is allowed and the values are positive and far apart.
Axis axisOf(const std::vector<double>& values, double from, double to, bool mayBeLog)
{
    constexpr double farApart = 5.0;
    constexpr double margin = 0.03;
    const Bounds range = rangeOf(values);
    if (mayBeLog && range.lower > 0.0 && range.upper > farApart * range.lower)
    {
        const double factor = std::pow(range.upper / range.lower, margin);
        return {{range.lower / factor, range.upper * factor}, from, to, true};
    }
    const double more = mayBeLog ? margin * (range.upper - range.lower) : 0.0;
    return {{range.lower - more, range.upper + more}, from, to};
}

/// Elements of a picture.
struct Picture
{
    Picture()
    {
        text << std::fixed << std::setprecision(1);
    }

    void line(const std::string& look, double x1, double y1, double x2, double y2)
    {
        text << "<line " << look << " x1=\"" << x1 << "\" y1=\"" << y1 << "\" x2=\"" << x2 << "\" y2=\"" << y2
             << "\"/>\n";
    }
    void words(const std::string& look, double x, double y, const std::string& said)
    {
        text << "<text class=" << look << " x=\"" << x << "\" y=\"" << y << "\">"
             << kainjow::mustache::html_escape(said) << "</text>\n";
    }
    void tick(const std::string& anchor, double x, double y, double value)
    {
        std::ostringstream said;
        said << std::setprecision(3) << value;
        words("\"tick\" text-anchor=\"" + anchor + '"', x, y, said.str());
    }

    std::ostringstream text;
};

} // namespace

Plot::Plot(std::string title, std::string xLabel, std::string yLabel, std::vector<std::string> rows)
    : title_(std::move(title)),
      xLabel_(std::move(xLabel)),
      yLabel_(std::move(yLabel)),
      rows_(std::move(rows))
{}

void Plot::line(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y, const std::string& style, const std::string& label)
{
    lines_.push_back({x, y, style, label});
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
    for (const auto& line : lines_)
    {
        xs.insert(xs.end(), line.x.begin(), line.x.end());
        ys.insert(ys.end(), line.y.begin(), line.y.end());
    }
    const auto rowCount = static_cast<double>(rows_.size());
    const bool hasRows = !rows_.empty();
    std::size_t letters = 9;
    for (const auto& row : rows_)
    {
        letters = std::max(letters, row.size());
    }
    const double left = 12.0 + perLetter * static_cast<double>(letters);
    const double bottom = hasRows ? top + 20.0 * rowCount : 238.0;
    const Axis x = axisOf(xs, left, right, hasRows);
    const Axis y = hasRows ? Axis({0.0, rowCount}, top, bottom) : axisOf(ys, bottom, top, false);

    Picture picture;
    picture.text << "<svg viewBox=\"0 0 " << width << ' ' << bottom + (hasRows ? 20.0 : 42.0)
                 << R"(" class="plot" role="img" aria-label=")" << kainjow::mustache::html_escape(title_) << "\">\n";
    picture.words("\"title\"", 4.0, 16.0, title_);
    for (const double tick : x.ticks())
    {
        picture.line("class=\"grid\"", x(tick), top, x(tick), bottom);
        picture.tick("middle", x(tick), bottom + 14.0, tick);
    }
    for (const double tick : hasRows ? std::vector<double>{} : y.ticks())
    {
        picture.line("class=\"grid\"", left, y(tick), right, y(tick));
        picture.tick("end", left - 5.0, y(tick) + 3.0, tick);
    }
    for (std::size_t i = 0; i < rows_.size(); ++i)
    {
        picture.words(R"("tick" text-anchor="end")", left - 6.0, y(static_cast<double>(i)) + 13.0, rows_[i]);
    }
    std::set<std::string> labels = {""};
    double legend = 4.0;
    for (const auto& line : lines_)
    {
        picture.text << R"(<polyline style=")" << line.style << R"(" points=")";
        for (Eigen::Index i = 0; i < line.x.size(); ++i)
        {
            if (std::isfinite(line.x(i)) && std::isfinite(line.y(i)))
            {
                picture.text << x(line.x(i)) << ',' << y(line.y(i)) << ' ';
            }
        }
        picture.text << "\"/>\n";
        if (labels.insert(line.label).second)
        {
            picture.line("style=\"" + line.style + ";stroke-width:3\"", legend, 29.0, legend + 16.0, 29.0);
            picture.words("\"tick\"", legend + 20.0, 32.0, line.label);
            legend += 34.0 + perLetter * static_cast<double>(line.label.size());
        }
    }
    picture.words(R"("label" text-anchor="middle")", (left + right) / 2.0, bottom + 34.0, xLabel_);
    picture.words("\"label\" text-anchor=\"middle\" transform=\"rotate(-90)\"", -(top + bottom) / 2.0, 13.0, yLabel_);
    return picture.text.str() + "</svg>\n";
}

} // namespace clepsydra::identification
