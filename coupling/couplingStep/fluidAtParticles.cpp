#include "couplingStep/fluidAtParticles.h"

namespace clepsydra
{

void FluidAtParticles::storeIn(const ParticlesView& particles) const
{
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        if (isOutsideMesh(particles.state[particle]))
        {
            particles.state[particle].fluid = FluidAtParticle();
            particles.state[particle].fluid.submergedFraction = 0;
            continue;
        }
        const double* value = values_.col(particle).data();
        for (const auto& [rows, store] : quantities_)
        {
            store(particles, particle, value);
            value += rows;
        }
    }
}

FluidAtParticles SampledFields::sampleAt(const LocatedParticles& particles) const
{
    Eigen::Index rows = 0;
    for (const Eigen::MatrixXd& values : inCells_)
    {
        rows += values.rows();
    }
    Eigen::MatrixXd all(rows, inCells_.front().cols());
    Eigen::Index row = 0;
    for (const Eigen::MatrixXd& values : inCells_)
    {
        all.middleRows(row, values.rows()) = values;
        row += values.rows();
    }
    FluidAtParticles sampled;
    sampled.values_ = particles.sample(all);
    sampled.quantities_ = quantities_;
    return sampled;
}

} // namespace clepsydra
