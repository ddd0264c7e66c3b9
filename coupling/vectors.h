#pragma once

#include "engine/particles.h"

#include "vectorField.H"

namespace clepsydra
{

// The only place where vectors are converted between the engine's side of the coupling (Eigen) and OpenFOAM.

inline Vector3d toEigen(const Foam::vector& v)
{
    return {v.x(), v.y(), v.z()};
}

inline Foam::vector toFoam(const Vector3d& v)
{
    return {v.x(), v.y(), v.z()};
}

/// The values of a field as columns, without a copy.
inline Eigen::Map<const Eigen::Matrix3Xd> columns(const Foam::vectorField& field)
{
    return {field.empty() ? nullptr : field.cdata()->v_, 3, field.size()};
}

inline Eigen::Map<Eigen::Matrix3Xd> columns(Foam::vectorField& field)
{
    return {field.empty() ? nullptr : field.data()->v_, 3, field.size()};
}

inline Eigen::Map<const Eigen::RowVectorXd> columns(const Foam::scalarField& field)
{
    return {field.cdata(), field.size()};
}

inline Eigen::Map<Eigen::RowVectorXd> columns(Foam::scalarField& field)
{
    return {field.data(), field.size()};
}

} // namespace clepsydra
