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

/// Momentum that the particles received from the fluid in one coupling step, over all ranks [N s].
struct ReceivedMomentum
{
    Foam::vector sum;
    /// Sum of the magnitudes of the particles' impulses: in a tank at rest their sum may vanish.
    double sumOfMagnitudes;
};

/// Estimated duration of the whole run [s], made after a hundredth of it.
struct EstimatedSeconds
{
    double wall;
    double processor;
};

/// Checks conservation of solid volume and momentum between particles and fluid, the number of particles, the clipped
/// volume and the continuity error. The run stops with a FatalError where a tolerance of the `conservationCheck`
/// sub-dictionary of couplingProperties is exceeded:
///
///     solidVolumeTolerance    1e-9;   // |cells - particles| / particles
///                                     // and |initial + inserted - left - cells| / largest solid volume so far
///     clippedVolumeTolerance  1e-3;   // solid volume clipped at alphaMin / solid volume, in any coupling step
///     momentumTolerance       1e-9;   // |lost by fluid - semi-implicit - received by particles|
///                                     // / sum over the particles of |impulse received|
///     pressureForceTolerance  1e-9;   // |force on particles - reaction in fluid| / sum of |force on a particle|
///     continuityTolerance     1e-4;   // mean of |d(eps)/dt + div(eps U)| times the coupling step
///     imbalanceTolerance      1e-3;   // net volume of fluid that a closed tank had to take up / volume of the tank
class ConservationCheck
{
public:
    ConservationCheck(const Foam::dictionary& couplingProperties, const Foam::Time& time);

    /// Counts the particles; see ParticleCensus::count(). Collective.
    /// \return the highest id among the particles that were there at the last count
    int countParticles(const ParticlesView& particles);

    /// Counts the particles after some have been removed; see ParticleCensus::countAfterRemoval(). Collective.
    void countAfterRemoval(const ParticlesView& particles, Foam::label removed);

    /// Number of particles at the last count, over all ranks.
    long particles() const
    {
        return census_.now();
    }

    /// Sets the solid volume in the fluid at the start [m3], over all ranks.
    void setInitialSolidVolume(double volume)
    {
        solidVolumeAtStart_ = volume;
    }

    /// Sets the solid volume that has been inserted less that which has left since then [m3], over all ranks.
    void recordNetInsertion(double netVolume)
    {
        netInsertedVolume_ = netVolume;
    }

    /// Records the solid volume of one coupling step [m3], each a sum over all ranks. The volume in the cells must
    /// equal that of the particles, and the initial volume plus what was inserted less what has left.
    /// \param particles  volume of the particles that is in the fluid
    /// \param cells  solid volume in the cells before clipping
    /// \param clipped  solid volume that clipping has cut off
    /// \param worstCell  description of the cell with the lowest void fraction, for the error message
    void recordSolidVolume(double particles, double cells, double clipped, const Foam::string& worstCell);

    /// Sets the momentum that the fluid has given semi-implicitly at the start [N s]; sum over all ranks.
    void setInitialMomentum(const Foam::vector& semiImplicitMomentum);

    /// Records the momentum of one coupling step [N s], over all ranks. Each value is computed in a different place, so
    /// that momentum which is lost between them is detected.
    /// \param received  what the particles received from the fluid, from the particles' own state
    /// \param fluidLost  what the particles' source took from the fluid, from the equation that was solved
    /// \param semiImplicitMomentum  the part of fluidLost, in sum, that the particles will receive in the next coupling
    /// step only
    void recordMomentum(
        const ReceivedMomentum& received, const Foam::vector& fluidLost, const Foam::vector& semiImplicitMomentum);

    /// Records the pressure force of one coupling step, over all ranks [N].
    /// \param onParticles  force of the fluid's pressure gradient that was applied to all particles
    /// \param inFluid  force whose reaction is in the fluid's equation
    /// \param sumOfMagnitudes  sum of the magnitudes of the forces that the gradient at the particles amounts to
    /// \param leftOut  true where the case leaves this force out: the error is reported, but it is no reason to stop
    void recordPressureForce(
        const Foam::vector& onParticles, const Foam::vector& inFluid, double sumOfMagnitudes, bool leftOut = false);

    /// Error of the pressure force in the last coupling step [-].
    double pressureForceError() const
    {
        return pressureForceError_;
    }

    /// Records the continuity error of one coupling step, d(eps)/dt + div(eps U) times the coupling step [-]: the
    /// volume of fluid that was created or lost per volume, as OpenFOAM's solvers report it.
    void recordContinuity(const Foam::volScalarField& error);

    /// Records the volume of fluid that a closed tank had to take up or give away in one coupling step because the
    /// volume of the particles in it changed, divided by the tank's volume; see VoidFractionRate::spreadImbalance().
    void recordImbalance(double imbalance);

    /// Prints one line to the log.
    void report() const;

    /// Writes postProcessing/conservation/<startTime>/summary.json, with the time of each phase. Only the master rank
    /// writes.
    /// \param exchangedBytes  size of all messages in which ParticleExchange has sent particles between ranks
    /// \param estimate  empty where the run was too short for one
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
    /// Mean magnitude and mean of the continuity error, and the sum of the means over the coupling steps [-].
    double localContinuityError_ = 0;
    double globalContinuityError_ = 0;
    double cumulativeContinuityError_ = 0;
    double largestContinuityError_ = 0;
    double imbalance_ = 0;
};

} // namespace clepsydra
