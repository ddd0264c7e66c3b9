#pragma once

#include "conservation/particleCensus.h"
#include "phaseTimers.h"
#include "rankTotals.h"

#include "Time.H"
#include "dictionary.H"
#include "vector.H"
#include "volFields.H"

#include <array>
#include <optional>
#include <string>

namespace clepsydra
{

/// Momentum between particles and fluid, on one rank or over all ranks [N s].
struct ExchangedMomentum
{
    Foam::vector sum = Foam::vector::zero;
    /// Sum of the magnitudes of the terms of the sum, which may cancel each other.
    double sumOfMagnitudes = 0;

    static constexpr std::size_t size = 4;

    /// Appends this rank's part to numbers whose totals are needed.
    void appendTo(RankNumbers& ofRank) const
    {
        ofRank.addVector(sum);
        ofRank.sums.push_back(sumOfMagnitudes);
    }

    /// Over all ranks, from the total sums from `first` on.
    static ExchangedMomentum in(const RankNumbers& totals, std::size_t first)
    {
        return {totals.vectorAt<Foam::vector>(first), totals.sums[first + size - 1]};
    }
};

/// Heat of one coupling step, on one rank or over all ranks [J]. Heats that are stored are those above 0 K.
struct HeatOfStep
{
    /// By the particles from the fluid, from the particles' own temperatures.
    double received = 0;
    /// What the particles' source took from the fluid, from the equation that was solved.
    double fluidLost = 0;
    /// The part of fluidLost, in sum over the steps, that no particle has received yet; before and after the step.
    double pendingBefore = 0;
    double pending = 0;
    /// Sum of the magnitudes of the terms h A T_f and h A T_p of the exchange.
    double magnitudes = 0;
    double inParticles = 0;
    double inFluidBefore = 0;
    double inFluid = 0;
    /// Out of the fluid, by convection and conduction.
    double throughBoundary = 0;
    /// That the continuity error of the flow creates, because a uniform temperature must remain uniform.
    double ofContinuityError = 0;

    /// This rank's numbers, whose totals are needed.
    RankNumbers numbers() const
    {
        RankNumbers ofRank;
        for (const auto member : members)
        {
            ofRank.sums.push_back(this->*member);
        }
        return ofRank;
    }

    /// Over all ranks, from the totals of numbers().
    static HeatOfStep in(const RankNumbers& totals)
    {
        HeatOfStep heat;
        for (std::size_t i = 0; i < members.size(); ++i)
        {
            heat.*members[i] = totals.sums[i];
        }
        return heat;
    }

private:
    static const std::array<double HeatOfStep::*, 10> members;
};

/// Heat since the start of this process, over all ranks [J], and the largest errors.
struct HeatSoFar
{
    HeatOfStep last;
    /// In fluid and particles and pending.
    double atStart = 0;
    double toParticles = 0;
    double throughBoundary = 0;
    double ofContinuityError = 0;
    double exchangeError = 0;
    double largestExchangeError = 0;
    double largestFluidError = 0;

    double now() const
    {
        return last.inFluid + last.inParticles + last.pending;
    }
};

/// Solid volume that is cut off where the void fraction is below alphaMin.
struct ClippedVolume
{
    /// Over all ranks [m3].
    double sum = 0;
    /// Largest part that was cut off of the solid volume in one cell of any rank [-].
    double largestPart = 0;
    /// Description of that cell on the rank that has it; empty on the others.
    Foam::string worstCell;
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
///     clippedVolumeTolerance  1e-3;   // solid volume clipped at alphaMin / solid volume, in any cell
///     momentumTolerance       1e-9;   // |lost by fluid - semi-implicit - received by particles|
///                                     // / sum of the magnitudes of these terms, in any coupling step
///     pressureForceTolerance  1e-9;   // |force on particles - reaction in fluid| / sum of |force on a particle|
///     continuityTolerance     1e-4;   // mean of |d(eps)/dt + div(eps U)| times the coupling step
///     filteredVolumeTolerance 1;      // solid volume whose motion the low-pass filter of d(eps)/dt has not passed yet
///                                     // / largest solid volume so far; 2 where it passes nothing
///     heatTolerance           1e-9;   // |lost by fluid - pending - received by particles| / sum of the magnitudes of the
///                                     // terms, and the same of the fluid's own balance / heat of the fluid above 0 K
///     imbalanceTolerance      1e-3;   // net volume of fluid that a closed tank had to take up / volume of the tank
class ConservationCheck
{
public:
    ConservationCheck(const Foam::dictionary& couplingProperties, const Foam::Time& time);

    /// Counts the particles; see ParticleCensus::count(). Local; the count is complete when the totals are reduced.
    /// \return the highest id among the particles that were there at the last count
    int countParticles(const ParticlesView& particles, RankTotals& totals);

    /// The same with a reduction of its own. Collective.
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
    /// equal that of the particles, and the initial volume plus what was inserted less what has left. Collective where
    /// too much was clipped, because the message describes the worst cell.
    /// \param particles  volume of the particles that is in the fluid
    /// \param cells  solid volume in the cells before clipping
    void recordSolidVolume(double particles, double cells, const ClippedVolume& clipped);

    /// Sets the momentum that the fluid has given semi-implicitly at the start.
    void setInitialMomentum(const ExchangedMomentum& semiImplicit);

    /// Records the momentum of one coupling step [N s], over all ranks. Each value is computed in a different place, so
    /// that momentum which is lost between them is detected.
    /// \param received  what the particles received from the fluid, from the particles' own state
    /// \param fluidLost  what the particles' source took from the fluid, from the equation that was solved
    /// \param semiImplicit  the part of fluidLost, in sum, that the particles will receive in the next coupling step only.
    /// The error is relative also to the magnitudes of its terms, because their rounding errors remain where particles
    /// move with the fluid and receive nothing.
    void recordMomentum(
        const ExchangedMomentum& received, const Foam::vector& fluidLost, const ExchangedMomentum& semiImplicit);

    /// Records the pressure force of one coupling step, over all ranks [N].
    /// \param onParticles  force of the fluid's pressure gradient that was applied to all particles
    /// \param inFluid  force whose reaction is in the fluid's equation
    /// \param sumOfMagnitudes  sum of the magnitudes of the forces that the gradient at the particles amounts to
    /// \param leftOut  true where the case leaves this force out: the error is reported, but it is no reason to stop
    void recordPressureForce(
        const Foam::vector& onParticles, const Foam::vector& inFluid, double sumOfMagnitudes, bool leftOut = false);

    /// Adds the heat of one coupling step on this rank to the totals. It is recorded when they are reduced. Local.
    void addHeat(const HeatOfStep& ofRank, RankTotals& totals);

    /// What recordMomentum() received last as `semiImplicit`, or setInitialMomentum().
    const ExchangedMomentum& semiImplicitMomentum() const
    {
        return semiImplicit_;
    }

    /// Error of the pressure force in the last coupling step [-].
    double pressureForceError() const
    {
        return pressureForceError_;
    }

    /// Adds the continuity error of one coupling step to the totals, d(eps)/dt + div(eps U) times the coupling step [-]:
    /// the volume of fluid that was created or lost per volume, as OpenFOAM's solvers report it. It is recorded when
    /// the totals are reduced. Collective at the first call, and after the mesh has moved, which sums up
    /// the cells' volumes.
    void addContinuity(const Foam::volScalarField& error, RankTotals& totals);

    /// Forgets the volume of the mesh, which has moved.
    void meshMoved()
    {
        meshVolume_.reset();
    }

    /// Records the difference between the void fraction of the particles and that whose change the fluid's continuity
    /// equation has seen, in volume over all ranks [m3]; see VoidFractionRate::filteredVolume().
    void recordFilteredVolume(double volume);

    /// Records the particles that are in parts of the DEM box without mesh, where these are allowed, and those that have
    /// gone there since the start, over all ranks.
    void recordOutsideMesh(Foam::label now, Foam::label sinceStart)
    {
        outsideMesh_ = now;
        leftMesh_ = sinceStart;
    }

    /// Records the volume of fluid that a closed tank had to take up or give away in one coupling step because the
    /// volume of the particles in it changed, divided by the tank's volume; see VoidFractionRate::spreadImbalance().
    void recordImbalance(double imbalance);

    /// Prints one line to the log.
    void report() const;

    /// Writes postProcessing/conservation/<startTime>/summary.json, with the time of each phase. Only the master rank
    /// writes.
    /// \param exchangedBytes  size of all messages in which ParticleExchange has sent particles between ranks
    /// \param estimate  empty where the run was too short for one
    /// \param reductionsPerStep  RankTotals' reductions in the mean coupling step that wrote no checkpoint; empty where
    /// there was none
    void writeSummary(const PhaseTimers& timers, double exchangedBytes, const std::optional<EstimatedSeconds>& estimate,
        const std::optional<double>& reductionsPerStep) const;

private:
    /// \param heat  over all ranks
    void recordHeat(const HeatOfStep& heat);
    /// \param mean, meanMagnitude  of the continuity error over the cells of all ranks, weighted with their volumes [-]
    void recordContinuity(double meanMagnitude, double mean);

    const Foam::Time& time_;
    const Foam::dictionary tolerances_;
    const double solidVolumeTolerance_;
    const double clippedVolumeTolerance_;
    const double momentumTolerance_;
    const double pressureForceTolerance_;
    const double continuityTolerance_;
    const double filteredVolumeTolerance_;
    const double imbalanceTolerance_;
    const double heatTolerance_;
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
    double largestClippedPart_ = 0;
    /// Sums over the coupling steps [N s].
    Foam::vector particlesReceived_ = Foam::vector::zero;
    Foam::vector fluidLost_ = Foam::vector::zero;
    ExchangedMomentum semiImplicit_;
    double momentumError_ = 0;
    double largestMomentumError_ = 0;
    double pressureForceError_ = 0;
    double largestPressureForceError_ = 0;
    /// Mean magnitude and mean of the continuity error, and the sum of the means over the coupling steps [-].
    double localContinuityError_ = 0;
    double globalContinuityError_ = 0;
    double cumulativeContinuityError_ = 0;
    double largestContinuityError_ = 0;
    /// Of the cells of all ranks [m3]; empty until it is needed.
    std::optional<double> meshVolume_;
    double filteredVolume_ = 0;
    double largestFilteredVolume_ = 0;
    Foam::label outsideMesh_ = 0;
    Foam::label leftMesh_ = 0;
    double imbalance_ = 0;
    /// Empty where no heat is recorded.
    std::optional<HeatSoFar> heat_;
};

} // namespace clepsydra
