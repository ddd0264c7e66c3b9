#pragma once

#include <map>
#include <string>

namespace clepsydra
{

/// How long the rest of a run will take, from what the run itself has taken so far:
///
///     seconds = perParticleStep n_particles n_steps + (perParticle n_particles + perCouplingStep) n_couplingSteps
///
/// Its speeds are measured on the spot, each from the time of its own phases: DEM and forces; finding cells and the
/// exchange; all the rest, which goes with the cells of the mesh. So the estimate holds on any machine and on any number of
/// ranks, and follows where particles come and go, or the interval's length changes; not where the flow itself changes what an
/// iteration or a contact costs. (scripts/benchmarks/costModel.py has the last term by the number of cells.)
class CostModel
{
public:
    /// \param seconds  of each phase so far, which do not count: PhaseTimers' "other" never does
    explicit CostModel(std::map<std::string, double> seconds = {});

    /// One more interval has been done.
    void add(double particles, double demSteps);

    double couplingSteps() const
    {
        return couplingSteps_;
    }

    /// \param seconds  of each phase so far
    /// \param particles  in all that is left, as DEM steps and intervals are. \pre couplingSteps() > 0
    double secondsLeft(
        const std::map<std::string, double>& seconds, double particles, double demSteps, double couplingSteps) const;

private:
    std::map<std::string, double> before_;
    double couplingSteps_ = 0;
    double particleCouplingSteps_ = 0;
    double particleSteps_ = 0;
};

} // namespace clepsydra
