#pragma once

#include <array>

namespace clepsydra
{

/// Two parallel planes near a sphere. Their distances from the sphere's centre are in radii, positive where the centre
/// is on the inner side. A plane at a distance above 1 does not cut the sphere.
struct SlabAboutSphere
{
    double low;
    double high;
};

/// Part of a sphere on the inner side of one plane. \param distance  as in SlabAboutSphere
double partInHalfSpace(double distance);

/// Part of a sphere in the box between three pairs of orthogonal planes, exact to 1e-15.
///
/// The last results are cached, because boxes around one sphere share edges and corners.
class SphereInBox
{
public:
    double operator()(const std::array<SlabAboutSphere, 3>& slabs);

private:
    /// Parts of the sphere beyond two or three planes at these distances from the centre.
    double beyondEdge(double a, double b);
    double beyondCorner(double a, double b, double c);
    double beyondEdgeOfPositive(double a, double b);
    double beyondCornerOfPositive(double a, double b, double c);

    template<int Planes>
    struct CachedPart
    {
        std::array<double, Planes> distances{};
        double part = 0;
    };
    std::array<CachedPart<2>, 4> edges_{};
    CachedPart<3> corner_{};
    std::size_t nextEdge_ = 0;
};

} // namespace clepsydra
