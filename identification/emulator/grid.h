#pragma once

#include "study/study.h"

#include <Eigen/Core>

#include <vector>

namespace clepsydra::identification
{

/// Amplitudes over the range of an effect: equidistant, 0 among them, and those that were added. A switch has the single
/// amplitude 1.
struct Grid
{
    Eigen::VectorXd amplitudes; // ascending
    Eigen::MatrixXd scales;     // of the cubics of each four neighbours, one column by their first

    Grid() = default;
    explicit Grid(const Effect& effect, const std::vector<double>& added = {});

    /// Weights of the grid's amplitudes for interpolation by a cubic through the four neighbours of an amplitude; one
    /// row for each amplitude at which is interpolated.
    Eigen::MatrixXd weightsAt(const Eigen::VectorXd& at) const;
    Eigen::RowVectorXd weightsAt(double amplitude) const
    {
        return weightsAt(Eigen::VectorXd::Constant(1, amplitude));
    }
};

} // namespace clepsydra::identification
