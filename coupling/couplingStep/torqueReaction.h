#pragma once

#include "couplingStep/particleMapping.h"

#include "surfaceFields.H"
#include "volFields.H"

namespace clepsydra
{

/// Force on the fluid per volume that exerts given couples on it: f = 1/2 curl(m), with m the couple per volume [N m/m3].
///
/// With m = 0 on the boundary, as here, the forces sum up to zero and their torque is the sum of the couples. Both hold
/// in the cells too. A face gives S x m_f/2 to one of its cells and takes it from the other one, which cancels in the
/// sum of the forces. On a mesh of hexahedra along the axes their torque is that of the couples to rounding, because the
/// value of each cell is weighted on a face by the distance of its own centre from it, and not, as in linear
/// interpolation, by that of the other cell's. Only in a cell at the boundary, a quarter of the couple along each
/// boundary face is lost: its forces would act on the wall.
///
/// \return f [N/m3]. Collective.
Foam::tmp<Foam::volVectorField> forceOfCouples(const Foam::volVectorField& couplePerVolume);

/// The reaction of the fluid's torques on the particles: a couple, distributed over the cells and smoothed as the
/// particles' forces are.
///
/// It is explicit: the fluid receives, in the step that is solved next, what the particles received in the last coupling
/// step. Particles that cannot rotate thereby act on the fluid as a viscosity of 3/2 phi mu C_t/(pi mu d^3), which is
/// stable where it is below that of the fluid, at any coupling step, because the fluid's own is implicit.
class TorqueReaction
{
public:
    TorqueReaction(const Foam::fvMesh& mesh, double fluidDensity);

    /// Sets the source of the next step. Collective.
    /// \param angularImpulses  see DemResult
    /// \param couplingTimeStep  length of the coupling step that gave them [s]
    void update(const LocatedParticles& particles, const Eigen::Matrix3Xd& angularImpulses, double couplingTimeStep);

    /// Its force per mass of fluid [m/s2].
    const Foam::volVectorField& source() const
    {
        return source_;
    }

private:
    const double fluidDensity_;
    /// Per volume and mass of fluid [m2/s2].
    Foam::volVectorField couple_;
    Foam::volVectorField source_;
};

} // namespace clepsydra
