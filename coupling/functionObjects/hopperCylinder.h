#pragma once

#include "engine/particles.h"

#include "polyPatch.H"

namespace clepsydra
{

/// The upright cylinder around a hopper's wall patch, over all ranks. SI units.
///
/// A particle is in the hopper where its centre is above the lowest point of the wall and not farther from the axis
/// than the farthest point of the wall. There is no upper limit, so particles above the rim during filling are counted,
/// too.
class HopperCylinder
{
public:
    /// Collective.
    /// \param wall  patch with a face on at least one rank
    /// \param upwards  direction of the axis, of any length but zero
    HopperCylinder(const Foam::polyPatch& wall, const Vector3d& upwards);

    /// One whose foot and radius are known [m]. \param upwards  as above
    HopperCylinder(const Vector3d& upwards, const Vector3d& foot, double radius)
        : axis_(upwards.normalized()),
          foot_(foot),
          radius_(radius)
    {}

    bool contains(const Vector3d& point) const
    {
        const Vector3d fromFoot = point - foot_;
        const double height = fromFoot.dot(axis_);
        return height > 0 && (fromFoot - height * axis_).squaredNorm() <= radius_ * radius_;
    }

    /// Intersection of the axis with the horizontal plane through the wall's lowest point [m].
    const Vector3d& foot() const
    {
        return foot_;
    }

    double radius() const
    {
        return radius_;
    }

private:
    Vector3d axis_;
    Vector3d foot_;
    double radius_ = 0;
};

} // namespace clepsydra
