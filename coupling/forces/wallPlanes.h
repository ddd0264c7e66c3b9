#pragma once

#include "vectors.h"
#include "runTimeSelection.h"

#include "Tuple2.H"
#include "vector.H"

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace clepsydra
{

/// A plane wall. Its normal points to the side of the fluid.
struct WallPlane
{
    Eigen::Vector3d point;
    Eigen::Vector3d normal; // of length 1

    /// Distance of a point from the wall [m].
    double distance(const Eigen::Vector3d& position) const
    {
        return normal.dot(position - point);
    }

    /// Whether it is the same plane, but for the rounding of numbers that were typed twice.
    bool isSameAs(const WallPlane& other) const
    {
        constexpr double tolerance = 1e-9;
        return normal.dot(other.normal) > 1 - tolerance && std::abs(distance(other.point)) < tolerance;
    }
};

/// Reads the entry `walls ( ((point) (normal)) ... );`, which may be missing. FatalIOError for a normal of zero length.
inline std::vector<WallPlane> readWallPlanes(const Foam::dictionary& dict)
{
    using Plane = Foam::Tuple2<Foam::vector, Foam::vector>;
    std::vector<WallPlane> planes;
    for (const Plane& plane : dict.getOrDefault<Foam::List<Plane>>("walls", Foam::List<Plane>()))
    {
        const Foam::vector& point = plane.first();
        const Foam::vector& normal = plane.second();
        if (!(Foam::mag(normal) > 0))
        {
            FatalIOErrorInFunction(dict) << "Entry 'walls' has the normal " << normal
                                         << "; allowed: pairs of a point and a normal that is not zero"
                                         << Foam::exit(Foam::FatalIOError);
        }
        planes.push_back({toEigen(point), toEigen(normal).normalized()});
    }
    return planes;
}

} // namespace clepsydra
