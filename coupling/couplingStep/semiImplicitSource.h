#pragma once

#include "fvMatrices.H"
#include "volFields.H"

#include <Eigen/Core>

namespace clepsydra
{

/// The particles' source in the fluid's momentum equation, semi-implicit in the fluid's velocity and with a deferred
/// correction.
///
/// The source of one step holds, implicitly, the drag that the particles will receive in the next coupling step from
/// the velocity that is being solved for. For one particle, with the fluid's velocity U_b at the particle, this
/// semi-implicit impulse is
///
///     P = c (U_b - v) + n V dt grad p,    c: AnticipatedMotion::drag, n: AnticipatedMotion::velocityResponse
///
/// where V is the particle's volume: drag will transfer the fraction n of the pressure's impulse on the particle to the
/// fluid. In the next step the fluid receives, explicitly, the impulse A that the particle did receive less P, at the
/// particle's new position. Particles that only drag acts on therefore leave no remainder, contact forces are corrected
/// one coupling step later, and the momentum that the fluid gives is in sum the momentum that the particles receive.
/// The matrix holds C U, where C is the smoothed density of c. Where C U differs from the smoothed density of c U_b,
/// and likewise for the pressure, the difference is a deferred correction in the next step.
///
/// Linear analysis for one wave length with slip s = U - v, x = K dt/m, q = 1 - exp(-x), k = K dt divided by the
/// fluid's mass, mu = mass of particles divided by that of the fluid, r = fraction of the wave's amplitude that
/// smoothing leaves. Each coupling step multiplies
///
///     fixed particles                     U by (1 + (1 - r) k)/(1 + k)
///     free particles, treated as free     s by (1 - q)/(1 + mu q)                       (r = 1)
///     free particles, treated as fixed    s by (1 - q + mu (x - q))/(1 + mu x)          (r = 1)
///
/// All factors lie between 0 and 1, so the coupling is stable and does not oscillate for any coupling step and mass
/// ratio. It is a first-order splitting in the coupling step. Where the length of the coupling step changes, dt is that
/// of the next one, whose drag is given: the quantities are impulses, which the equation divides by the length of the
/// step that is solved.
class SemiImplicitSource
{
public:
    /// Reads the fields that an earlier process of this run has written.
    SemiImplicitSource(const Foam::fvMesh& mesh, double fluidDensity);

    /// Number of rows of the densities that update() takes.
    static constexpr Eigen::Index rowCount = 4;

    /// Adds the deferred correction that defer() has stored, so that one smoothing serves both.
    /// \param densities  those of update(), not smoothed yet
    void addDeferred(Eigen::Ref<Eigen::MatrixXd> densities) const;

    /// Sets the source of the next step.
    /// \param densities  rowCount x cells, per volume, smoothed sums over all particles: of A - P - c v [N s/m3] (3
    /// rows) and of c [kg/m3]
    /// \param couplingTimeStep  length of the step that is solved next, not of the one whose drag c holds [s]
    void update(const Eigen::Ref<const Eigen::MatrixXd>& densities, double couplingTimeStep);

    /// The particles' source in the momentum equation of the next step [m/s2 times volume].
    Foam::tmp<Foam::fvVectorMatrix> source(Foam::volVectorField& U) const;

    /// Stores the semi-implicit momentum and the deferred correction. Call when U has been solved for.
    /// \param sourceOfPressure  see PressureOnParticles::source() [m/s2]
    /// \param densities  3 x cells, per volume, not smoothed: sum of c U_b + n V dt grad p over the particles [N s/m3]
    void defer(const Foam::volVectorField& U, const Foam::volVectorField& sourceOfPressure,
        const Eigen::Ref<const Eigen::MatrixXd>& densities);

    /// Lets each cell keep the momentum that it holds while its volume changes. Call when the mesh has moved, before
    /// addDeferred(). Local.
    void meshMoved();

    /// Before the first coupling step: subtracts the semi-implicit impulse from the fluid's velocity.
    void subtractFirstDrag(Foam::volVectorField& U, const Foam::volScalarField& voidFraction) const;

    /// Momentum that the fluid has given and that has not been assigned to a particle, in each cell [m/s: impulse per
    /// mass of fluid].
    Foam::tmp<Foam::vectorField> pendingMomentum() const
    {
        return given_.primitiveField() - deferred_.primitiveField();
    }

private:
    const double fluidDensity_;
    /// Length of the step that is solved next [s].
    double couplingTimeStep_ = 0;
    /// C [1/s], per mass of fluid and per coupling step, as are the other fields.
    Foam::volScalarField coefficient_;
    /// Density of A - P - c v with the sign that it has for the fluid [m/s2].
    Foam::volVectorField particleSource_;
    /// Momentum that the fluid has given semi-implicitly, and the momentum that particles have been assigned [m/s]; the
    /// latter is not smoothed yet.
    Foam::volVectorField given_;
    Foam::volVectorField deferred_;
};

} // namespace clepsydra
