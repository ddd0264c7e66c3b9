#pragma once

#include "forces/modelType.h"
#include "forces/fluidProperties.h"

#include "fvMatricesFwd.H"
#include "volFields.H"

#include <memory>

namespace Foam::fv
{
class options;
}

namespace clepsydra
{

/// Sources, porous zones, limits and constraints of the fluid's momentum equation from constant/fvOptions or
/// system/fvOptions. Without such a file nothing is done.
///
/// An option states what it adds to the equation of a single-phase solver, a force per mass of fluid [m/s2]. The
/// equation here is per volume of fluid and particles, so that it is multiplied by the void fraction. A uniform force
/// on fluid at rest is therefore balanced by a uniform pressure gradient, wherever the particles are.
class FluidSources
{
public:
    /// FatalError or FatalIOError that names the file where both files are there, where an option does not act on U,
    /// and where its type cannot be right in this solver.
    FluidSources(const Foam::fvMesh& mesh, const FluidProperties& fluid, ModelType modelType);
    ~FluidSources();
    FluidSources(const FluidSources&) = delete;
    FluidSources& operator=(const FluidSources&) = delete;

    /// Adds the sources to the momentum equation.
    void addTo(Foam::fvVectorMatrix& UEqn, Foam::volVectorField& U, const Foam::volScalarField& voidFraction) const;

    /// Applies the constraints, which fix values or damp them, to the relaxed momentum equation.
    void constrain(Foam::fvVectorMatrix& UEqn) const;

    /// Applies the limits to a velocity that has been solved for.
    void correct(Foam::volVectorField& U) const;

private:
    /// Viscosity, which porous zones look up in the mesh's registry [m2/s].
    std::unique_ptr<Foam::volScalarField> nu_;
    /// Owned by the mesh's registry; null where there is no file.
    Foam::fv::options* options_ = nullptr;
};

/// Warns of an fvOptions file in a run without fluid.
void warnOfFluidSources(const Foam::Time& time);

} // namespace clepsydra
