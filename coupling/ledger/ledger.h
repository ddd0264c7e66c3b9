#pragma once

#include "ledger/beadCensus.h"
#include "phaseTimers.h"

#include "Time.H"
#include "dictionary.H"
#include "vector.H"
#include "volFields.H"

#include <optional>
#include <string>

namespace clepsydra
{

/// What the beads received from the fluid in an interval, over all ranks [N s].
struct ReceivedMomentum
{
    Foam::vector sum;
    /// Of the magnitudes: in a tank at rest the sum may vanish.
    double turnover;
};

/// What a whole run was expected to take, once a hundredth of it was done.
struct EstimatedSeconds
{
    double wall;
    double processor;
};

/// Books what must balance between beads and fluid: solid volume, momentum, the number of beads; and what was
/// clipped. Stops the run above the tolerances of the `ledger` sub-dictionary of couplingProperties:
///
///     solidVolumeTolerance    1e-9;   // |cells - beads| / beads; |start + inserted - left - cells| / most
///     clippedVolumeTolerance  1e-3;   // solid volume cut off at alphaMin / beads, at any one time
///     momentumTolerance       1e-9;   // |fluid lost - given in advance - beads received| / sum of |a bead received|
///     pressureForceTolerance  1e-9;   // |on beads - in fluid| / sum of |on a bead|
///     continuityTolerance     1e-4;   // mean |d(eps)/dt + div(eps U)| times the interval
///     imbalanceTolerance      1e-3;   // fluid that a closed tank had to take up or give away / the tank, all in all
class Ledger
{
public:
    Ledger(const Foam::dictionary& couplingProperties, const Foam::Time& time);

    /// Counts the beads; see BeadCensus.
    /// \return the highest number of a bead that has not come in since the last count
    int countBeads(const BeadsView& beads);

    /// The same after beads have been taken out.
    void countAfterRemoval(const BeadsView& beads, Foam::label removed);

    /// Over all ranks, when they were counted last.
    long beads() const
    {
        return census_.now();
    }

    /// The solid volume that is in the fluid at the beginning [m3]; over all ranks.
    void openSolidVolume(double volume)
    {
        solidVolumeAtStart_ = volume;
    }

    /// What of the solid volume has come in since then less what has left [m3]; over all ranks.
    void bookTraffic(double netVolume)
    {
        trafficVolume_ = netVolume;
    }

    /// The solid volume of all beads, what the cells hold of it before clipping, and what clipping cut off [m3].
    /// All are sums over the ranks. What the cells hold must be the beads' and follow from what has come and gone.
    /// \param worstCell  words for the error.
    void bookSolidVolume(double beads, double cells, double clipped, const Foam::string& worstCell);

    /// What the fluid has given in advance when the books open [N s]; sum over the ranks.
    void openMomentum(const Foam::vector& givenInAdvance);

    /// One interval's momentum [N s], over all ranks: what the beads received from the fluid, as they themselves have
    /// it; what the beads' source took from the fluid, as it stood in the equation that was solved; and what of that the
    /// beads will receive in the next interval only. Each from a place of its own, so that what is lost between is found.
    void bookMomentum(
        const ReceivedMomentum& received, const Foam::vector& fluidLost, const Foam::vector& givenInAdvance);

    /// The force of the fluid's pressure gradient on all beads, and the reaction that the fluid's equation holds [N].
    /// \param turnover  sum of the forces' magnitudes
    void bookPressureForce(const Foam::vector& onBeads, const Foam::vector& inFluid, double turnover);

    /// One interval's error of the continuity equation times the interval [-], which OpenFOAM's solvers print: fluid made
    /// of nothing, per volume.
    void bookContinuity(const Foam::volScalarField& error);

    /// Fluid that a closed tank had to take up or give away in one interval since the beads' volume in it changed, over
    /// the tank's volume: see VoidFractionRate::spreadImbalance().
    void bookImbalance(double imbalance);

    /// One line to the log.
    void report() const;

    /// Writes postProcessing/ledger/<startTime>/summary.json, with it the time of each phase and what the exchange of
    /// beads has sent between ranks, all of them together. Master rank only.
    void writeSummary(
        const PhaseTimers& timers, double exchangedBytes, const std::optional<EstimatedSeconds>& estimate) const;

private:
    double momentumError() const;

    const Foam::Time& time_;
    const Foam::dictionary tolerances_;
    const double solidVolumeTolerance_;
    const double clippedVolumeTolerance_;
    const double momentumTolerance_;
    const double pressureForceTolerance_;
    const double continuityTolerance_;
    const double imbalanceTolerance_;
    const Foam::word startTime_;

    BeadCensus census_;
    double solidVolume_ = 0;
    double solidVolumeError_ = 0;
    double solidVolumeAtStart_ = 0;
    double mostSolidVolume_ = 0;
    double trafficVolume_ = 0;
    double trafficError_ = 0;
    double largestTrafficError_ = 0;
    double largestSolidVolumeError_ = 0;
    double clippedVolume_ = 0;
    double largestClippedVolume_ = 0;
    Foam::vector beadsReceived_ = Foam::vector::zero;
    Foam::vector fluidLost_ = Foam::vector::zero;
    Foam::vector givenInAdvanceAtStart_ = Foam::vector::zero;
    Foam::vector givenInAdvance_ = Foam::vector::zero;
    double momentumTurnover_ = 0;
    double pressureForceError_ = 0;
    double largestPressureForceError_ = 0;
    /// Mean magnitude, mean, and sum of the means over the intervals.
    double localContinuityError_ = 0;
    double globalContinuityError_ = 0;
    double cumulativeContinuityError_ = 0;
    double largestContinuityError_ = 0;
    double imbalance_ = 0;
};

} // namespace clepsydra
