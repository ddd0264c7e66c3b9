#include "report/planReport.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace clepsydra::identification
{

namespace
{

std::string amplitude(double value, const Effect& effect)
{
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << value;
    return std::isfinite(value) && value <= effect.bounds.reach() ? text.str() : "not in range";
}

} // namespace

void writePlan(const Study& study, const Emulator& emulator, const Layout& layout, const Calibration& calibration,
    const Visibility& visibility, std::ostream& out)
{
    out << "\nnoise of one measurement:";
    for (Eigen::Index f = 0; f < study.featureCount(); ++f)
    {
        out << ' ' << study.features[static_cast<std::size_t>(f)].name << ' '
            << textOf(std::round(1e4 * std::sqrt(layout.noise(f, f))) / 1e4);
    }
    out << " (" << layout.noiseFreedom << " degrees of freedom)\n\n"
        << std::left << std::setw(24) << "effect" << std::right << std::setw(14) << "seen from" << std::setw(14)
        << "named from" << std::setw(22) << "named at full size\n";
    bool someShow = false;
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        const auto i = static_cast<Eigen::Index>(e);
        const Effect& effect = study.effects[e];
        someShow = someShow || std::isfinite(visibility.detected(i));
        out << std::left << std::setw(24) << effect.name << std::right << std::setw(14)
            << (emulator.knows(e) ? amplitude(visibility.detected(i), effect) : "its runs failed") << std::setw(14)
            << amplitude(visibility.named(i), effect) << std::setw(19)
            << std::lround(100.0 * visibility.atFullSize(i)) << " %\n";
    }
    out << "(amplitudes at which 80 % of such data sets show that there is something, and get the right name; before the "
           "runs at\nthe fits, which sharpen both)\n\n";
    out << (!visibility.alike.empty() ? "not told apart by these conditions, even at full size:\n"
            : someShow                ? "all effects that show can be told apart\n"
                                      : "no effect shows at its full size\n");
    for (const auto& [i, j] : visibility.alike)
    {
        out << "  " << study.effects[i].name << " from " << study.effects[j].name << '\n';
    }
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        if (!std::isfinite(visibility.named(static_cast<Eigen::Index>(e))) && !study.effects[e].hint.empty())
        {
            out << "  to be measured by itself: " << study.effects[e].name << ": " << study.effects[e].hint << '\n';
        }
    }
    out << "something that is not in the library would get a wrong name in " << std::lround(1000.0 * calibration.wrongNames) / 10.0
        << " % of the cases (each effect left out in turn, and patterns of any shape)" << std::endl;
}

} // namespace clepsydra::identification
