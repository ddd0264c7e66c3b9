#include "run/caseSizes.h"

#include "distribution/lengthOfChange.h"

#include "PstreamReduceOps.H"
#include "globalMeshData.H"
#include "runTimeSelection.h"


namespace clepsydra
{

namespace
{

/// A rank with fewer cells spends more time on communication than on solving.
constexpr label fewCellsOfRank = 100;

/// Largest bandwidth in lengths of the mesh. Cases use two on purpose, to spread the disturbance of an isolated
/// particle evenly; ten is an error of the unit.
constexpr scalar longestSmoothing = 10;

bool isParticleDiameter(const std::string& name)
{
    return name.find("article") != std::string::npos && name.find("iameter") != std::string::npos;
}

void warn(const std::string& message)
{
    if (Pstream::master())
    {
        WarningInFunction << message.c_str() << endl;
    }
}

} // namespace

void requireParticlesWithinMesh(const dictionary& variables, const boundBox& mesh)
{
    for (const word& name : variables.toc())
    {
        scalar diameter = 0;
        const bool isNumber = variables.lookup(name).size() == 1 && variables.lookup(name)[0].isNumber();
        if (isParticleDiameter(name) && isNumber && variables.readEntry(name, diameter)
            && diameter > cmptMax(mesh.span()))
        {
            FatalIOErrorInFunction(variables)
                << "Entry '" << name << "' is " << diameter << " m and the mesh spans " << mesh.span()
                << " m; allowed: particles that are smaller than the mesh, all lengths in m" << exit(FatalIOError);
        }
    }
}

void checkCaseSizes(
    const fvMesh& mesh, const ParticlesView& particles, double smoothingBandwidth, const dictionary& couplingProperties)
{
    const double largest = returnReduce(particles.size() > 0 ? 2 * particles.radius.maxCoeff() : 0.0, maxOp<scalar>());
    const vector span = mesh.bounds().span();
    const label cells = mesh.globalData().nTotalCells();
    const double cellWidth = meanCellWidth(mesh);
    const label fewestCells = returnReduce(mesh.nCells(), minOp<label>());

    Info << "Sizes" << nl << "    mesh               " << span << " m, " << cells << " cells of " << cellWidth
         << " m mean width, at least " << fewestCells << " on each of " << Pstream::nProcs() << " ranks" << nl
         << "    largest particle   " << largest << " m, " << largest / cellWidth << " cells" << nl
         << "    smoothing          " << smoothingBandwidth << " m" << nl << endl;

    if (largest > cmptMin(span))
    {
        FatalIOErrorInFunction(couplingProperties)
            << "A particle of the DEM script has a diameter of " << largest << " m, but the mesh spans " << span
            << " m; allowed: particles that are smaller than each extent of the mesh" << exit(FatalIOError);
    }
    if (smoothingBandwidth > longestSmoothing * cmptMax(span))
    {
        FatalIOErrorInFunction(couplingProperties)
            << "Entry 'bandwidth' is " << smoothingBandwidth << " m, but the mesh spans " << span
            << " m; allowed: at most " << longestSmoothing
            << " times its length, which spreads particles evenly over it" << exit(FatalIOError);
    }
    if (largest > lengthOfChange(smoothingBandwidth, cellWidth))
    {
        warn("A particle with a diameter of " + Foam::name(largest) + " m is wider than the cells, "
             + Foam::name(cellWidth) + " m, and than the smoothing bandwidth, " + Foam::name(smoothingBandwidth)
             + " m: the void fraction near it may be clipped; a bandwidth of 2 to 4 diameters is usual");
    }
    if (fewestCells < fewCellsOfRank && Pstream::parRun())
    {
        warn("A rank has " + Foam::name(fewestCells) + " of the mesh's " + Foam::name(cells)
             + " cells; a run on fewer ranks is faster");
    }
}

} // namespace clepsydra
