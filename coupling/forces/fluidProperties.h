#pragma once

#include "closures/stratifiedViscosity.h"
#include "engine/particles.h"

#include "boundBox.H"
#include "dictionary.H"

namespace clepsydra
{

/// The fluid of a run. SI units.
struct FluidProperties
{
    double density;
    /// Of a stratified liquid the lower one's.
    double dynamicViscosity;
    Vector3d gravity;
    closures::Stratification stratification = {};

    /// Dynamic [Pa s]. \param diameter  of the particle that feels it; 0: of the liquid as it lies
    double viscosityAt(const Vector3d& position, double diameter = 0) const
    {
        return stratification.isThere()
                   ? dynamicViscosity * stratification.factor(-gravity.normalized().dot(position), diameter)
                   : dynamicViscosity;
    }
};

/// Entry `stratification` of transportProperties; see closures/stratifiedViscosity.h.
///
///     stratification
///     {
///         height      0.243;  // of the edge [m], against gravity from the origin
///         width       0.008;  // of the edge, its standard deviation [m]
///         step        0.66;   // ln of the lower liquid's viscosity, nu, over the upper one's; default 0
///         lag         1.5;    // a particle feels the liquid so many diameters above it; default 0
///         gradient    0;      // of ln(nu) [1/m] besides; default 0
///     }
///
/// FatalIOError for what it cannot use, in the box of the mesh.
closures::Stratification readStratification(
    const Foam::dictionary& transportProperties, const Vector3d& gravity, const Foam::boundBox& mesh);

} // namespace clepsydra
