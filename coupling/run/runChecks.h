#pragma once

#include "engine/particles.h"

#include "fvMesh.H"

namespace clepsydra
{

/// What is looked at after every interval of a run with fluid: whether the pressure was solved to its tolerance,
/// and whether particles move on little enough in an interval for the fluid at them to be taken as frozen.
///
/// Both are warnings at first, and counted; a run that goes on like that is ended by a FatalError.
class RunChecks
{
public:
    /// \param smoothingBandwidth  [m], 0 without smoothing
    RunChecks(const Foam::fvMesh& mesh, double smoothingBandwidth);

    /// Collective; when the fluid is solved.
    void afterCouplingStep(const ParticlesView& particles);

    /// How often there was reason to warn, where there was.
    void report() const;

private:
    void checkConvergence();
    void checkTravel(const ParticlesView& particles);

    const Foam::fvMesh& mesh_;
    /// By the cells' mean width [m]: refined cells somewhere are no reason to warn.
    const double lengthOfChange_;
    long couplingSteps_ = 0;
    long unconverged_ = 0;
    long unconvergedInRow_ = 0;
    long fast_ = 0;
};

} // namespace clepsydra
