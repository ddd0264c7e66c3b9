#pragma once

#include "conservation/particleCensus.h"
#include "phaseTimers.h"

#include "Time.H"
#include "dictionary.H"
#include "vector.H"
#include "volFields.H"

#include <optional>
#include <string>

namespace clepsydra
{

/// What the particles received from the fluid in an interval, over all ranks [N s].
struct ReceivedMomentum
{
    Foam::vector sum;
    /// Of the magnitudes: in a tank at rest the sum may vanish.
    double sumOfMagnitudes;
};

/// What a whole run was expected to take, once a hundredth of it was done.
struct EstimatedSeconds
{
    double wall;
    double processor;
};

/// Balances what must balance between particles and fluid: solid volume, momentum, the number of particles; and what was
/// clipped. Stops the run above the tolerances of the `conservationCheck` sub-dictionary of couplingProperties:
///
///     solidVolumeTolerance    1e-9;   // |cells - particles| / particles; |start + inserted - left - cells| / most
///     clippedVolumeTolerance  1e-3;   // solid volume cut off at alphaMin / particles, at any one time
///     momentumTolerance       1e-9;   // |fluid lost - given semi-implicitly - particles received| / sum of |a particle received|
///     pressureForceTolerance  1e-9;   // |on particles - in fluid| / sum of |on a particle|
///     continuityTolerance     1e-4;   // mean |d(eps)/dt + div(eps U)| times the interval
///     imbalanceTolerance      1e-3;   // fluid that a closed tank had to take up or give away / the tank, all in all
class ConservationCheck
{
public:
    ConservationCheck(const Foam::dictionary& couplingProperties, const Foam::Time& time);

    /// Counts the particles; see ParticleCensus.
    /// \return the highest number of a particle that has not come in since the last count
    int countParticles(const ParticlesView& particles);

    /// The same after particles have been taken out.
    void countAfterRemoval(const ParticlesView& particles, Foam::label removed);

    /// Over all ranks, when they were counted last.
    long particles() const
    {
        return census_.now();
    }

    /// The solid volume that is in the fluid at the beginning [m3]; over all ranks.
    void setInitialSolidVolume(double volume)
    {
        solidVolumeAtStart_ = volume;
    }

    /// What of the solid volume has come in since then less what has left [m3]; over all ranks.
    void recordNetInsertion(double netVolume)
    {
        netInsertedVolume_ = netVolume;
    }

    /// The solid volume of all particles, what the cells hold of it before clipping, and what clipping cut off [m3].
    /// All are sums over the ranks. What the cells hold must be the particles' and follow from what has come and gone.
    /// \param worstCell  words for the error.
    void recordSolidVolume(double particles, double cells, double clipped, const Foam::string& worstCell);

    /// What the fluid has given semi-implicitly when the balances open [N s]; sum over the ranks.
    void setInitialMomentum(const Foam::vector& semiImplicitMomentum);

    /// One interval's momentum [N s], over all ranks: what the particles received from the fluid, as they themselves have
    /// it; what the particles' source took from the fluid, as it stood in the equation that was solved; and what of that the
    /// particles will receive in the next interval only. Each from a place of its own, so that what is lost between is found.
    void recordMomentum(
        const ReceivedMomentum& received, const Foam::vector& fluidLost, const Foam::vector& semiImplicitMomentum);

    /// The force of the fluid's pressure gradient on all particles, and the reaction that the fluid's equation holds [N].
    /// \param sumOfMagnitudes  sum of the forces' magnitudes
    void recordPressureForce(const Foam::vector& onParticles, const Foam::vector& inFluid, double sumOfMagnitudes);

    /// One interval's error of the continuity equation times the interval [-], which OpenFOAM's solvers print: fluid made
    /// of nothing, per volume.
    void recordContinuity(const Foam::volScalarField& error);

    /// Fluid that a closed tank had to take up or give away in one interval since the particles' volume in it changed, over
    /// the tank's volume: see VoidFractionRate::spreadImbalance().
    void recordImbalance(double imbalance);

    /// One line to the log.
    void report() const;

    /// Writes postProcessing/conservation/<startTime>/summary.json, with it the time of each phase and what the exchange of
    /// particles has sent between ranks, all of them together. Master rank only.
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

    ParticleCensus census_;
    double solidVolume_ = 0;
    double solidVolumeError_ = 0;
    double solidVolumeAtStart_ = 0;
    double mostSolidVolume_ = 0;
    double netInsertedVolume_ = 0;
    double insertionError_ = 0;
    double largestInsertionError_ = 0;
    double largestSolidVolumeError_ = 0;
    double clippedVolume_ = 0;
    double largestClippedVolume_ = 0;
    Foam::vector particlesReceived_ = Foam::vector::zero;
    Foam::vector fluidLost_ = Foam::vector::zero;
    Foam::vector semiImplicitMomentumAtStart_ = Foam::vector::zero;
    Foam::vector semiImplicitMomentum_ = Foam::vector::zero;
    double momentumMagnitudes_ = 0;
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
