#pragma once

#include "couplingStep/couplingSettings.h"

#include "surfaceFields.H"
#include "volFields.H"

#include <Eigen/Core>

namespace clepsydra
{

/// d(eps)/dt as it enters the fluid's continuity equation, with the particles' answer to the pressure that is solved for.
///
/// The pressure moves the particles in the next couplingTimeStep, and their motion asks for another pressure. Given afterwards, from
/// how eps did change, that answer comes too late: in a closed column the error grows where particles are light, or where
/// the interval is longer than their relaxation (tests/conservation/pressureFeedback.cpp). So the continuity equation
/// anticipates eps at the end of the next couplingTimeStep, implicitly in the velocity and the pressure that are solved for:
///
///     eps + dt div(flux of the particles),    flux = particleFlux + following U - pressureResponse grad p
///
/// and the rate is what leads from the eps that was anticipated last to the one that is now: what was anticipated wrongly
/// is made good one interval later, and the integral over time is that of the particles. As two-fluid solvers have it,
/// div(eps U + (1 - eps) U_particles) = 0.
///
/// The rate passes a low-pass of first order in time (useDDTvoidfractionProps { smoothingTime }), elsewhere eps is that
/// of the particles as they are. Collisions change the particles' velocities by jumps. The pressure answers to d2(eps)/dt2, so
/// without the low-pass its noise grows without bound as the step falls; with it, it converges.
/// In a dense bed (solid fraction above .5) that falls or rises at its terminal velocity, with intervals of three
/// relaxation times and more, a low-pass over many intervals makes errors grow again, by up to 1.15 in an interval: where
/// the interval is that long, leave the low-pass out.
class VoidFractionRate
{
public:
    /// Reads what an earlier process of this run has left.
    VoidFractionRate(const Foam::fvMesh& mesh, const CouplingSettings& settings);

    void start(const Foam::volScalarField& voidFraction);

    /// Rows of what update() is given.
    static constexpr Eigen::Index rowCount = 5;

    /// \param densities  rowCount x cells, per volume, sums over the particles of their volume times: following [-];
    ///                   pressureResponse for the force of a kinematic pressure gradient [s]; the velocity now times what is not
    ///                   following [m/s]
    void update(
        const Foam::volScalarField& voidFraction, const Eigen::Ref<const Eigen::MatrixXd>& densities, double couplingTimeStep);

    /// In a closed tank the rate's integral and the outflow must add up to zero: takes what they do add up to evenly
    /// from all cells, where a linear solver would dump it in the reference cell. Collective.
    /// \param outflow  of fluid through the boundary of this rank [m3/s]
    /// \return what was taken, over the tank's volume [1/s]
    double spreadImbalance(double outflow);

    /// The rate without what is implicit [1/s]; zero where `useDDTvoidfraction off`.
    const Foam::volScalarField& withoutImplicit() const
    {
        return explicitRate_;
    }

    /// What the flux of U is multiplied with in the implicit part.
    const Foam::surfaceScalarField& velocityResponse() const
    {
        return velocityResponse_;
    }

    /// What grad p is multiplied with in the implicit part [s].
    const Foam::surfaceScalarField& pressureResponse() const
    {
        return pressureResponse_;
    }

    /// When U and p have been solved for. \param flux  of the implicit part [m3/s]
    void close(const Foam::surfaceScalarField& flux);

    /// All of it, once it is closed [1/s].
    const Foam::volScalarField& operator()() const
    {
        return rate_;
    }

private:
    const bool used_;
    const double smoothingTime_;
    double couplingTimeStep_ = 0;
    /// What spreadImbalance() took in this interval [1/s].
    double spread_ = 0;
    /// The integral of the rate.
    Foam::volScalarField integral_;
    Foam::volScalarField explicitRate_;
    Foam::surfaceScalarField velocityResponse_;
    Foam::surfaceScalarField pressureResponse_;
    Foam::volScalarField rate_;
};

} // namespace clepsydra
