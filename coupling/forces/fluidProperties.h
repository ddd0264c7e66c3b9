#pragma once

#include "closures/stratifiedViscosity.h"
#include "engine/particles.h"

#include "boundBox.H"
#include "dictionary.H"

#include <string>

namespace clepsydra
{

/// Properties of the fluid of a run. SI units.
struct FluidProperties
{
    double density;
    /// Dynamic viscosity [Pa s]; in a stratified liquid that of the lower liquid.
    double dynamicViscosity;
    Vector3d gravity;
    closures::Stratification stratification = {};
    /// Turbulence model as it is reported, such as "RAS kEpsilon"; empty for laminar flow.
    std::string turbulence = {};

    /// Dynamic viscosity at a position [Pa s]. \param diameter  of the particle on which the liquid acts [m]; 0 for the
    /// liquid itself
    double viscosityAt(const Vector3d& position, double diameter = 0) const
    {
        return stratification.isThere()
                   ? dynamicViscosity * stratification.factor(-gravity.normalized().dot(position), diameter)
                   : dynamicViscosity;
    }
};

/// Reads the entry `stratification` of transportProperties; see closures/stratifiedViscosity.h.
///
///     stratification
///     {
///         height      0.243;  // of the edge against gravity from the origin [m]
///         width       0.008;  // standard deviation of the edge [m]
///         step        0.66;   // ln of the lower liquid's kinematic viscosity over the upper one's; default 0
///         lag         1.5;    // the liquid this many diameters above a particle acts on it; default 0
///         gradient    0;      // additional gradient of ln(nu) [1/m]; default 0
///     }
///
/// FatalIOError where an entry is out of range for the box of the mesh.
closures::Stratification readStratification(
    const Foam::dictionary& transportProperties, const Vector3d& gravity, const Foam::boundBox& mesh);

} // namespace clepsydra
