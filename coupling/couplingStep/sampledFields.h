#pragma once

#include "engine/particles.h"
#include "vectors.h"

#include <functional>
#include <utility>
#include <vector>

namespace clepsydra
{

/// What of the fluid is sampled at the particles: values in the cells, each with the place where a particle keeps them.
class SampledFields
{
public:
    /// \param values  1 x cells or 3 x cells
    /// \param store  called for every particle with its index and its 1 or 3 values
    template<class Values>
    void add(const Values& values, std::function<void(Eigen::Index, const double*)> store)
    {
        values_.emplace_back(values);
        store_.push_back(std::move(store));
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

    /// \param atParticles  rows as inCells(), a column per particle
    void store(const Eigen::MatrixXd& atParticles) const
    {
        for (Eigen::Index particle = 0; particle < atParticles.cols(); ++particle)
        {
            const double* value = atParticles.col(particle).data();
            for (std::size_t i = 0; i < values_.size(); ++i)
            {
                store_[i](particle, value);
                value += values_[i].rows();
            }
        }
    }

private:
    std::vector<Eigen::MatrixXd> values_;
    std::vector<std::function<void(Eigen::Index, const double*)>> store_;
};

} // namespace clepsydra
