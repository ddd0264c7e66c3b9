#include "report/planReport.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace clepsydra::identification
{

namespace
{

constexpr double apart = 2.0; // standard deviations below which two effects look alike

std::string percent(double share)
{
    std::ostringstream text;
    text << std::setprecision(2) << 100.0 * share << " %";
    return text.str();
}

std::string fixed(double value)
{
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << value;
    return std::isfinite(value) ? text.str() : "never";
}

} // namespace

void writePlan(const Study& study, const EffectLibrary& library, const Noise& noise, const Identifiability& table,
    std::ostream& out)
{
    out << "\nnoise of one run:";
    for (Eigen::Index f = 0; f < study.featureCount(); ++f)
    {
        out << ' ' << study.features[static_cast<std::size_t>(f)].name << ' '
            << textOf(std::round(1e4 * std::sqrt(noise.simulation.matrix(f, f))) / 1e4);
    }
    out << " (" << noise.simulation.nu << " degrees of freedom)\n"
        << "runs with the same seed go together by " << fixed(library.seedCorrelation) << " +- "
        << fixed(library.seedCorrelationError) << ": " << (library.commonSeeds ? "common" : "fresh")
        << " seeds in the design\n\n"
        << std::left << std::setw(24) << "effect" << std::right << std::setw(10) << "signal" << std::setw(12)
        << "hidden by" << std::setw(14) << "smallest\n"
        << std::left << std::setw(24) << "" << std::right << std::setw(10) << "[sd]" << std::setw(12) << "parameters"
        << std::setw(14) << "detectable\n";
    const auto shows = [&](std::size_t e) {
        return table.smallestDetectable(static_cast<Eigen::Index>(e)) <= study.effects[e].bounds.reach();
    };
    bool someShow = false;
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        const auto i = static_cast<Eigen::Index>(e);
        someShow = someShow || shows(e);
        out << std::left << std::setw(24) << study.effects[e].name << std::right << std::setw(10)
            << fixed(table.signal(i)) << std::setw(12) << percent(table.masked(i)) << std::setw(13)
            << (shows(e) ? fixed(table.smallestDetectable(i)) : "not in range") << '\n';
    }
    out << "(signal: what the parameters cannot imitate, at amplitude 1; smallest detectable: amplitude seen in 80 % "
           "of "
           "the cases)\n\n";
    const auto pairs = lookAlikes(table, apart);
    out << (!pairs.empty() ? "cannot be told apart by these conditions:\n"
            : someShow     ? "all effects that show can be told apart\n"
                           : "no effect shows at its full size\n");
    for (const auto& [i, j] : pairs)
    {
        out << "  " << study.effects[i].name << " and " << study.effects[j].name << '\n';
    }
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        if (!shows(e) && !study.effects[e].hint.empty())
        {
            out << "  to be measured by itself: " << study.effects[e].name << ": " << study.effects[e].hint << '\n';
        }
    }
    out << "collinearity index of all together: " << fixed(table.collinearityOfAll) << std::endl;
}

} // namespace clepsydra::identification
