#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace clepsydra::identification
{

/// A plot of lines, bands, and values with intervals, as inline SVG.
struct Plot
{
    /// \param style  CSS; a line that is filled closes itself
    /// \param label  entry of the legend, which shows equal entries once; empty for none
    void line(
        const Eigen::ArrayXd& x, const Eigen::ArrayXd& y, const std::string& style, const std::string& label = "");
    /// A value in a row, with its interval. \param y  0 is the upper edge of the first row, 1 that of the second
    void dot(double value, double halfInterval, double y, const std::string& colour, const std::string& label);

    std::string svg() const;

    struct Line
    {
        Eigen::ArrayXd x;
        Eigen::ArrayXd y;
        std::string style;
        std::string label;
    };
    std::string title;
    std::string xLabel = {};
    std::string yLabel = {};
    /// Names, from top to bottom, of rows instead of numbers at the y axis. The x axis is then logarithmic where the
    /// values are far apart.
    std::vector<std::string> rows = {};
    std::vector<Line> lines = {};
};

} // namespace clepsydra::identification
