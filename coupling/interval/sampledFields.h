#pragma once

#include "engine/beads.h"
#include "vectors.h"

#include <functional>
#include <utility>
#include <vector>

namespace clepsydra
{

/// What of the fluid is sampled at the beads: values in the cells, each with the place where a bead keeps them.
class SampledFields
{
public:
    /// \param values  1 x cells or 3 x cells
    /// \param keep  called for every bead with its index and its 1 or 3 values
    template<class Values>
    void add(const Values& values, std::function<void(Eigen::Index, const double*)> keep)
    {
        values_.emplace_back(values);
        keep_.push_back(std::move(keep));
    }

    /// All of them, one under the other.
    Eigen::MatrixXd inCells() const
    {
        Eigen::Index rows = 0;
        for (const Eigen::MatrixXd& values : values_)
        {
            rows += values.rows();
        }
        Eigen::MatrixXd all(rows, values_.front().cols());
        Eigen::Index row = 0;
        for (const Eigen::MatrixXd& values : values_)
        {
            all.middleRows(row, values.rows()) = values;
            row += values.rows();
        }
        return all;
    }

    /// \param atBeads  rows as inCells(), a column per bead
    void keep(const Eigen::MatrixXd& atBeads) const
    {
        for (Eigen::Index bead = 0; bead < atBeads.cols(); ++bead)
        {
            const double* value = atBeads.col(bead).data();
            for (std::size_t i = 0; i < values_.size(); ++i)
            {
                keep_[i](bead, value);
                value += values_[i].rows();
            }
        }
    }

private:
    std::vector<Eigen::MatrixXd> values_;
    std::vector<std::function<void(Eigen::Index, const double*)>> keep_;
};

} // namespace clepsydra
