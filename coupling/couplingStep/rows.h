#pragma once

#include <Eigen/Core>

namespace clepsydra
{

/// One row of a matrix as an argument.
using ConstRow = Eigen::Ref<const Eigen::RowVectorXd, 0, Eigen::InnerStride<>>;

/// Consecutive rows of a matrix that hold one quantity, so that it has a name instead of a number.
template<Eigen::Index Count>
struct Rows
{
    Eigen::Index first;

    /// The row after the last one.
    constexpr Eigen::Index end() const
    {
        return first + Count;
    }

    /// These rows of a matrix, which must exist as long as they are used.
    template<class Matrix>
    auto of(Matrix&& matrix) const
    {
        return matrix.template middleRows<Count>(first);
    }
};

} // namespace clepsydra
