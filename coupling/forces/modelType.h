#pragma once

#include "runTimeSelection.h"

namespace clepsydra
{

/// How the fluid's pressure gradient and viscous stress are shared with the particles; Zhou, Kuang, Chu & Yu, J. Fluid
/// Mech. 661, 482 (2010).
///
/// A (their set II): the fluid keeps eps grad p, a particle feels drag, -V_p grad p and V_p div(tau).
/// B (their set III): the fluid keeps all of grad p and div(tau); a particle feels (drag + other forces)/eps.
/// Both with Archimedes' force, p being without its hydrostatic part. In a steady homogeneous bed they are the same.
enum class ModelType
{
    A,
    B
};

inline const ModelLines modelTypes(
    "modelType", {{"A", "the fluid keeps eps grad p; particles feel drag, -V grad p and V div(tau)"},
                     {"B", "the fluid keeps all of grad p and div(tau); particles feel drag/eps"}});

/// Entry `modelType` of couplingProperties. FatalIOError for anything but A and B.
inline ModelType readModelType(const Foam::dictionary& couplingProperties)
{
    return selectedModel(couplingProperties, "modelType", modelTypes.names()) == "B" ? ModelType::B : ModelType::A;
}

} // namespace clepsydra
