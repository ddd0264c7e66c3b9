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

/// In lengths of the mesh. Two spread the disturbance of a lone bead evenly, and cases do so on purpose; more is a slip.
constexpr scalar longestSmoothing = 10;

bool isBeadDiameter(const std::string& name)
{
    return name.find("ead") != std::string::npos && name.find("iameter") != std::string::npos;
}

void warn(const std::string& message)
{
    if (Pstream::master())
    {
        WarningInFunction << message.c_str() << endl;
    }
}

} // namespace

void requireBeadsWithinMesh(const dictionary& variables, const boundBox& mesh)
{
    for (const word& name : variables.toc())
    {
        scalar diameter = 0;
        const bool isNumber = variables.lookup(name).size() == 1 && variables.lookup(name)[0].isNumber();
        if (isBeadDiameter(name) && isNumber && variables.readEntry(name, diameter) && diameter > cmptMax(mesh.span()))
        {
            FatalIOErrorInFunction(variables)
                << "Entry '" << name << "' is " << diameter << " m and the mesh spans " << mesh.span()
                << " m; allowed: beads that are smaller than the mesh, all lengths in m" << exit(FatalIOError);
        }
    }
}

void checkCaseSizes(
    const fvMesh& mesh, const BeadsView& beads, double smoothingLength, const dictionary& couplingProperties)
{
    const double largest = returnReduce(beads.size() > 0 ? 2 * beads.radius.maxCoeff() : 0.0, maxOp<scalar>());
    const vector span = mesh.bounds().span();
    const label cells = mesh.globalData().nTotalCells();
    const double cellWidth = meanCellWidth(mesh);
    const label fewestCells = returnReduce(mesh.nCells(), minOp<label>());

    Info << "Sizes" << nl << "    mesh           " << span << " m, " << cells << " cells of " << cellWidth
         << " m in the mean, at least " << fewestCells << " on each of " << Pstream::nProcs() << " ranks" << nl
         << "    largest bead   " << largest << " m, " << largest / cellWidth << " cells" << nl << "    smoothing      "
         << smoothingLength << " m" << nl << endl;

    if (largest > cmptMin(span))
    {
        FatalIOErrorInFunction(couplingProperties)
            << "A bead of the DEM script has a diameter of " << largest << " m and the mesh spans " << span
            << " m; allowed: beads that are smaller than the mesh is thin" << exit(FatalIOError);
    }
    if (smoothingLength > longestSmoothing * cmptMax(span))
    {
        FatalIOErrorInFunction(couplingProperties)
            << "Entry 'smoothingLength' is " << smoothingLength << " m and the mesh spans " << span
            << " m; allowed: at most " << longestSmoothing << " times its length, which spreads beads evenly over it"
            << exit(FatalIOError);
    }
    if (largest > lengthOfChange(smoothingLength, cellWidth))
    {
        warn("A bead of " + Foam::name(largest) + " m is wider than the cells, " + Foam::name(cellWidth)
             + " m, and than the smoothing length, " + Foam::name(smoothingLength)
             + " m: the void fraction near it may be clipped; usual is a smoothingLength of 2 to 4 diameters");
    }
    if (fewestCells < fewCellsOfRank && Pstream::parRun())
    {
        warn("A rank has " + Foam::name(fewestCells) + " of the mesh's " + Foam::name(cells)
             + " cells: fewer ranks are faster");
    }
}

} // namespace clepsydra
