#pragma once

#include "study/study.h"

#include <Eigen/Core>

namespace clepsydra::identification
{

/// Equidistant amplitudes over the range of an effect, 0 among them. A switch has the single amplitude 1.
class Grid
{
public:
    Grid() = default;
    explicit Grid(const Effect& effect);

    const Eigen::VectorXd& amplitudes() const
    {
        return amplitudes_;
    }

    /// Weights of the grid's amplitudes for interpolation by a cubic through the four neighbours of an amplitude.
    Eigen::RowVectorXd weightsAt(double amplitude) const;

private:
    Eigen::VectorXd amplitudes_;
    double step_ = 1.0;
};

} // namespace clepsydra::identification
