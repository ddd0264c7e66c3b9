#include "features/features.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clepsydra::identification
{

namespace
{

using Parameters = FeatureKind::Parameters;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double logOfPositive(double value)
{
    return value > 0.0 ? std::log(value) : none;
}

//--- Discharged masses ----------------------------------------------------------------------------------------------

double logMeanRate(const Curve& curve, const Parameters& p)
{
    const double fill = curve.value.front();
    const double start = timeAtLevel(curve, p.at("from") * fill);
    const double end = timeAtLevel(curve, p.at("to") * fill);
    return logOfPositive((p.at("from") - p.at("to")) * fill / (end - start));
}

/// Slope of the least-squares line between two times; NaN with fewer than three points.
double slopeBetween(const Curve& curve, double from, double to)
{
    const auto begin = std::lower_bound(curve.time.begin(), curve.time.end(), from);
    const auto end = std::upper_bound(begin, curve.time.end(), to);
    const Eigen::Index count = end - begin;
    if (count < 3)
    {
        return none;
    }
    const std::size_t first = begin - curve.time.begin();
    const Eigen::Map<const Eigen::ArrayXd> time(&curve.time[first], count);
    const Eigen::Map<const Eigen::VectorXd> value(&curve.value[first], count);
    Eigen::MatrixXd line(count, 2);
    line.col(0).setOnes();
    line.col(1) = (time - (from + to) / 2) / ((to - from) / 2);
    return line.colPivHouseholderQr().solve(value)(1) / ((to - from) / 2);
}

//--- Positions of a particle ----------------------------------------------------------------------------------------

double logSpeed(const Curve& curve, const Parameters& p)
{
    const double start = timeAtLevel(curve, p.at("from"));
    const double end = timeAtLevel(curve, p.at("to"));
    return start < end ? logOfPositive(std::abs(slopeBetween(curve, start, end))) : none;
}

/// Time at which a position is reached; NaN if the two rows around it are farther apart than `gap`.
double timeAtSeenLevel(const Curve& curve, double level, double gap)
{
    const double time = timeAtLevel(curve, level);
    const auto after = std::lower_bound(curve.time.begin(), curve.time.end(), time) - curve.time.begin();
    if (!std::isfinite(time) || after == 0)
    {
        return time;
    }
    // By rounding, the interpolated time may lie behind the last one.
    const std::size_t i = std::min(static_cast<std::size_t>(after), curve.value.size() - 1);
    return std::abs(curve.value[i] - curve.value[i - 1]) > gap ? none : time;
}

/// Mean speed from the times at the two positions alone. If a track has gaps and the speed changes, a fit would give
/// the speed of the visible part.
double logMeanSpeed(const Curve& curve, const Parameters& p)
{
    const double start = timeAtSeenLevel(curve, p.at("from"), p.at("gap"));
    const double end = timeAtSeenLevel(curve, p.at("to"), p.at("gap"));
    return logOfPositive(std::abs(p.at("to") - p.at("from")) / (end - start));
}

/// Rows of all contacts. A contact is a minimum of the gap between two maxima; the curve is not smoothed.
std::vector<std::size_t> contacts(const Curve& curve, double level)
{
    std::vector<std::size_t> found;
    const auto& gap = curve.value;
    for (std::size_t i = 1; i + 1 < gap.size(); ++i)
    {
        if (gap[i] > level || gap[i] > gap[i - 1])
        {
            continue;
        }
        std::size_t after = i;
        while (after + 1 < gap.size() && gap[after + 1] == gap[i])
        {
            ++after;
        }
        if (after + 1 < gap.size() && gap[after + 1] > gap[i])
        {
            // Two minima without a rise of the gap between them belong to one contact.
            const bool same =
                !found.empty() && *std::max_element(gap.begin() + found.back(), gap.begin() + i) < 2.0 * level;
            if (!same)
            {
                found.push_back(i);
            }
        }
        i = after;
    }
    return found;
}

/// The largest gap between a contact and the next one, or the end of the curve.
double logBounceHeight(const Curve& curve, const Parameters& p)
{
    const auto hits = contacts(curve, p.at("level"));
    const auto n = static_cast<std::size_t>(p.at("bounce"));
    if (n < 1 || hits.size() < n)
    {
        return none;
    }
    const bool isComplete = hits.size() > n;
    const auto& gap = curve.value;
    const auto top = std::max_element(gap.begin() + hits[n - 1], isComplete ? gap.begin() + hits[n] + 1 : gap.end());
    // If the record ends during the rise, the height is unknown.
    return !isComplete && top == gap.end() - 1 ? none : logOfPositive(*top);
}

double logBounceDuration(const Curve& curve, const Parameters& p)
{
    const auto hits = contacts(curve, p.at("level"));
    const auto n = static_cast<std::size_t>(p.at("bounce"));
    return n >= 1 && hits.size() > n ? logOfPositive(curve.time[hits[n]] - curve.time[hits[n - 1]]) : none;
}

/// Time of the first contact; NaN if there is none.
double timeOfImpact(const Curve& curve, double level)
{
    const auto hits = contacts(curve, level);
    return hits.empty() ? none : curve.time[hits.front()];
}

double logImpactSpeed(const Curve& curve, const Parameters& p)
{
    const double hit = timeOfImpact(curve, p.at("level"));
    return logOfPositive(-slopeBetween(curve, hit - p.at("before"), hit - p.at("until")));
}

double logReboundSpeed(const Curve& curve, const Parameters& p)
{
    const double hit = timeOfImpact(curve, p.at("level"));
    return logOfPositive(slopeBetween(curve, hit + p.at("from"), hit + p.at("after")));
}

//--- Any curve ------------------------------------------------------------------------------------------------------

/// The rows of a curve from one to before another.
Curve rows(const Curve& curve, std::size_t begin, std::size_t end)
{
    return {{curve.time.begin() + begin, curve.time.begin() + end},
        {curve.value.begin() + begin, curve.value.begin() + end}};
}

/// Time at which the curve passes a share of its largest value, before or after the maximum; NaN if it does not.
double timeAtShare(const Curve& curve, double share, bool after)
{
    const auto top = std::max_element(curve.value.begin(), curve.value.end()) - curve.value.begin();
    return timeAtLevel(
        after ? rows(curve, top, curve.value.size()) : rows(curve, 0, top + 1), share * curve.value[top]);
}

/// The part of a curve that begins some seconds after its first row.
Curve after(double seconds, const Curve& curve)
{
    const double start = curve.time.front() + seconds;
    const auto begin = std::lower_bound(curve.time.begin(), curve.time.end(), start) - curve.time.begin();
    return rows(curve, begin, curve.time.size());
}

/// Mean over time of a function of the value, which is linear between the rows.
template<class Function>
double timeMean(const Curve& curve, const Function& of)
{
    double sum = 0.0;
    for (std::size_t i = 1; i < curve.time.size(); ++i)
    {
        sum += (curve.time[i] - curve.time[i - 1]) * (of(curve.value[i]) + of(curve.value[i - 1])) / 2.0;
    }
    return curve.time.size() > 1 ? sum / (curve.time.back() - curve.time.front()) : none;
}

double logMean(const Curve& curve, const Parameters& p)
{
    return logOfPositive(timeMean(after(p.at("after"), curve), [](double value) { return value; }));
}

double logDeviation(const Curve& curve, const Parameters& p)
{
    const Curve part = after(p.at("after"), curve);
    const double mean = timeMean(part, [](double value) { return value; });
    return 0.5 * logOfPositive(timeMean(part, [&](double value) { return (value - mean) * (value - mean); }));
}

std::map<std::string, FeatureKind> makeKinds()
{
    const FeatureKind::Parameter from{"from", none, "larger share of the first value"};
    const FeatureKind::Parameter to{"to", none, "smaller share of the first value"};
    const FeatureKind::Parameter start{"from", none, "position where the part begins, SI units"};
    const FeatureKind::Parameter end{"to", none, "position where it ends"};
    const FeatureKind::Parameter level{"level", 5e-4, "gap below which a minimum is a contact, SI units"};
    const FeatureKind::Parameter bounce{"bounce", 1, "number of the contact, from 1"};
    const FeatureKind::Parameter after{"after", 0.0, "beginning of the part, after the first row [s]"};
    const FeatureKind::Parameter lowerShare{"from", none, "smaller share of the largest value"};
    const FeatureKind::Parameter upperShare{"to", none, "larger share of it"};
    const FeatureKind::Parameter upperFirst{"from", none, "larger share of the largest value"};
    const FeatureKind::Parameter lowerLast{"to", none, "smaller share of it"};
    const std::vector<FeatureKind> all = {
        {"logMeanRate", "log of the mean rate of loss between two shares of the first value", {from, to}, logMeanRate,
            Dimension::rate},
        {"logTimeToDischarge", "log of the time until a share has left", {{"share", 0.95, "of the first value"}},
            [](const Curve& curve, const Parameters& p) {
                return logOfPositive(
                    timeAtLevel(curve, (1.0 - p.at("share")) * curve.value.front()) - curve.time.front());
            },
            Dimension::time},
        {"residue", "last value over first value (not a log)", {},
            [](const Curve& curve, const Parameters& /*unused*/) { return curve.value.back() / curve.value.front(); },
            Dimension::share},
        {"logSpeed", "log of the speed between two positions, by least squares", {start, end}, logSpeed,
            Dimension::rate},
        {"logMeanSpeed", "log of the distance between two positions divided by the time between them",
            {start, end, {"gap", 1e30, "largest distance of the two rows around a position, SI units"}}, logMeanSpeed,
            Dimension::rate},
        {"logBounceHeight", "log of the largest gap after a contact", {bounce, level}, logBounceHeight,
            Dimension::value},
        {"logBounceDuration", "log of the time between a contact and the next", {bounce, level}, logBounceDuration,
            Dimension::time},
        {"logImpactSpeed", "log of the speed before the first contact",
            {level, {"before", none, "beginning of the fitted part, before the contact [s]"},
                {"until", none, "its end, before the contact [s]"}},
            logImpactSpeed, Dimension::rate},
        {"logReboundSpeed", "log of the speed after the first contact",
            {level, {"from", none, "beginning of the fitted part, after the contact [s]"},
                {"after", none, "its end, after the contact [s]"}},
            logReboundSpeed, Dimension::rate},
        {"logMaximum", "log of the largest value", {},
            [](const Curve& curve, const Parameters& /*unused*/) {
                return logOfPositive(*std::max_element(curve.value.begin(), curve.value.end()));
            },
            Dimension::value},
        {"logMean", "log of the mean over time", {after}, logMean, Dimension::value},
        {"logDeviation", "log of the standard deviation over time", {after}, logDeviation, Dimension::value},
        {"logRiseTime", "log of the time between two shares of the largest value, before it", {lowerShare, upperShare},
            [](const Curve& curve, const Parameters& p) {
                return logOfPositive(timeAtShare(curve, p.at("to"), false) - timeAtShare(curve, p.at("from"), false));
            },
            Dimension::time},
        {"logFallTime", "log of the time between two shares of the largest value, after it", {upperFirst, lowerLast},
            [](const Curve& curve, const Parameters& p) {
                return logOfPositive(timeAtShare(curve, p.at("to"), true) - timeAtShare(curve, p.at("from"), true));
            },
            Dimension::time},
        {"logTimeAbove", "log of the time between a share of the largest value before it and after it",
            {{"share", 0.5, "of the largest value"}},
            [](const Curve& curve, const Parameters& p) {
                return logOfPositive(
                    timeAtShare(curve, p.at("share"), true) - timeAtShare(curve, p.at("share"), false));
            },
            Dimension::time},
    };
    std::map<std::string, FeatureKind> byName;
    for (const auto& kind : all)
    {
        byName.emplace(kind.name, kind);
    }
    return byName;
}

} // namespace

const std::map<std::string, FeatureKind>& featureKinds()
{
    static const auto kinds = makeKinds();
    return kinds;
}

} // namespace clepsydra::identification
