#pragma once

#include "engine/particles.h"

#include <cmath>

namespace clepsydra
{

/// The directions along the axes in which space repeats itself. A particle at x acts at x + n length for all whole
/// numbers n, which are its images. An engine may move a particle by a length at any time, and it may let a particle
/// lie outside the box for a while, so nothing may depend on which image it states as the position. SI units.
struct PeriodicBox
{
    /// Lowest corner; the component along an axis that is not periodic has no meaning.
    Vector3d low = Vector3d::Zero();
    /// Period along each axis; 0 along an axis that is not periodic.
    Vector3d length = Vector3d::Zero();

    bool isPeriodic() const
    {
        return !length.isZero(0);
    }

    bool isPeriodic(Eigen::Index axis) const
    {
        return length[axis] > 0;
    }

    /// The image of a position that lies in the box.
    Vector3d wrapped(Vector3d position) const
    {
        for (Eigen::Index axis = 0; axis < 3; ++axis)
        {
            if (isPeriodic(axis))
            {
                position[axis] -= std::floor((position[axis] - low[axis]) / length[axis]) * length[axis];
            }
        }
        return position;
    }

    /// The shortest of the vectors between images of two points. \param apart  between any two of them
    Vector3d nearest(Vector3d apart) const
    {
        for (Eigen::Index axis = 0; axis < 3; ++axis)
        {
            if (isPeriodic(axis))
            {
                apart[axis] -= std::round(apart[axis] / length[axis]) * length[axis];
            }
        }
        return apart;
    }

    /// The image of a position that is `periods` lengths away.
    Vector3d image(const Vector3d& position, const Eigen::Vector3i& periods) const
    {
        return position + periods.cast<double>().cwiseProduct(length);
    }

    /// Whether an image of `moving` intersects `fixed`.
    bool imagesIntersect(const Box& moving, const Box& fixed) const
    {
        if (!isPeriodic() || moving.isEmpty() || fixed.isEmpty())
        {
            return moving.intersects(fixed);
        }
        for (Eigen::Index axis = 0; axis < 3; ++axis)
        {
            const double first = fixed.min()[axis] - moving.max()[axis];
            const double last = fixed.max()[axis] - moving.min()[axis];
            const bool meet = isPeriodic(axis) ? std::ceil(first / length[axis]) <= std::floor(last / length[axis])
                                               : first <= 0 && last >= 0;
            if (!meet)
            {
                return false;
            }
        }
        return true;
    }

    /// Calls `act(image, periods)` for each image of a sphere's centre whose cube meets a box (cubeMeets()).
    template<class Act>
    void forEachImage(const Box& box, const Vector3d& centre, double radius, const Act& act) const
    {
        if (!isPeriodic() || box.isEmpty())
        {
            if (cubeMeets(box, centre, radius))
            {
                act(centre, Eigen::Vector3i(0, 0, 0));
            }
            return;
        }
        Eigen::Vector3i first = Eigen::Vector3i::Zero();
        Eigen::Vector3i last = Eigen::Vector3i::Zero();
        for (Eigen::Index axis = 0; axis < 3; ++axis)
        {
            if (isPeriodic(axis))
            {
                first[axis] = static_cast<int>(std::floor((box.min()[axis] - radius - centre[axis]) / length[axis]));
                last[axis] = static_cast<int>(std::ceil((box.max()[axis] + radius - centre[axis]) / length[axis]));
            }
        }
        Eigen::Vector3i periods;
        for (periods.z() = first.z(); periods.z() <= last.z(); ++periods.z())
        {
            for (periods.y() = first.y(); periods.y() <= last.y(); ++periods.y())
            {
                for (periods.x() = first.x(); periods.x() <= last.x(); ++periods.x())
                {
                    if (const Vector3d at = image(centre, periods); cubeMeets(box, at, radius))
                    {
                        act(at, periods);
                    }
                }
            }
        }
    }
};

} // namespace clepsydra
