#include "distribution/sphereInBox.h"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

namespace
{

constexpr double pi = 3.14159265358979323846;
constexpr double volumeOfUnitSphere = 4 * pi / 3;

/// a (3 - a2) for the circle in which the plane at distance a cuts the sphere: the contributions of its arc on the
/// sphere's surface and of the cone from it to the centre.
double ofCircle(double a)
{
    return a * (3 - a * a);
}

} // namespace

double partInHalfSpace(double distance)
{
    if (distance >= 1)
    {
        return 1;
    }
    return distance <= -1 ? 0 : 0.25 * (2 + ofCircle(distance));
}

// The distances are sorted first, so that the parts are the same to the last bit whatever the caches hold.
//
// Where planes at right angles cut the unit sphere, the part beyond them is a third of its surface on the sphere less
// the cones from the centre to its plane sides (divergence theorem). The surface on the sphere follows from its arcs
// and the angles between them (Gauss-Bonnet theorem): an arc at distance a that spans theta has the curvature a theta,
// and two arcs at distances a and b meet at the angle of the complex number (a b, h), h2 = 1 - a2 - b2.

double SphereInBox::beyondEdgeOfPositive(double a, double b)
{
    if (a > b)
    {
        std::swap(a, b);
    }
    const double heightSqr = 1 - a * a - b * b;
    if (heightSqr <= 0)
    {
        return 0;
    }
    for (const CachedPart<2>& edge : edges_)
    {
        if (edge.part > 0 && edge.distances[0] == a && edge.distances[1] == b)
        {
            return edge.part;
        }
    }
    const double h = std::sqrt(heightSqr);
    const double volume =
        (2 * std::atan2(h, a * b) - ofCircle(a) * std::atan2(h, b) - ofCircle(b) * std::atan2(h, a) + 2 * a * b * h)
        / 3;
    edges_[nextEdge_] = {{a, b}, volume / volumeOfUnitSphere};
    nextEdge_ = (nextEdge_ + 1) % edges_.size();
    return volume / volumeOfUnitSphere;
}

double SphereInBox::beyondCornerOfPositive(double a, double b, double c)
{
    if (a * a + b * b + c * c >= 1)
    {
        return 0;
    }
    if (a > b)
    {
        std::swap(a, b);
    }
    if (b > c)
    {
        std::swap(b, c);
    }
    if (a > b)
    {
        std::swap(a, b);
    }
    const std::array<double, 3> distances{a, b, c};
    if (corner_.part > 0 && corner_.distances == distances)
    {
        return corner_.part;
    }
    const double hab = std::sqrt(1 - a * a - b * b);
    const double hbc = std::sqrt(1 - b * b - c * c);
    const double hca = std::sqrt(1 - c * c - a * a);
    // Sum of the three angles less pi.
    const double twoReal = a * b * b * c - hab * hbc;
    const double twoImaginary = a * b * hbc + b * c * hab;
    const double excess = std::atan2(-twoReal * hca - twoImaginary * c * a, twoImaginary * hca - twoReal * c * a);
    // The quarter circle around the projection of the centre onto the plane at distance a, between the planes b and c.
    const auto span = [](double p, double q, double hToP, double hToQ) {
        return std::atan2(hToP * hToQ - p * q, p * hToQ + q * hToP);
    };
    const double volume =
        (excess - 0.5 * ofCircle(a) * span(b, c, hab, hca) - 0.5 * ofCircle(b) * span(c, a, hbc, hab)
            - 0.5 * ofCircle(c) * span(a, b, hca, hbc) + a * b * (hab - c) + b * c * (hbc - a) + c * a * (hca - b))
        / 3;
    corner_ = {distances, std::max(volume, 0.0) / volumeOfUnitSphere};
    return corner_.part;
}

// For a plane on the other side of the centre: the part beyond the other planes less the part that is beyond them and
// behind this plane.

double SphereInBox::beyondEdge(double a, double b)
{
    if (a < 0)
    {
        return partInHalfSpace(-b) - beyondEdge(-a, b);
    }
    return b < 0 ? partInHalfSpace(-a) - beyondEdgeOfPositive(a, -b) : beyondEdgeOfPositive(a, b);
}

double SphereInBox::beyondCorner(double a, double b, double c)
{
    if (a < 0)
    {
        return beyondEdge(b, c) - beyondCorner(-a, b, c);
    }
    if (b < 0)
    {
        return beyondEdge(a, c) - beyondCorner(a, -b, c);
    }
    return c < 0 ? beyondEdge(a, b) - beyondCornerOfPositive(a, b, -c) : beyondCornerOfPositive(a, b, c);
}

double SphereInBox::operator()(const std::array<SlabAboutSphere, 3>& slabs)
{
    // The box is what lies beyond its low planes and not beyond its high ones along each axis. It is a sum over all
    // choices of one plane per axis, whose sign is that of the number of high planes. Planes that do not cut the sphere
    // drop out.
    struct Plane
    {
        double distance;
        double sign;
    };
    std::array<std::array<Plane, 2>, 3> cuts;
    std::array<int, 3> cutCount{};
    int axes = 0;
    double outsideSqr = 0;
    for (const SlabAboutSphere& slab : slabs)
    {
        const double outside = std::max({0.0, -slab.low, -slab.high});
        outsideSqr += outside * outside;
        if (outsideSqr >= 1)
        {
            return 0;
        }
        if (slab.low >= 1 && slab.high >= 1)
        {
            continue;
        }
        int& count = cutCount[axes];
        // A single plane that cuts is treated as a low one, seen from its own side.
        cuts[axes][count++] = {-std::min(slab.low, slab.high), 1};
        if (slab.low < 1 && slab.high < 1)
        {
            cuts[axes][count++] = {std::max(slab.low, slab.high), -1};
        }
        ++axes;
    }
    double part = axes == 0 ? 1 : 0;
    const auto over = [&](int axis, auto&& act) {
        for (int cut = 0; cut < cutCount[axis]; ++cut)
        {
            act(cuts[axis][cut]);
        }
    };
    if (axes == 1)
    {
        over(0, [&](const Plane& a) { part += a.sign * partInHalfSpace(-a.distance); });
    }
    else if (axes == 2)
    {
        over(0, [&](const Plane& a) {
            over(1, [&](const Plane& b) { part += a.sign * b.sign * beyondEdge(a.distance, b.distance); });
        });
    }
    else if (axes == 3)
    {
        over(0, [&](const Plane& a) {
            over(1, [&](const Plane& b) {
                over(2, [&](const Plane& c) {
                    part += a.sign * b.sign * c.sign * beyondCorner(a.distance, b.distance, c.distance);
                });
            });
        });
    }
    return std::max(part, 0.0);
}

} // namespace clepsydra
