#include "identifiability/identifiability.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clepsydra::identification
{

namespace
{

constexpr double normalQuantile80 = 0.8416;
constexpr double negligible = 1e-10;

} // namespace

Identifiability identifiability(
    const ResidualProblem& problem, const Noise& noise, const std::vector<Bounds>& bounds, double critical)
{
    const WhiteProblem white = whitened(problem, noise);
    const Fits fits(white);
    const Eigen::MatrixXd& left = fits.effectsLeft();
    const auto count = left.cols();
    const Eigen::ArrayXd whole = white.effects.colwise().squaredNorm();
    const Eigen::ArrayXd rest = left.colwise().squaredNorm();

    Identifiability table;
    table.masked = (whole > 0.0).select(1.0 - rest / whole, 1.0);
    table.signal = rest.sqrt();
    table.smallestDetectable.resize(count);
    table.separability.resize(count, count);
    table.collinearity.resize(count, count);
    for (Eigen::Index i = 0; i < count; ++i)
    {
        const double range = bounds[static_cast<std::size_t>(i)].upper;
        const double needed = (std::sqrt(critical) + normalQuantile80) / std::sqrt(rest(i));
        const bool seen = rest(i) > negligible * whole(i) && whole(i) > 0.0;
        table.smallestDetectable(i) = seen ? needed : std::numeric_limits<double>::infinity();
        for (Eigen::Index j = 0; j < count; ++j)
        {
            const double product = left.col(i).dot(left.col(j));
            const double norms = std::sqrt(rest(i) * rest(j));
            const double cosine = norms > 0.0 ? std::clamp(product / norms, -1.0, 1.0) : 0.0;
            // An amplitude that cannot be negative imitates nothing of the other sign.
            const double nearest =
                bounds[static_cast<std::size_t>(j)].lower < 0.0 ? std::abs(cosine) : std::max(cosine, 0.0);
            table.separability(i, j) = i == j ? 0.0 : range * std::sqrt(rest(i) * (1.0 - nearest * nearest));
            table.collinearity(i, j) = i == j ? 1.0 : 1.0 / std::sqrt(std::max(1.0 - std::abs(cosine), 1e-12));
        }
    }

    // All columns that do something, each of length 1.
    Eigen::MatrixXd all(white.residual.size(), white.parameters.cols() + count);
    all << white.parameters, white.effects;
    std::vector<Eigen::Index> used;
    for (Eigen::Index column = 0; column < all.cols(); ++column)
    {
        if (all.col(column).norm() > 0.0)
        {
            all.col(column).normalize();
            used.push_back(column);
        }
    }
    if (used.empty())
    {
        table.collinearityOfAll = 1.0;
        return table;
    }
    const Eigen::MatrixXd kept = all(Eigen::all, used);
    const Eigen::MatrixXd gram = kept.transpose() * kept;
    const double smallest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram).eigenvalues().minCoeff();
    table.collinearityOfAll = 1.0 / std::sqrt(std::max(smallest, 1e-12));
    return table;
}

std::vector<std::pair<std::size_t, std::size_t>> lookAlikes(const Identifiability& table, double sds)
{
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (Eigen::Index i = 0; i < table.separability.rows(); ++i)
    {
        for (Eigen::Index j = i + 1; j < table.separability.cols(); ++j)
        {
            // Effects too weak to be seen at all are no finding.
            const bool both = table.signal(i) > sds && table.signal(j) > sds;
            if (both && std::max(table.separability(i, j), table.separability(j, i)) < sds)
            {
                pairs.emplace_back(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
            }
        }
    }
    return pairs;
}

} // namespace clepsydra::identification
