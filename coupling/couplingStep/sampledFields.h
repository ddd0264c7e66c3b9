#pragma once

#include "engine/particles.h"
#include "vectors.h"

#include <functional>
#include <utility>
#include <vector>

namespace clepsydra
{

/// Fields of the fluid that are sampled at the particles, each with a function that stores the sampled values.
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

    /// Values of all fields, stacked by rows: rows x cells.
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

    /// Passes the sampled values to the functions that store them.
    /// \param atParticles  rows x particles, rows as in inCells()
    /// \param isSampled  function of a particle's index: false where its values are not stored
    template<class IsSampled>
    void store(const Eigen::MatrixXd& atParticles, const IsSampled& isSampled) const
    {
        for (Eigen::Index particle = 0; particle < atParticles.cols(); ++particle)
        {
            if (!isSampled(particle))
            {
                continue;
            }
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
