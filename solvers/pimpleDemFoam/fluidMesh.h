#pragma once

#include "couplingStep/couplingSettings.h"
#include "distribution/cyclicPatches.h"
#include "forces/fluidProperties.h"

#include "Time.H"
#include "argList.H"
#include "dynamicFvMesh.H"

namespace clepsydra
{

/// The mesh of the fluid. It is at rest, or its points move as constant/dynamicMeshDict states. Its cells and faces remain.
class FluidMesh
{
public:
    /// FatalIOError where constant/dynamicMeshDict asks for a mesh whose cells change, or for a motion that this solver does
    /// not know.
    FluidMesh(const Foam::argList& args, const Foam::Time& time);

    Foam::fvMesh& operator*()
    {
        return *mesh_;
    }

    /// Whether the points move during the run.
    bool moves() const
    {
        return dynamic_ != nullptr;
    }

    /// Moves the points to where they are at the present time. Collective. \pre moves()
    void move()
    {
        dynamic_->update();
    }

    /// FatalIOError where the points move and something of the case does not allow it. Collective.
    void requireCaseForMotion(const CouplingSettings& settings, const FluidProperties& fluid) const;

private:
    Foam::autoPtr<Foam::fvMesh> mesh_;
    /// Null where the mesh is at rest.
    Foam::dynamicFvMesh* dynamic_ = nullptr;
};

} // namespace clepsydra
