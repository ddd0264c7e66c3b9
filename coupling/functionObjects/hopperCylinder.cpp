#include "functionObjects/hopperCylinder.h"

#include "vectors.h"

#include "Pstream.H"
#include "PstreamReduceOps.H"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

HopperCylinder::HopperCylinder(const Foam::polyPatch& wall, const Vector3d& upwards)
    : axis_(upwards.normalized())
{
    using namespace Foam;

    // Bounds in a frame whose third axis is that of the hopper.
    const Vector3d e1 = axis_.unitOrthogonal();
    const Vector3d e2 = axis_.cross(e1);
    vector low = vector::max;
    vector high = vector::min;
    for (const Foam::point& p : wall.localPoints())
    {
        const Vector3d q = toEigen(p);
        const Foam::vector inFrame(q.dot(e1), q.dot(e2), q.dot(axis_));
        low = Foam::min(low, inFrame);
        high = Foam::max(high, inFrame);
    }
    reduce(low, minOp<vector>());
    reduce(high, maxOp<vector>());
    foot_ = 0.5 * (low.x() + high.x()) * e1 + 0.5 * (low.y() + high.y()) * e2 + low.z() * axis_;

    double furthestSqr = 0;
    for (const Foam::point& p : wall.localPoints())
    {
        const Vector3d fromFoot = toEigen(p) - foot_;
        furthestSqr = std::max(furthestSqr, fromFoot.squaredNorm() - std::pow(fromFoot.dot(axis_), 2));
    }
    reduce(furthestSqr, maxOp<scalar>());
    radius_ = std::sqrt(furthestSqr);
}

} // namespace clepsydra
