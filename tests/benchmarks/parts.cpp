/// \file
/// What the parts of a coupling step cost, with Google Benchmark: 4096 particles of 2 mm in a box of 16 x 16 x 32 cells
/// of 2.5 mm. `scripts/benchmark` times whole cases; this says which part to look at. Not a test: times have no limits.

#include "closures/diFeliceDrag.h"
#include "distribution/distribution.h"
#include "forces/dragOfMany.h"
#include "run/singleProcessMpi.h"
#include "support/boxMesh.h"
#include "support/temporaryCase.h"
#include "vectors.h"

#include <benchmark/benchmark.h>
#include <mpi.h>

#include <random>

namespace clepsydra::tests
{

namespace
{

constexpr int particleCount = 4096;
constexpr double diameter = 2e-3;
constexpr double cellSize = 2.5e-3;
constexpr std::array<int, 3> cells = {16, 16, 32};

ManyParticlesInFluid particlesInABed()
{
    std::mt19937 random(17);
    std::uniform_real_distribution<double> voidFraction(0.38, 0.95);
    std::uniform_real_distribution<double> slipSpeed(0.001, 0.3);
    ManyParticlesInFluid particles;
    particles.count = ManyParticlesInFluid::most;
    particles.density = 1000;
    particles.dynamicViscosity = 1e-3;
    for (std::size_t particle = 0; particle < particles.count; ++particle)
    {
        particles.diameter[particle] = diameter;
        particles.voidFraction[particle] = voidFraction(random);
        particles.logVoidFraction[particle] = std::log(particles.voidFraction[particle]);
        particles.slipSpeed[particle] = slipSpeed(random);
    }
    return particles;
}

void dragOfOneAfterTheOther(benchmark::State& state)
{
    const ManyParticlesInFluid particles = particlesInABed();
    const closures::DiFeliceDrag law;
    for ([[maybe_unused]] auto repetition : state)
    {
        for (std::size_t particle = 0; particle < particles.count; ++particle)
        {
            benchmark::DoNotOptimize(law(
                {particles.diameter[particle], particles.voidFraction[particle], particles.logVoidFraction[particle],
                    particles.slipSpeed[particle], particles.density, particles.dynamicViscosity}));
        }
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(particles.count));
}

void dragOfManyAtOnce(benchmark::State& state)
{
    const ManyParticlesInFluid particles = particlesInABed();
    const DragOfMany law = dragOfMany(closures::DiFeliceDrag::name);
    ManyCoefficients coefficients;
    for ([[maybe_unused]] auto repetition : state)
    {
        law(particles, coefficients);
        benchmark::DoNotOptimize(coefficients.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(particles.count));
}

/// The box, its particles and what spreads them.
class BedInABox
{
public:
    BedInABox()
        : mesh_(
            boxMesh(case_.time(), {0, 0, 0}, {cells[0] * cellSize, cells[1] * cellSize, cells[2] * cellSize}, cells)),
          distribution(properties(), *mesh_)
    {
        std::uniform_real_distribution<double> part(0, 1);
        for (int particle = 0; particle < particleCount; ++particle)
        {
            GhostParticle ghost{};
            for (int axis = 0; axis < 3; ++axis)
            {
                ghost.position[axis] = diameter / 2 + (cells[axis] * cellSize - diameter) * part(random_);
            }
            ghost.radius = diameter / 2;
            ghost.id = particle + 1;
            particles.push_back(ghost);
        }
        distribution.normalise(distribution.findCells(particles));
    }

    /// All of them, as far as in a coupling step of 2 ms at .1 m/s.
    void move()
    {
        std::uniform_real_distribution<double> step(-2e-4, 2e-4);
        for (GhostParticle& particle : particles)
        {
            for (int axis = 0; axis < 3; ++axis)
            {
                const double end = cells[axis] * cellSize - diameter / 2;
                particle.position[axis] = std::clamp(particle.position[axis] + step(random_), diameter / 2, end);
            }
        }
    }

    Eigen::Index cellCount() const
    {
        return mesh_->nCells();
    }

private:
    static Foam::dictionary properties()
    {
        return Foam::dictionary(Foam::IStringStream("voidFractionModel divided; smoothingModel constDiffSmoothing; "
                                                    "constDiffSmoothingProps { bandwidth 6e-3; }")());
    }

    TemporaryCase case_;
    std::unique_ptr<Foam::fvMesh> mesh_;
    std::mt19937 random_{17};

public:
    Distribution distribution;
    std::vector<GhostParticle> particles;
};

void locateMovingParticles(benchmark::State& state)
{
    BedInABox bed;
    for ([[maybe_unused]] auto repetition : state)
    {
        state.PauseTiming();
        bed.move();
        state.ResumeTiming();
        bed.distribution.normalise(bed.distribution.findCells(bed.particles));
    }
    state.SetItemsProcessed(state.iterations() * particleCount);
}

void locateParticlesAtRest(benchmark::State& state)
{
    BedInABox bed;
    for ([[maybe_unused]] auto repetition : state)
    {
        bed.distribution.normalise(bed.distribution.findCells(bed.particles));
    }
    state.SetItemsProcessed(state.iterations() * particleCount);
}

/// Eight quantities, as a coupling step has: solid volume, impulse, coefficient, outstanding impulse.
constexpr Eigen::Index quantities = 8;

void distribute(benchmark::State& state)
{
    const BedInABox bed;
    const Eigen::MatrixXd amounts = Eigen::MatrixXd::Random(quantities, particleCount);
    for ([[maybe_unused]] auto repetition : state)
    {
        benchmark::DoNotOptimize(bed.distribution.densities(amounts));
    }
    state.SetItemsProcessed(state.iterations() * particleCount);
}

void smooth(benchmark::State& state)
{
    const BedInABox bed;
    Eigen::MatrixXd densities = Eigen::MatrixXd::Random(quantities, bed.cellCount());
    for ([[maybe_unused]] auto repetition : state)
    {
        bed.distribution.smooth(densities);
    }
    state.SetItemsProcessed(state.iterations() * bed.cellCount());
}

void sampleAtParticles(benchmark::State& state)
{
    const BedInABox bed;
    const Eigen::MatrixXd values = Eigen::MatrixXd::Random(quantities, bed.cellCount());
    for ([[maybe_unused]] auto repetition : state)
    {
        benchmark::DoNotOptimize(bed.distribution.sample(values));
    }
    state.SetItemsProcessed(state.iterations() * particleCount);
}

BENCHMARK(dragOfOneAfterTheOther);
BENCHMARK(dragOfManyAtOnce);
BENCHMARK(locateMovingParticles);
BENCHMARK(locateParticlesAtRest);
BENCHMARK(distribute);
BENCHMARK(smooth);
BENCHMARK(sampleAtParticles);

} // namespace

} // namespace clepsydra::tests

int main(int argc, char* argv[])
{
    clepsydra::initialiseMpi(&argc, &argv);
    benchmark::Initialize(&argc, argv);
    const bool refused = benchmark::ReportUnrecognizedArguments(argc, argv);
    if (!refused)
    {
        benchmark::RunSpecifiedBenchmarks();
    }
    MPI_Finalize();
    return refused ? 1 : 0;
}
