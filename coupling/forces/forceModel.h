#pragma once

#include "engine/beads.h"

#include "runTimeSelection.h"

namespace clepsydra
{

/// Constants of the fluid and of the run. SI units.
struct FluidProperties
{
    double density;
    double dynamicViscosity;
    Vector3d gravity;
};

/// The forces of one DEM step on the beads of one rank, split by what is implicit and by whose reaction the fluid
/// must be handed. Force on bead i = implicitCoefficient[i] (U_fluid - v_i) + source.col(i) + shared.col(i).
struct ForceSum
{
    /// Sp [kg/s]. Reaction: handed to the fluid.
    Eigen::ArrayXd implicitCoefficient;
    /// Su [N]. Reaction: handed to the fluid.
    Eigen::Matrix3Xd source;
    /// Su [N]. Reaction: already in the fluid's equation (model A's eps grad p; the hydrostatic part of p).
    Eigen::Matrix3Xd shared;

    void setZero(Eigen::Index beadCount);
};

/// One force of the fluid on beads, selected by name in `forceModels (...)` of couplingProperties, coefficients in
/// `<name>Props`. A model adds its part for all beads of the rank at once; it keeps no state between calls.
class ForceModel
{
public:
    TypeName("forceModel");

    declareRunTimeSelectionTable(Foam::autoPtr, ForceModel, dictionary,
        (const Foam::dictionary& coefficients, const FluidProperties& fluid), (coefficients, fluid))

    static Foam::autoPtr<ForceModel> New(
        const Foam::word& name, const Foam::dictionary& couplingProperties, const FluidProperties& fluid);

    virtual ~ForceModel() = default;

    virtual void add(const BeadsView& beads, ForceSum& sum) const = 0;

    /// One line for the start of the log, with the coefficients.
    virtual Foam::string description() const = 0;
};

} // namespace clepsydra
