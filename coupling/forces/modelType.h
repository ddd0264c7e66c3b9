#pragma once

#include "runTimeSelection.h"

namespace clepsydra
{

/// How the fluid's pressure gradient and viscous stress are divided between fluid and particles; Zhou, Kuang, Chu & Yu,
/// J. Fluid Mech. 661, 482 (2010).
///
/// A (their set II): the fluid has eps grad p; the forces on a particle are drag, -V_p grad p and V_p div(tau). B
/// (their set III): the fluid has all of grad p and div(tau); the force on a particle is (drag + other forces)/eps.
/// Both add Archimedes' force, because p is without its hydrostatic part. In a steady homogeneous bed they are
/// equivalent.
enum class ModelType
{
    A,
    B
};

inline const ModelLines modelTypes(
    "modelType", {{"A", "the fluid has eps grad p; on a particle act drag, -V grad p and V div(tau)"},
                     {"B", "the fluid has all of grad p and div(tau); on a particle acts drag/eps"}});

/// Reads the entry `modelType` of couplingProperties. FatalIOError for anything but A and B.
inline ModelType readModelType(const Foam::dictionary& couplingProperties)
{
    return selectedModel(couplingProperties, "modelType", modelTypes.names()) == "B" ? ModelType::B : ModelType::A;
}

} // namespace clepsydra
