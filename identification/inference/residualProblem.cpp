#include "inference/residualProblem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clepsydra::identification
{

namespace
{

/// Below this part of its size an effect counts as wholly imitated by the parameters.
constexpr double negligible = 1e-10;

} // namespace

Eigen::MatrixXd ResidualProblem::covariance(std::size_t block, const Noise& noise, const Eigen::VectorXd& steps) const
{
    const Block& b = blocks[block];
    double simulationShare = b.simulationShare;
    if (steps.size() > 0)
    {
        simulationShare += columnShare.row(static_cast<Eigen::Index>(block)).dot(steps.cwiseAbs2());
    }
    Eigen::MatrixXd sum = noise.data.matrix(b.features, b.features).cwiseProduct(b.dataShare)
                          + simulationShare * noise.simulation.matrix(b.features, b.features);
    sum.diagonal() += b.knownVariance + noise.modelError(b.features).cwiseAbs2();
    return sum;
}

ResidualProblem ResidualProblem::withEffects(const std::vector<Eigen::Index>& effects) const
{
    ResidualProblem part = *this;
    part.effectColumns = Eigen::MatrixXd(effectColumns(Eigen::all, effects));
    part.columnShare = Eigen::MatrixXd(columnShare(Eigen::all, effects));
    return part;
}

double logDeterminant(const Eigen::LLT<Eigen::MatrixXd>& root)
{
    return 2.0 * root.matrixLLT().diagonal().array().log().sum();
}

WhiteProblem whitened(const ResidualProblem& problem, const Noise& noise, const Eigen::VectorXd& steps)
{
    const auto rows = problem.residual.size();
    const auto parameters = problem.parameterColumns.cols();
    const auto effects = problem.effectColumns.cols();
    WhiteProblem white{Eigen::VectorXd(rows + parameters), Eigen::MatrixXd(rows + parameters, parameters),
        Eigen::MatrixXd(rows + parameters, effects), 0.0};
    for (std::size_t block = 0; block < problem.blocks.size(); ++block)
    {
        const auto first = problem.blocks[block].firstRow;
        const auto count = static_cast<Eigen::Index>(problem.blocks[block].features.size());
        const Eigen::LLT<Eigen::MatrixXd> root(problem.covariance(block, noise, steps));
        const auto lower = root.matrixL();
        white.residual.segment(first, count) = lower.solve(problem.residual.segment(first, count));
        white.parameters.middleRows(first, count) = lower.solve(problem.parameterColumns.middleRows(first, count));
        white.effects.middleRows(first, count) = lower.solve(problem.effectColumns.middleRows(first, count));
        white.logDeterminant += logDeterminant(root);
    }
    white.residual.tail(parameters) = -problem.parameterOffset;
    white.parameters.bottomRows(parameters).setIdentity();
    white.effects.bottomRows(parameters).setZero();
    return white;
}

Fits::Fits(WhiteProblem problem)
    : problem_(std::move(problem))
{
    const Eigen::MatrixXd& j = problem_.parameters;
    // The priors' rows make this regular.
    inverse_ = (j.transpose() * j).llt().solve(Eigen::MatrixXd::Identity(j.cols(), j.cols()));
    residualLeft_ = problem_.residual - j * (inverse_ * (j.transpose() * problem_.residual));
    effectsLeft_ = problem_.effects - j * (inverse_ * (j.transpose() * problem_.effects));
    nullMisfit_ = residualLeft_.squaredNorm();
}

Eigen::VectorXd Fits::parameterShift(Eigen::Index effect, double amplitude) const
{
    Eigen::VectorXd residual = problem_.residual;
    if (effect >= 0)
    {
        residual -= amplitude * problem_.effects.col(effect);
    }
    return inverse_ * (problem_.parameters.transpose() * residual);
}

Fits::Effect Fits::effect(Eigen::Index index, double lower, double upper) const
{
    const auto column = effectsLeft_.col(index);
    const double size = column.squaredNorm();
    if (size <= negligible * problem_.effects.col(index).squaredNorm())
    {
        const double amplitude = std::clamp(0.0, lower, upper);
        return {amplitude, 0.0, std::numeric_limits<double>::infinity(), nullMisfit_, nullMisfit_};
    }
    const double product = column.dot(residualLeft_);
    const double free = product / size;
    const double amplitude = std::clamp(free, lower, upper);
    const double freeMisfit = nullMisfit_ - product * free;
    return {amplitude, free, 1.0 / std::sqrt(size), freeMisfit + (amplitude - free) * (amplitude - free) * size,
        freeMisfit};
}

} // namespace clepsydra::identification
