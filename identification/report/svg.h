#pragma once

#include <string>
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
