#include "nextRuns/chooseRuns.h"

#include "emulator/settings.h"
#include "lists.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <optional>

namespace clepsydra::identification
{

namespace
{

/// Share of the emulator's variance in the variance of the measurements above which a run is made.
constexpr double worthARun = 0.01;

/// Predictions of the contenders in one condition.
class Expectation
{
public:
    Expectation(const Emulator& emulator, const Layout::Block& block, const std::vector<Contender>& contenders)
        : contenders_(contenders)
    {
        const ConditionEmulator& here = *emulator[block.condition];
        const auto& places = block.places;
        for (const auto& contender : contenders)
        {
            means_.emplace_back(here.at(contender.parameters, contender.present)(places));
            unknown_.emplace_back(here.uncertainty(contender.parameters, contender.present)(places, places));
            runs_.emplace_back(here.noiseOf(contender.present)(places, places));
            data_.emplace_back(block.ofOne(here, contender.present).cwiseProduct(block.meanShare) + block.unshown());
        }
        differences_ = unknown_;
    }

    /// Increase of the divergence from the other contenders by one run of each contender.
    std::vector<double> gains() const
    {
        std::vector<double> gains(contenders_.size());
        for (std::size_t i = 0; i < gains.size(); ++i)
        {
            const Eigen::MatrixXd after = afterRun(i);
            for (std::size_t j = 0; j < gains.size(); ++j)
            {
                if (j != i)
                {
                    gains[i] += contenders_[i].weight * contenders_[j].weight
                                * (divergence(i, j, after) - divergence(i, j, unknown_[i]));
                }
            }
        }
        return gains;
    }

    /// Variance of the emulator's error for a contender divided by that of the measurements, averaged over the
    /// features.
    double openShare(std::size_t i) const
    {
        return data_[i].llt().solve(unknown_[i]).trace() / static_cast<double>(data_[i].rows());
    }

    /// Squared distance of some features from those of a contender in units of the measurements' errors, averaged over
    /// the features.
    double distance(std::size_t i, const Eigen::VectorXd& mean) const
    {
        const Eigen::VectorXd apart = mean - means_[i];
        return apart.dot(data_[i].llt().solve(apart)) / static_cast<double>(apart.size());
    }

    void run(std::size_t i)
    {
        unknown_[i] = afterRun(i);
    }

private:
    Eigen::MatrixXd afterRun(std::size_t i) const
    {
        return unknown_[i] - unknown_[i] * (unknown_[i] + runs_[i]).llt().solve(unknown_[i]);
    }

    /// Expected divergence of data of contender i from contender j. The uncertainty of the difference of their means is
    /// the initial one.
    double divergence(std::size_t i, std::size_t j, const Eigen::MatrixXd& unknown) const
    {
        const Eigen::VectorXd difference = means_[i] - means_[j];
        const Eigen::MatrixXd moment = difference * difference.transpose() + differences_[i] + differences_[j];
        return (data_[i] + unknown + unknown_[j]).llt().solve(moment).trace();
    }

    const std::vector<Contender>& contenders_;
    std::vector<Eigen::VectorXd> means_;
    std::vector<Eigen::MatrixXd> unknown_;     // covariance of the emulator's error after the chosen runs
    std::vector<Eigen::MatrixXd> differences_; // covariance of the emulator's error at first
    std::vector<Eigen::MatrixXd> runs_;        // noise covariance of one run
    std::vector<Eigen::MatrixXd> data_;        // covariance of the mean of the measurements
};

/// The effects of a contender with the amplitudes of a run (those of the measuring chain with the contender's own);
/// empty if the run has other effects.
std::optional<std::vector<Present>> simulatedAs(
    const std::vector<Present>& present, const ConditionEmulator& here, const Setting& setting)
{
    std::vector<Present> own = present;
    Eigen::VectorXd others = setting.amplitudes;
    for (auto& one : own)
    {
        const Eigen::Index effect = one.effect;
        if (here.basis.placeOf(one.effect) < here.basis.effects.size())
        {
            one.amplitude = setting.amplitudes(effect);
            if (one.amplitude == 0.0)
            {
                return std::nullopt;
            }
        }
        others(effect) = 0.0;
    }
    return others.isZero() ? std::optional(own) : std::nullopt;
}

} // namespace

std::vector<WantedRun> chooseRuns(
    const Emulator& emulator, const Layout& layout, const std::vector<Contender>& contenders, int count)
{
    auto conditions =
        mapped(layout.blocks, [&](const Layout::Block& block) { return Expectation(emulator, block, contenders); });
    auto gains = mapped(conditions, [](const Expectation& expectation) { return expectation.gains(); });
    std::vector<WantedRun> chosen;
    for (int k = 0; k < count; ++k)
    {
        WantedRun best{0, 0};
        std::size_t where = 0;
        double most = -1.0;
        for (std::size_t b = 0; b < conditions.size(); ++b)
        {
            const auto top = std::max_element(gains[b].begin(), gains[b].end());
            if (*top > most)
            {
                most = *top;
                where = b;
                best = {static_cast<std::size_t>(top - gains[b].begin()), layout.blocks[b].condition};
            }
        }
        chosen.push_back(best);
        conditions[where].run(best.contender);
        gains[where] = conditions[where].gains();
    }
    return chosen;
}

std::vector<WantedRun> openRuns(const Study& study, const Emulator& emulator, const Layout& layout,
    const std::vector<Contender>& contenders, const std::vector<Simulation>& runs)
{
    std::vector<WantedRun> wanted;
    for (const auto& block : layout.blocks)
    {
        const Expectation expectation(emulator, block, contenders);
        const auto good = goodRuns(runs, block.condition);
        const ConditionEmulator& here = *emulator[block.condition];
        for (std::size_t i = 0; i < contenders.size(); ++i)
        {
            const auto isNear = [&](const Simulation* run) {
                const auto own = simulatedAs(contenders[i].present, here, run->setting);
                return own
                       && expectation.distance(i, here.at(inSds(study, run->setting.parameters), *own)(block.places))
                              < 1.0;
            };
            if (expectation.openShare(i) > worthARun || std::none_of(good.begin(), good.end(), isNear))
            {
                wanted.push_back({i, block.condition});
            }
        }
    }
    return wanted;
}

} // namespace clepsydra::identification
