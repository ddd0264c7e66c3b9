#pragma once

#include "fvMesh.H"
#include "globalMeshData.H"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

/// Width of a cube with the volume of the smallest cell [m]. Collective.
inline double smallestCellWidth(const Foam::fvMesh& mesh)
{
    return std::cbrt(Foam::gMin(mesh.cellVolumes()));
}

/// Width of a cube with the cells' mean volume [m]. Collective.
inline double meanCellWidth(const Foam::fvMesh& mesh)
{
    return std::cbrt(Foam::gSum(mesh.cellVolumes()) / mesh.globalData().nTotalCells());
}

/// Length over which the fluid around a particle changes [m]: the smoothing bandwidth, or the cell width where that is
/// larger.
inline double lengthOfChange(double smoothingBandwidth, double cellWidth)
{
    return std::max(smoothingBandwidth, cellWidth);
}

} // namespace clepsydra
