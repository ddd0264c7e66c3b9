// Compiled without fused multiply-add, so that rounding is the same as in LIGGGHTS: see CMakeLists.txt.
#include "engine/liggghts/nearSpheres.h"

#include "vectorUnits.h"

namespace clepsydra
{

CLEPSYDRA_FOR_VECTOR_UNITS void markNear(
    Spheres& spheres, std::size_t first, std::size_t last, std::size_t of, const Nearness& nearness)
{
    const double* const x = spheres.x.data();
    const double* const y = spheres.y.data();
    const double* const z = spheres.z.data();
    const double* const radius = spheres.radius.data();
    double* __restrict const distanceSquared = spheres.distanceSquared.data();
    char* __restrict const isNear = spheres.isNear.data();
    const double atX = x[of];
    const double atY = y[of];
    const double atZ = z[of];
    const double ofRadius = radius[of];
    const auto [radiusFactor, skin] = nearness;
    for (std::size_t k = first; k < last; ++k)
    {
        const double dx = atX - x[k];
        const double dy = atY - y[k];
        const double dz = atZ - z[k];
        const double squared = dx * dx + dy * dy + dz * dz;
        const double reach = (ofRadius + radius[k]) * radiusFactor + skin;
        distanceSquared[k] = squared;
        isNear[k] = squared <= reach * reach ? 1 : 0;
    }
}

} // namespace clepsydra
