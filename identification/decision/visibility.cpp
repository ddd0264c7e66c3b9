#include "decision/calibration.h"

#include <limits>

namespace clepsydra::identification
{

namespace
{

constexpr int draws = 40; // at each amplitude
constexpr double usual = 0.8;
constexpr double mostly = 0.5;

/// The smallest amplitude at which the share `usual` is reached, interpolated linearly. \param shares  by amplitude
double reached(const std::vector<std::pair<double, double>>& shares)
{
    double before = 0.0;
    double shareBefore = 0.0;
    for (const auto& [amplitude, share] : shares)
    {
        if (share >= usual)
        {
            return before + (amplitude - before) * (usual - shareBefore) / (share - shareBefore);
        }
        before = amplitude;
        shareBefore = share;
    }
    return std::numeric_limits<double>::infinity();
}

} // namespace

Visibility visibility(const Study& study, const Evidence& evidence, Replicas& replicas, const Calibration& calibration,
    std::mt19937_64& random)
{
    const Eigen::Index count = study.effects.size();
    Visibility found{Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::VectorXd::Zero(count), {}};
    for (std::size_t e = 0; e < study.effects.size(); ++e)
    {
        std::vector<std::pair<double, double>> detected;
        std::vector<std::pair<double, double>> named;
        double seen = 0.0;      // number of draws in which the effect at the last amplitude is detected
        Eigen::VectorXd beside; // number of these whose set contains an effect
        for (const double amplitude : evidence.amplitudes(e))
        {
            if (amplitude <= 0.0)
            {
                continue;
            }
            seen = 0.0;
            beside = Eigen::VectorXd::Zero(count);
            double right = 0.0;
            for (int draw = 0; draw < draws; ++draw)
            {
                const auto [data, judge] = replicas.draw({{e, amplitude}}, fromPrior(study, random), random);
                const Odds odds = oddsOf(study, judge(data));
                if (!isDetected(study, calibration, odds))
                {
                    continue;
                }
                const auto sole = soleMember(study, calibration, odds);
                const bool isRight =
                    sole && shareName(study, *sole, e) && marginOf(study, odds, *sole) >= calibration.naming(*sole);
                seen += 1.0;
                right += isRight ? 1.0 : 0.0;
                for (const auto member : membersOf(calibration, odds))
                {
                    beside(member) += 1.0;
                }
            }
            detected.emplace_back(amplitude, seen / draws);
            named.emplace_back(amplitude, right / draws);
            found.atFullSize(e) = right / draws;
        }
        found.detected(e) = reached(detected);
        found.named(e) = reached(named);
        for (Eigen::Index other = 0; other < beside.size(); ++other)
        {
            if (static_cast<std::size_t>(other) != e && beside(other) > mostly * seen)
            {
                found.alike.emplace_back(e, other);
            }
        }
    }
    return found;
}

} // namespace clepsydra::identification
