#pragma once

#include "couplingStep/fluidCourantNumber.h"
#include "engine/particles.h"
#include "rankTotals.h"

#include "fvMesh.H"

namespace clepsydra
{

/// Checks after every coupling step of a run with fluid whether the pressure was solved to its tolerance, whether
/// particles travel little enough in a coupling step for the fluid at them to be taken as frozen, and whether the fluid
/// passes more than a cell in it.
///
/// The first violation of each is a warning, and violations are counted; a run in which the first two persist ends with a
/// FatalError.
class RunChecks
{
public:
    /// \param smoothingBandwidth  [m], 0 without smoothing
    RunChecks(const Foam::fvMesh& mesh, double smoothingBandwidth);

    /// Adds the largest velocity of a particle to the totals. Call when the fluid has been solved. Local.
    void addTo(const ParticlesView& particles, RankTotals& totals);

    /// Call when these totals have been reduced. Local.
    /// \param courantNumber  at the end of this coupling step
    void afterCouplingStep(const FluidCourantNumber& courantNumber);

    /// Warns where a large part of the particles in beds is so near to clear fluid that the smoothed void fraction is
    /// not that of the bed. \param partNearClearFluid  see bedEdge.h
    void checkBed(double partNearClearFluid);

    /// Prints the number of violations, where there were any.
    void report() const;

private:
    void checkConvergence();
    void checkTravel();
    void checkCourantNumber(const FluidCourantNumber& courantNumber);

    /// A particle and its velocity [m/s].
    struct Fastest
    {
        int id = 0;
        double speed = 0;
    };

    const Foam::fvMesh& mesh_;
    const double smoothingBandwidth_;
    /// Computed with the mean width of the cells [m], because locally refined cells are no reason for a warning.
    const double lengthOfChange_;
    long couplingSteps_ = 0;
    long unconverged_ = 0;
    long unconvergedInRow_ = 0;
    long fast_ = 0;
    long fastFluid_ = 0;
    /// Of this rank's particles in the mesh.
    Fastest fastestHere_;
    /// Over all ranks [m/s].
    double largestSpeed_ = 0;
};

} // namespace clepsydra
