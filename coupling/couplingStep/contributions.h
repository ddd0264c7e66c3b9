#pragma once

#include "couplingStep/rows.h"
#include "couplingStep/semiImplicitSource.h"
#include "couplingStep/voidFractionRate.h"

#include <optional>

namespace clepsydra
{

/// Rows of what a particle adds to its cells, and of the densities in the cells that result. To let the particles add
/// another quantity, give it rows here and values in FluidCoupling::contributions(). Rows that not every run needs are
/// appended where they are needed, because each row is smoothed.
struct ContributionRows
{
    explicit ContributionRows(bool withResistance)
    {
        if (withResistance)
        {
            resistance = append<1>();
        }
    }

    /// Volume in the fluid [m3].
    static constexpr Rows<1> solidVolume{0};
    /// See SemiImplicitSource::update().
    static constexpr Rows<SemiImplicitSource::rowCount> momentum{solidVolume.end()};
    /// See VoidFractionRate::update().
    static constexpr Rows<VoidFractionRate::rowCount> motion{momentum.end()};
    /// The first of these.
    static constexpr Rows<1> velocityResponse{motion.first};
    /// Drag coefficient times time [kg]; only where the self-induced velocity is removed.
    std::optional<Rows<1>> resistance;

    Eigen::Index count = motion.end();

private:
    template<Eigen::Index Count>
    Rows<Count> append()
    {
        const Rows<Count> rows{count};
        count = rows.end();
        return rows;
    }
};

} // namespace clepsydra
