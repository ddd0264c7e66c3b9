#pragma once

#include <map>
#include <string>

namespace clepsydra
{

/// Estimates the time that the rest of a run will take, from the time that it has taken so far:
///
///     seconds = perParticleStep n_particles n_steps + (perParticle n_particles + perCouplingStep) n_couplingSteps
///
/// The coefficients are measured in the run, each from the time of its own phases: DEM and forces; locating cells and
/// exchange; all others, whose time depends on the cells of the mesh. The estimate is therefore valid on any machine
/// and any number of ranks, and it takes changes of the number of particles and of the coupling step into account; it
/// does not predict changes of the flow that change the cost of an iteration or a contact. (In
/// scripts/developers/benchmarks/cost_model.py the last coefficient depends on the number of cells.)
class CostModel
{
public:
    /// \param seconds  time of each phase before the start of the measurement; the phase "other" of PhaseTimers is
    /// never counted
    explicit CostModel(std::map<std::string, double> seconds = {});

    /// Adds a coupling step that has been completed.
    void add(double particles, double demSteps);

    double couplingSteps() const
    {
        return couplingSteps_;
    }

    /// Time that the rest of the run will take [s]. \pre couplingSteps() > 0
    /// \param seconds  time of each phase so far
    /// \param particles  number of particles in the rest of the run
    /// \param demSteps, couplingSteps  number of steps that are left
    double secondsLeft(
        const std::map<std::string, double>& seconds, double particles, double demSteps, double couplingSteps) const;

private:
    std::map<std::string, double> before_;
    double couplingSteps_ = 0;
    double particleCouplingSteps_ = 0;
    double particleSteps_ = 0;
};

} // namespace clepsydra
