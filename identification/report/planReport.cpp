#include "report/report.h"

#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <vector>

namespace clepsydra::identification
{

namespace
{

std::string amplitude(double value, const Effect& effect)
{
    return std::isfinite(value) && value <= effect.bounds.reach() ? formatted(value, std::fixed, 2) : "not in range";
}

/// Residual that effects leave when the parameters are fitted without them: root mean square over conditions and over
/// the features that are logarithms. \param planned  data whose means are replaced
double residualSize(const Study& study, const Emulator& emulator, const Layout& layout, Measured planned,
    const Evidence& evidence, const std::vector<Present>& present)
{
    planned.mean = meanAt(emulator, layout, present, Eigen::VectorXd::Zero(study.parameters.size()));
    const Eigen::VectorXd left = planned.mean - meanAt(emulator, layout, {}, evidence.fitNull(planned).parameters);
    double squares = 0.0;
    double count = 0.0;
    for (const auto& block : layout.blocks)
    {
        for (Eigen::Index k = 0; k < block.size(); ++k)
        {
            if (study.features[emulator[block.condition]->features[block.places[k]]].kind->isLog())
            {
                squares += left(block.first + k) * left(block.first + k);
                count += 1.0;
            }
        }
    }
    return std::sqrt(squares / count);
}

std::string percentOf(double share)
{
    return std::isfinite(share) ? rounded(100.0 * share) + " %" : "-";
}

} // namespace

void writePlan(const Study& study, const Emulator& emulator, const Layout& layout, const Measured& planned,
    const Evidence& evidence, const Calibration& calibration, const Visibility& visibility, std::ostream& out)
{
    std::vector<double> sizes; // residuals at which the effects are named
    std::ostringstream table;
    bool someShow = false;
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        const Effect& effect = study.effects[e];
        const double named = visibility.named(e);
        const double size = std::isfinite(named)
                                ? residualSize(study, emulator, layout, planned, evidence, {{e, named}})
                                : std::numeric_limits<double>::quiet_NaN();
        if (std::isfinite(size))
        {
            sizes.push_back(size);
        }
        someShow = someShow || std::isfinite(visibility.detected(e));
        table << std::left << std::setw(24) << effect.name << std::right << std::setw(14)
              << (emulator.knows(e) ? amplitude(visibility.detected(e), effect) : "runs failed") << std::setw(14)
              << amplitude(named, effect) << std::setw(16) << percentOf(size) << std::setw(17)
              << std::lround(100.0 * visibility.atFullSize(e)) << " %\n";
    }
    std::sort(sizes.begin(), sizes.end());
    out << '\n';
    if (sizes.empty())
    {
        out << "Such data name no single effect within its range.\n";
    }
    else
    {
        out << "An effect is named if its residual is at least " << percentOf(sizes.front())
            << (sizes.size() > 1 ? " to " + percentOf(sizes.back()) + ", depending on the effect" : "")
            << " (root mean square over\nconditions, with the parameters fitted without the effect).\n";
    }
    out << "Noise of one measurement:";
    for (Eigen::Index f = 0; f < study.featureCount(); ++f)
    {
        out << ' ' << study.features[f].name << ' ' << rounded(std::sqrt(layout.noise(f, f)));
    }
    out << " (" << layout.noiseFreedom << " degrees of freedom)\n\n"
        << std::left << std::setw(24) << "effect" << std::right << std::setw(14) << "detected from" << std::setw(14)
        << "named from" << std::setw(16) << "its residual" << std::setw(20) << "named at full size\n"
        << table.str()
        << "In 80 % of such data sets, an effect of this size is detected, or named correctly. Size 1 is the end of "
           "the "
           "effect's range.\nThe runs at the fits, which come later, improve both.\n\n"
        << (!visibility.alike.empty() ? "These conditions cannot distinguish, even at full size:\n"
               : someShow             ? "All detectable effects can be distinguished.\n"
                                      : "No effect is detectable at its full size.\n");
    for (const auto& [i, j] : visibility.alike)
    {
        out << "  " << study.effects[i].name << " from " << study.effects[j].name << '\n';
    }
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        if (!std::isfinite(visibility.named(e)) && !study.effects[e].hint.empty())
        {
            out << "  measure " << study.effects[e].name << " independently: " << study.effects[e].hint << '\n';
        }
    }
    out << "A cause that the library does not list is given a wrong name in " << rounded(100.0 * calibration.wrongNames)
        << " % of the cases (each effect left out in turn, and patterns of any shape)." << std::endl;
}

} // namespace clepsydra::identification
