#pragma once

#include "rankTotals.h"

#include "surfaceFieldsFwd.H"
#include "volFields.H"

namespace clepsydra
{

/// Courant number of the fluid in the cells at the end of a coupling step: the number of cells that the fluid passes in it,
/// half the sum of |phi| over the faces of a cell, times the coupling step, divided by the cell's volume.
class FluidCourantNumber
{
public:
    /// Adds what this rank knows to the totals; it is that of this flow when they have been reduced. Local.
    /// \param phi  flux of U [m3/s]
    /// \param couplingTimeStep  over which the fluid has been solved [s]
    void addTo(const Foam::surfaceScalarField& phi, double couplingTimeStep, RankTotals& totals);

    /// Largest of all cells of all ranks, divided by the coupling step [1/s].
    double largestPerTime() const
    {
        return largestPerTime_;
    }

    /// Number of cells of all ranks where it is above 1.
    Foam::label cellsAboveOne() const
    {
        return cellsAboveOne_;
    }

private:
    double largestPerTime_ = 0;
    Foam::label cellsAboveOne_ = 0;
};

} // namespace clepsydra
