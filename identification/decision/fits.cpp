#include "decision/evidence.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

/// Mean, standard deviation and 95 % interval of a distribution over equidistant amplitudes. The cumulative
/// distribution is interpolated linearly.
Fit marginal(const Eigen::VectorXd& amplitudes, const Eigen::ArrayXd& share, const Effect& effect)
{
    constexpr double tail = 0.025;
    const auto& a = amplitudes.array();
    const double half = a.size() > 1 ? (a(1) - a(0)) / 2.0 : 0.0;
    Fit fit;
    fit.amplitude = (share * a).sum();
    fit.sd = std::sqrt(std::max(0.0, (share * (a - fit.amplitude).square()).sum()));
    const auto quantile = [&](double level) {
        double below = 0.0;
        for (Eigen::Index i = 0; i < a.size(); ++i)
        {
            if (below + share(i) >= level)
            {
                return a(i) - half + 2.0 * half * (level - below) / share(i);
            }
            below += share(i);
        }
        return a(a.size() - 1) + half;
    };
    fit.lower = quantile(tail);
    fit.upper = quantile(1.0 - tail);
    Eigen::Index likeliest = 0;
    share.maxCoeff(&likeliest);
    fit.isAtEnd =
        !effect.isSwitch
        && (a(likeliest) - 2.0 * half < effect.bounds.lower || a(likeliest) + 2.0 * half > effect.bounds.upper);
    return fit;
}

} // namespace

std::vector<double> Evidence::amplitudes(std::size_t effect) const
{
    if (effects_[effect].nodes.empty())
    {
        return {};
    }
    const Grid grid(study_.effects[effect]);
    return {grid.amplitudes.begin(), grid.amplitudes.end()};
}

Fit Evidence::fitNull(const Measured& measured) const
{
    Fit fit;
    fitParameters(null_, measured, fit);
    return fit;
}

/// Fills in all members of a fit except those of the amplitude.
void Evidence::fitParameters(const Node& node, const Measured& measured, Fit& fit) const
{
    const Solution solution = solve(node, spreadOf(node, measured).factor, measured);
    fit.parameters = solution.parameters;
    fit.covariance = solution.parameters.size() > 0 ? Eigen::MatrixXd(solution.precision.inverse()) : Eigen::MatrixXd();
    fit.marginal = fit.covariance;
    fit.chiSquare = solution.chiSquare;
}

Fit Evidence::fit(std::size_t effect, const Measured& measured) const
{
    return effects_[effect].nodes.empty() ? Fit{} : fits(effects_[effect], measured).front();
}

Fit Evidence::fitAlone(std::size_t effect, const Measured& measured) const
{
    Explanation explanation = effects_[effect];
    explanation.usesMeasurements = false;
    return explanation.nodes.empty() ? Fit{} : fits(explanation, measured).front();
}

std::vector<Fit> Evidence::fits(const Explanation& explanation, const Measured& measured) const
{
    const AtNodes nodes = atNodes(explanation, measured, spreadOf(null_, measured));
    const Posterior found = posterior(explanation, nodes);
    const Eigen::ArrayXXd share = (found.logs.array() - found.judgement.logEvidence).exp();
    std::vector<Fit> all;
    std::vector<Present> present;
    for (std::size_t k = 0; k < explanation.effects.size(); ++k)
    {
        all.push_back(marginal(found.axes[k].amplitudes,
            k == 0 ? Eigen::ArrayXd(share.rowwise().sum()) : Eigen::ArrayXd(share.colwise().sum()),
            study_.effects[explanation.effects[k]]));
        present.push_back({explanation.effects[k], all.back().amplitude});
    }
    // Deviation of the parameters at each amplitude from their posterior mean.
    Eigen::MatrixXd moves(nodes.parameters.rows(), share.size());
    for (Eigen::Index p = 0; p < moves.rows(); ++p)
    {
        const Eigen::MatrixXd there =
            found.interpolated(nodes.parameters.row(p).reshaped(nodes.chiSquares.rows(), nodes.chiSquares.cols()));
        moves.row(p) = (there.array() - (share * there.array()).sum()).reshaped().transpose();
    }
    const Eigen::MatrixXd weighted = moves * share.reshaped().matrix().asDiagonal();
    const Node node = nodeAt(present);
    for (auto& fit : all)
    {
        fitParameters(node, measured, fit);
        fit.marginal += weighted * moves.transpose();
    }
    return all;
}

} // namespace clepsydra::identification
