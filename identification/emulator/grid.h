#pragma once

#include "study/study.h"

#include <Eigen/Core>

namespace clepsydra::identification
{

/// Evenly spaced amplitudes of an effect, 0 among them, from end to end of its range; a switch has one, 1.
class Grid
{
public:
    Grid() = default;
    explicit Grid(const Effect& effect);

    const Eigen::VectorXd& amplitudes() const
    {
        return amplitudes_;
    }

    /// Of the cubic through the four neighbours of an amplitude: one weight for each of the grid's.
    Eigen::RowVectorXd weightsAt(double amplitude) const;

private:
    Eigen::VectorXd amplitudes_;
    double step_ = 1.0;
};

} // namespace clepsydra::identification
