#pragma once

#include "engine/particles.h"

#include "polyPatch.H"

namespace clepsydra
{

/// The upright cylinder that a hopper's wall patch spans, over all ranks. Lengths in m.
///
/// A particle is in the hopper if its centre is above the lowest point of the wall and no further from the axis than the
/// wall's furthest point. There is no upper bound: particles above the rim while filling count, too.
class HopperCylinder
{
public:
    /// Collective. \param wall  has a face on one rank at least.
    /// \param upwards  direction of the axis, of any length but zero.
    HopperCylinder(const Foam::polyPatch& wall, const Vector3d& upwards);

    bool contains(const Vector3d& point) const
    {
        const Vector3d fromFoot = point - foot_;
        const double height = fromFoot.dot(axis_);
        return height > 0 && (fromFoot - height * axis_).squaredNorm() <= radius_ * radius_;
    }

    /// Where the axis meets the plane of the wall's lowest point.
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
