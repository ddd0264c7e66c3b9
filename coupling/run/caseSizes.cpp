#include "run/caseSizes.h"

#include "distribution/lengthOfChange.h"

#include "PstreamReduceOps.H"
#include "globalMeshData.H"
#include "runTimeSelection.h"


namespace clepsydra
{

namespace
{

/// Below it a rank has more to send than to solve.
constexpr label fewCellsOfRank = 100;

/// In lengths of the mesh. Two spread the disturbance of an isolated particle evenly, and cases do so on purpose; more is a slip.
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

    Info << "Sizes" << nl << "    mesh           " << span << " m, " << cells << " cells of " << cellWidth
         << " m in the mean, at least " << fewestCells << " on each of " << Pstream::nProcs() << " ranks" << nl
         << "    largest particle   " << largest << " m, " << largest / cellWidth << " cells" << nl
         << "    smoothing      " << smoothingBandwidth << " m" << nl << endl;

    if (largest > cmptMin(span))
    {
        FatalIOErrorInFunction(couplingProperties)
            << "A particle of the DEM script has a diameter of " << largest << " m and the mesh spans " << span
            << " m; allowed: particles that are smaller than the mesh is thin" << exit(FatalIOError);
    }
    if (smoothingBandwidth > longestSmoothing * cmptMax(span))
    {
        FatalIOErrorInFunction(couplingProperties)
            << "Entry 'bandwidth' is " << smoothingBandwidth << " m and the mesh spans " << span
            << " m; allowed: at most " << longestSmoothing
            << " times its length, which spreads particles evenly over it" << exit(FatalIOError);
    }
    if (largest > lengthOfChange(smoothingBandwidth, cellWidth))
    {
        warn("A particle of " + Foam::name(largest) + " m is wider than the cells, " + Foam::name(cellWidth)
             + " m, and than the smoothing bandwidth, " + Foam::name(smoothingBandwidth)
             + " m: the void fraction near it may be clipped; usual is a bandwidth of 2 to 4 diameters");
    }
    if (fewestCells < fewCellsOfRank && Pstream::parRun())
    {
        warn("A rank has " + Foam::name(fewestCells) + " of the mesh's " + Foam::name(cells)
             + " cells: fewer ranks are faster");
    }
}

} // namespace clepsydra
