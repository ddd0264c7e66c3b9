#pragma once

#include <string>
#include <utility>
#include <vector>

namespace clepsydra::identification
{

/// A plot of curves and bands as inline SVG.
class Plot
{
public:
    Plot(std::string title, std::string xLabel, std::string yLabel);

    void line(const std::vector<double>& x, const std::vector<double>& y, const std::string& style,
        const std::string& label = "");
    void band(const std::vector<double>& x, const std::vector<double>& lower, const std::vector<double>& upper,
        const std::string& style);

    std::string svg() const;

private:
    struct Shape
    {
        std::vector<double> x;
        std::vector<double> y;
        std::string style;
        std::string label;
        bool closed;
    };
    std::string title_;
    std::string xLabel_;
    std::string yLabel_;
    std::vector<Shape> shapes_;
};

/// A value with the half width of its interval; NaN where there is none.
struct Dot
{
    double value;
    double error;
};

/// Rows of dots with intervals, one dot for each series. The axis is logarithmic where the values are far apart.
struct DotChart
{
    std::string title;
    std::vector<std::pair<std::string, std::string>> series; // label and colour
    std::vector<std::pair<std::string, std::vector<Dot>>> rows;

    std::string svg() const;
};

/// One bar of a chart.
struct Bar
{
    std::string label;
    double value;
    double error; // half width of the interval; 0: none
    std::string style;
};

/// Horizontal bars with intervals; values may be negative.
std::string barChart(const std::string& title, const std::vector<Bar>& bars, const std::string& unit);

/// Text with <, > and & escaped for HTML.
std::string escaped(const std::string& text);

} // namespace clepsydra::identification
