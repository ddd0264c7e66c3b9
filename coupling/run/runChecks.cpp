#include "run/runChecks.h"

#include "couplingState.h"
#include "distribution/lengthOfChange.h"
#include "openfoam/compatibility.h"

#include "Pstream.H"
#include "globalMeshData.H"
#include "solverPerformance.H"

#include <sstream>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// A run ends after this number of consecutive coupling steps without convergence.
constexpr long mostUnconvergedInRow = 50;

/// A run ends where a particle travels this many lengths of change of the fluid in one coupling step.
constexpr double farthestTravel = 10;

/// Part of the cells with a Courant number above 1 above which there is a warning: a few small ones are no reason.
constexpr double mostFastCells = 0.01;

/// Part of the particles within a bandwidth of clear fluid above which there is a warning: that of a bed six bandwidths
/// high with clear fluid on both sides.
constexpr double largestPartNearClearFluid = 1.0 / 3;

} // namespace

RunChecks::RunChecks(const fvMesh& mesh, double smoothingBandwidth)
    : mesh_(mesh),
      smoothingBandwidth_(smoothingBandwidth),
      lengthOfChange_(lengthOfChange(smoothingBandwidth, meanCellWidth(mesh)))
{}

void RunChecks::addTo(const ParticlesView& particles, RankTotals& totals)
{
    fastestHere_ = Fastest();
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const double speed = particles.velocity.col(particle).norm();
        // Not one that is outside the mesh or beyond an outlet.
        if (speed > fastestHere_.speed && particles.state[particle].part.share > 0)
        {
            fastestHere_ = {particles.id[particle], speed};
        }
    }
    totals.add({{}, {fastestHere_.speed}}, [this](const RankNumbers& all) { largestSpeed_ = all.maxima[0]; });
}

void RunChecks::afterCouplingStep(const FluidCourantNumber& courantNumber)
{
    ++couplingSteps_;
    checkConvergence();
    checkTravel();
    checkCourantNumber(courantNumber);
}

void RunChecks::checkConvergence()
{
    // OpenFOAM does not store whether the velocity has converged.
    List<solverPerformance> solutions;
    if (!solverPerformanceDict(mesh_).readIfPresent("p", solutions) || solutions.empty()
        || solutions.last().converged())
    {
        unconvergedInRow_ = 0;
        return;
    }
    const solverPerformance& last = solutions.last();
    ++unconverged_;
    ++unconvergedInRow_;
    std::ostringstream text;
    text << "The pressure was not solved to its tolerance: " << last.solverName() << " stopped after "
         << last.nIterations() << " iterations at a residual of " << last.finalResidual()
         << ". More iterations (maxIter) or a larger tolerance in system/fvSolution, or a mesh of better quality";
    const std::string message = text.str();
    if (unconvergedInRow_ >= mostUnconvergedInRow)
    {
        FatalErrorInFunction << message.c_str() << " is needed; this was so in the last " << label(unconvergedInRow_)
                             << " coupling steps" << exit(FatalError);
    }
    if (unconverged_ == 1 && Pstream::master())
    {
        WarningInFunction << message.c_str()
                          << " may be needed. This warning is printed once, and such steps are counted" << endl;
    }
}

void RunChecks::checkTravel()
{
    const double speed = largestSpeed_;
    const double timeStep = mesh_.time().deltaTValue();
    const double travel = speed * timeStep / lengthOfChange_;
    if (travel <= 1)
    {
        return;
    }
    ++fast_;
    std::ostringstream text;
    text << "moves " << speed << " m/s, hence " << speed * timeStep << " m in a coupling step of " << timeStep
         << " s. That is " << travel << " times the length over which the fluid changes (smoothing bandwidth or cell), "
         << lengthOfChange_ << " m, but the fluid at a particle is frozen during a coupling step";
    if (travel > farthestTravel && fastestHere_.speed == speed)
    {
        FatalErrorInFunction << "Particle " << fastestHere_.id << ' ' << text.str().c_str() << "; allowed: at most "
                             << farthestTravel << " times, by a shorter couplingTimeStep (and deltaT), "
                             << farthestTravel * lengthOfChange_ / speed << " s here" << exit(FatalError);
    }
    if (fast_ == 1 && Pstream::master())
    {
        WarningInFunction << "A particle " << text.str().c_str()
                          << ". This warning is printed once, and such steps are counted" << endl;
    }
}

void RunChecks::checkCourantNumber(const FluidCourantNumber& courantNumber)
{
    const label fastCells = courantNumber.cellsAboveOne();
    const label cells = mesh_.globalData().nTotalCells();
    if (fastCells <= mostFastCells * cells)
    {
        return;
    }
    ++fastFluid_;
    const double timeStep = mesh_.time().deltaTValue();
    const double largest = timeStep * courantNumber.largestPerTime();
    if (fastFluid_ == 1 && Pstream::master())
    {
        WarningInFunction << "The fluid passes more than a cell in a coupling step of " << timeStep << " s in "
                          << fastCells << " of " << cells << " cells, at most " << largest
                          << " cells (Courant number). The solution is stable, but smears what moves with the fluid; a "
                          << "couplingTimeStep (and deltaT) of " << timeStep / largest
                          << " s resolves it. This warning is printed once, and such steps are counted" << endl;
    }
}

void RunChecks::checkBed(double partNearClearFluid)
{
    if (partNearClearFluid > largestPartNearClearFluid && Pstream::master())
    {
        WarningInFunction << "Of the particles in beds a part of " << partNearClearFluid
                          << " is within a smoothing bandwidth of clear fluid, " << smoothingBandwidth_
                          << " m. There the smoothed void fraction is larger than that of the bed, and drag is too "
                          << "small; a bed three bandwidths high between clear fluid has half of its drag. Decrease "
                          << "bandwidth in constDiffSmoothingProps to a sixth of the bed's height, or let the mesh end "
                          << "at the floor on which the bed lies" << endl;
    }
}

void RunChecks::report() const
{
    if (unconverged_ > 0)
    {
        Info << "WARNING: the pressure was not solved to its tolerance in " << label(unconverged_) << " of "
             << label(couplingSteps_) << " coupling steps" << nl;
    }
    if (fast_ > 0)
    {
        Info << "WARNING: particles moved farther than the length over which the fluid changes in " << label(fast_)
             << " of " << label(couplingSteps_) << " coupling steps: couplingTimeStep is too long" << nl;
    }
    if (fastFluid_ > 0)
    {
        Info << "WARNING: the fluid passed more than a cell (Courant number above 1) in " << label(fastFluid_) << " of "
             << label(couplingSteps_) << " coupling steps" << nl;
    }
}

} // namespace clepsydra
