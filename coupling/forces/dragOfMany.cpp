// Compiled with -ffast-math, see CMakeLists.txt: only then does the compiler use the C library's vector versions of the
// exponential and the logarithm. This file must contain nothing but the drag laws.
#include "forces/dragOfMany.h"

#include "closures/dragLaws.h"
#include "vectorUnits.h"

namespace clepsydra
{

namespace
{

template<class Law>
CLEPSYDRA_FOR_VECTOR_UNITS void evaluate(const ManyParticlesInFluid& particles, ManyCoefficients& coefficients)
{
    const Law law;
    for (std::size_t particle = 0; particle < particles.count; ++particle)
    {
        coefficients[particle] =
            law({particles.diameter[particle], particles.voidFraction[particle], particles.logVoidFraction[particle],
                particles.slipSpeed[particle], particles.density, particles.dynamicViscosity});
    }
}

template<class... Laws>
DragOfMany find(const std::string& name, std::tuple<Laws...>)
{
    DragOfMany found = nullptr;
    ((found = name == Laws::name ? &evaluate<Laws> : found), ...);
    return found;
}

} // namespace

DragOfMany dragOfMany(const std::string& name)
{
    const DragOfMany found = find(name, closures::DragLaws{});
    if (!found)
    {
        throw std::invalid_argument("no drag law '" + name + "'");
    }
    return found;
}

} // namespace clepsydra
