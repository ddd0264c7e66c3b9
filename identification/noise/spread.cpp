#include "noise/spread.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace clepsydra::identification
{

namespace
{

double ratioOf(const Covariance& data, const Covariance& simulation)
{
    return simulation.matrix.llt().solve(data.matrix).trace() / static_cast<double>(data.matrix.rows());
}

/// From a covariance, for the shrinking of few repeats makes correlated features look wider than independent ones.
Covariance redrawn(const Eigen::MatrixXd& root, double nu, std::mt19937_64& random)
{
    std::normal_distribution<double> normal;
    const Eigen::MatrixXd rows =
        Eigen::MatrixXd::NullaryExpr(std::lround(nu), root.rows(), [&] { return normal(random); });
    return pooledCovariance(rows * root.transpose(), nu);
}

} // namespace

Spread compareSpread(const Scatter& data, const Scatter& simulation, int draws, std::mt19937_64& random)
{
    const Eigen::MatrixXd simulated = simulation.deviations();
    const auto features = simulated.cols();
    const double nuData = data.degreesOfFreedom();
    const double nuSimulation = simulation.degreesOfFreedom();
    // Below one degree of freedom per feature the simulation's covariance says too little to compare with.
    const bool comparable =
        nuData >= 2.0 && nuSimulation > static_cast<double>(features) + 1.0 && (simulated.array().abs() > 1e-12).any();
    Spread spread;
    if (!comparable)
    {
        return spread;
    }
    const Covariance ofSimulation = pooledCovariance(simulated, nuSimulation);
    spread.ratio = ratioOf(pooledCovariance(data.deviations(), nuData), ofSimulation);
    const Eigen::MatrixXd root = ofSimulation.matrix.llt().matrixL();
    double below = 1.0;
    double above = 1.0;
    for (int draw = 0; draw < draws; ++draw)
    {
        const double drawn = ratioOf(redrawn(root, nuData, random), redrawn(root, nuSimulation, random));
        (drawn < spread.ratio ? below : above) += 1.0;
    }
    spread.pValue = std::min(1.0, 2.0 * std::min(below, above) / (draws + 1.0));
    return spread;
}

} // namespace clepsydra::identification
