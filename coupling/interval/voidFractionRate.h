#pragma once

#include "interval/couplingSettings.h"

#include "volFields.H"

namespace clepsydra
{

/// d(eps)/dt as it enters the fluid's continuity equation.
///
/// eps passes a low-pass of first order in time (useDDTvoidfractionProps { smoothingTime }), elsewhere it is that of the
/// beads as they are. Collisions change the beads' velocities by jumps. The pressure answers to d2(eps)/dt2, so without
/// the low-pass its noise grows without bound as the step falls; with it, it converges. The rate's integral over time
/// differs from eps by no more than eps changes in a smoothing time: nothing accumulates.
class VoidFractionRate
{
public:
    /// Reads what an earlier process of this run has left.
    VoidFractionRate(const Foam::fvMesh& mesh, const CouplingSettings& settings);

    void start(const Foam::volScalarField& voidFraction);

    void update(const Foam::volScalarField& voidFraction, double interval);

    /// In a closed tank the rate's integral and the outflow must add up to zero: takes what they do add up to evenly
    /// from all cells, where a linear solver would dump it in the reference cell. Collective.
    /// \param outflow  of fluid through the boundary of this rank [m3/s]
    /// \return what was taken, over the tank's volume [1/s]
    double spreadImbalance(double outflow);

    /// [1/s]; zero where `useDDTvoidfraction off`.
    const Foam::volScalarField& operator()() const
    {
        return rate_;
    }

private:
    const bool used_;
    const double smoothingTime_;
    /// The void fraction through the low-pass.
    Foam::volScalarField smoothed_;
    Foam::volScalarField rate_;
};

} // namespace clepsydra
