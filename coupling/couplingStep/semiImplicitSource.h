#pragma once

#include "fvMatrices.H"
#include "volFields.H"

#include <Eigen/Core>

namespace clepsydra
{

/// The momentum that particles and fluid exchange: the particles' source in the fluid's momentum equation.
///
/// The fluid gives the drag of an interval in advance: its equation of one step holds, implicitly, what the particles will
/// receive in the next interval from the very velocity that is solved for. In advance for one particle, at the fluid's
/// velocity U_b there,
///
///     P = c (U_b - v) + n V dt grad p,    c: AnticipatedMotion::drag, n: AnticipatedMotion::velocityResponse
///
/// V the particle's volume: the drag will take part n of the impulse that the pressure gives the particle.
/// In the next step the fluid receives, explicitly, what the particle did receive, A, less P, at the place where the particle is
/// then. So particles under drag alone leave nothing over, contacts are made good one interval later, and the sum of all
/// that the fluid gives is that of what the particles receive. The matrix holds C U, C being the smoothed density of c;
/// where that is not the smoothed density of c U_b, and likewise for the pressure, the difference is made good in the next step, too.
///
/// Linear analysis, one wave length, slip s = U - v, x = K dt/m, q = 1 - exp(-x), k = K dt over the fluid's mass, mu
/// the particles' mass over the fluid's, r: what of the wave's amplitude smoothing leaves. Each interval multiplies
///
///     particles held               U by (1 + (1 - r) k)/(1 + k)
///     particles free, seen as such s by (1 - q)/(1 + mu q)                       (r = 1)
///     particles free, seen as held s by (1 - q + mu (x - q))/(1 + mu x)          (r = 1)
///
/// All lie between 0 and 1: nothing rings, for any interval and mass ratio. It is a splitting of first order in the
/// couplingTimeStep. Where the interval's length changes, dt is that of the next one, for which the drag is given: what is given
/// are impulses, which the equation divides by the length of the step that is solved.
class SemiImplicitSource
{
public:
    /// Reads what an earlier process of this run has left.
    SemiImplicitSource(const Foam::fvMesh& mesh, double fluidDensity);

    /// Rows of what update() is given.
    static constexpr Eigen::Index rowCount = 4;

    /// Adds what defer() was given, so that one smoothing does for both.
    /// \param densities  of update(), not smoothed
    void addDeferred(Eigen::Ref<Eigen::MatrixXd> densities) const;

    /// \param densities  rowCount x cells, per volume, smoothed: of all particles, the sum of A - P - c v [N s/m3], of c [kg/m3]
    /// \param couplingTimeStep  of the coming step, not of the one for whose drag c stands [s]
    void update(const Eigen::Ref<const Eigen::MatrixXd>& densities, double couplingTimeStep);

    /// The particles' source in the momentum equation of the coming step [m/s2 times volume].
    Foam::tmp<Foam::fvVectorMatrix> source(Foam::volVectorField& U) const;

    /// When U has been solved for. \param sourceOfPressure  see FluidCoupling [m/s2]
    /// \param densities  3 x cells, per volume, not smoothed: the sum of c U_b + n V dt grad p [N s/m3]
    void defer(const Foam::volVectorField& U, const Foam::volVectorField& sourceOfPressure,
        const Eigen::Ref<const Eigen::MatrixXd>& densities);

    /// For the first interval: takes what is given semi-implicitly from the fluid's velocity itself.
    void subtractFirstDrag(Foam::volVectorField& U, const Foam::volScalarField& voidFraction) const;

    /// What the fluid has given and no particle has been promised, in each cell [m/s, as impulse per mass and volume].
    Foam::tmp<Foam::vectorField> pendingMomentum() const
    {
        return given_.primitiveField() - deferred_.primitiveField();
    }

private:
    const double fluidDensity_;
    /// Of the coming step [s].
    double couplingTimeStep_ = 0;
    /// C [1/s], per mass of fluid and over the couplingTimeStep; so are the others.
    Foam::volScalarField coefficient_;
    /// Of A - P - c v, with the sign that it has for the fluid [m/s2].
    Foam::volVectorField particleSource_;
    /// What the fluid has given, and what particles have been promised [m/s]; the latter is not smoothed yet.
    Foam::volVectorField given_;
    Foam::volVectorField deferred_;
};

} // namespace clepsydra
