/// \file
/// G. G. Stokes, Trans. Camb. Phil. Soc. 9, 8 (1851): F = 3 pi mu d U_r, an isolated particle in creeping flow,
/// Re << 1. The law does not depend on the void fraction, so models A and B agree only at eps = 1.
#pragma once

#include "closures/particleInFluid.h"

namespace clepsydra::closures
{

struct StokesDrag
{
    static constexpr const char* name = "StokesDrag";
    static constexpr const char* line = "drag of isolated particles, Re << 1 (Stokes 1851)";

    double operator()(const ParticleInFluid& particle) const noexcept
    {
        return stokesCoefficient(particle);
    }
};

} // namespace clepsydra::closures
