#pragma once

#include "fvMesh.H"
#include "globalMeshData.H"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

/// Width of a cube as large as the smallest cell [m]. Collective.
inline double smallestCellWidth(const Foam::fvMesh& mesh)
{
    return std::cbrt(Foam::gMin(mesh.cellVolumes()));
}

/// Width of a cube as large as the cells are in the mean [m]. Collective.
inline double meanCellWidth(const Foam::fvMesh& mesh)
{
    return std::cbrt(Foam::gSum(mesh.cellVolumes()) / mesh.globalData().nTotalCells());
}

/// The length over which the fluid changes that a particle meets [m]: the smoothing bandwidth, or a cell where that is wider.
inline double lengthOfChange(double smoothingBandwidth, double cellWidth)
{
    return std::max(smoothingBandwidth, cellWidth);
}

} // namespace clepsydra
