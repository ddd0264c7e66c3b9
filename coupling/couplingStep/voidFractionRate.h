#pragma once

#include "couplingStep/couplingSettings.h"
#include "rankTotals.h"

#include "surfaceFields.H"
#include "volFields.H"

#include <Eigen/Core>

namespace clepsydra
{

/// d(eps)/dt in the fluid's continuity equation, with the particles' response to the pressure that is being solved for.
///
/// The pressure accelerates the particles in the next coupling step, and their motion changes the pressure. Where that
/// response is only taken from the past change of eps, it comes too late: in a closed column the error grows where
/// particles are light, or where the coupling step is longer than their relaxation time
/// (tests/conservation/pressureFeedback.cpp). The continuity equation therefore anticipates eps at the end of the next
/// coupling step, implicitly in the velocity and the pressure that are solved for:
///
///     eps + dt div(flux of the particles),    flux = particleFlux + velocityResponse U - pressureResponse grad p
///
/// The rate is the change from the eps that was anticipated last to the eps that is anticipated now. An error of the
/// anticipation is thus corrected one coupling step later, and the integral over time is that of the particles' motion.
/// As in two-fluid solvers, div(eps U + (1 - eps) U_particles) = 0.
///
/// The rate passes a first-order low-pass filter in time (useDDTvoidfractionProps { smoothingTime }); everywhere else
/// eps is that of the particles' present positions. Collisions change the particles' velocities by jumps, and the
/// pressure responds to d2(eps)/dt2, so its noise would grow without bound as the step falls; with the filter it
/// converges. In a dense bed (solid fraction above 0.5) that falls or rises at its terminal velocity, with coupling
/// steps of three relaxation times or more, a filter over many coupling steps makes errors grow again, by a factor of
/// up to 1.15 per coupling step. Do not use the filter with coupling steps of that length.
///
/// Where the mesh moves, all fluxes are relative to it, a cell keeps its particles while its points move, and the rate is
/// that of the fluid in the cell, d(eps V)/dt / V. The filter does not concern the change of the volume V. The motion of the
/// particles is anticipated relative to a mesh that goes on as it has moved in this coupling step.
class VoidFractionRate
{
public:
    /// Reads the fields that an earlier process of this run has written. Collective.
    VoidFractionRate(const Foam::fvMesh& mesh, const CouplingSettings& settings);

    void start(const Foam::volScalarField& voidFraction);

    /// Lets each cell keep the particles that it holds in the continuity equation while its volume changes. Call when the
    /// mesh has moved, before update(). Collective.
    void meshMoved();

    /// Number of rows of the densities that update() takes.
    static constexpr Eigen::Index rowCount = 5;

    /// Computes the explicit part of the rate and the coefficients of the implicit part.
    /// \param densities  rowCount x cells, per volume, sums over the particles of their volume times: velocityResponse
    /// [-]; pressureResponse for the force of a kinematic pressure gradient [s]; (1 - velocityResponse) times the
    /// present velocity [m/s]
    /// \param anticipated  cells: density of the volume of the particles whose motion is anticipated, times that of the
    /// rows above to the present one [-]; it counts where the mesh moves only
    /// \param couplingTimeStep  length of the step that is solved next [s]
    /// \param totals  to be reduced before spreadImbalance()
    void update(const Foam::volScalarField& voidFraction, const Eigen::Ref<const Eigen::MatrixXd>& densities,
        const Eigen::Ref<const Eigen::RowVectorXd>& anticipated, double couplingTimeStep, RankTotals& totals);

    /// Makes the continuity equation of a closed tank solvable, where the rate's integral and the outflow must add up
    /// to zero. Subtracts their sum evenly from all cells, whereas a linear solver would put it into the reference
    /// cell. Collective, one reduction.
    /// \param outflow  of fluid through the boundary of this rank [m3/s]
    /// \return the volume rate that was subtracted, divided by the tank's volume [1/s]
    double spreadImbalance(double outflow);

    /// The same where nothing can pass the boundary of any rank: the integral of the rate is known since the totals of
    /// update() were reduced. Local.
    double spreadImbalance();

    /// Explicit part of the rate [1/s]; zero with `useDDTvoidfraction off`.
    const Foam::volScalarField& withoutImplicit() const
    {
        return explicitRate_;
    }

    /// Factor of the flux of U in the implicit part [-].
    const Foam::surfaceScalarField& velocityResponse() const
    {
        return velocityResponse_;
    }

    /// Factor of grad p in the implicit part [s].
    const Foam::surfaceScalarField& pressureResponse() const
    {
        return pressureResponse_;
    }

    /// The void fraction whose change the continuity equation has held, with that of the last step as oldTime() [-].
    const Foam::volScalarField& integral() const
    {
        return integral_;
    }

    /// Completes the rate when U and p have been solved for. \param flux  of the implicit part [m3/s]
    void close(const Foam::surfaceScalarField& flux);

    /// The whole rate [1/s]. \pre close() has been called
    const Foam::volScalarField& operator()() const
    {
        return rate_;
    }

    /// Volume of particles whose motion the low-pass filter has not passed yet [m3], the integral over the cells of the
    /// magnitude of the difference between the rate without the filter and with it, times the coupling step. Of this
    /// rank's cells. It is zero without a filter. \pre close() has been called. Local.
    double filteredVolume() const;

private:
    /// Integral of the explicit rate over this rank's cells [m3/s].
    double explicitRateHere() const;
    /// Subtracts a volume rate of all ranks [m3/s] evenly. \return that rate, divided by the volume of the mesh [1/s]
    double spread(double imbalance);

    const bool used_;
    const double smoothingTime_;
    /// Of the cells of all ranks [m3].
    double meshVolume_;
    double couplingTimeStep_ = 0;
    /// Part of the change that the filter passes in this coupling step; 1 without a filter.
    double passed_ = 1;
    /// Sum of what spreadImbalance() has subtracted in this coupling step [1/s].
    double spread_ = 0;
    /// Integral of the explicit rate over the cells of all ranks that has not been spread yet [m3/s].
    double unspread_ = 0;
    /// Integral of the rate over time [-].
    Foam::volScalarField integral_;
    Foam::volScalarField explicitRate_;
    Foam::surfaceScalarField velocityResponse_;
    Foam::surfaceScalarField pressureResponse_;
    Foam::volScalarField rate_;
    /// Relative change of each cell's volume in this coupling step, per time [1/s]; empty where the mesh has not moved.
    Foam::scalarField expansion_;
};

} // namespace clepsydra
