#pragma once

#include <cstddef>
#include <vector>

namespace clepsydra
{

/// Spheres with each coordinate of all of them side by side for vector units. SI units.
struct Spheres
{
    std::vector<double> x;
    std::vector<double> y;
    std::vector<double> z;
    std::vector<double> radius;
    /// Results of markNear: the square of the distance of the centres, and 1 for spheres that are near, otherwise 0.
    std::vector<double> distanceSquared;
    std::vector<char> isNear;

    void resize(std::size_t count)
    {
        for (std::vector<double>* values : {&x, &y, &z, &radius, &distanceSquared})
        {
            values->resize(count);
        }
        isNear.resize(count);
    }
};

/// When two spheres are near each other: if their centres are no further apart than the sum of their radii, times
/// `radiusFactor`, plus `skin`.
struct Nearness
{
    double radiusFactor;
    double skin;
};

/// Finds which of the spheres from `first` to before `last` are near the sphere `of`. It has LIGGGHTS' operations in their
/// order, so a pair at the limit is decided as LIGGGHTS decides it.
void markNear(Spheres& spheres, std::size_t first, std::size_t last, std::size_t of, const Nearness& nearness);

} // namespace clepsydra
