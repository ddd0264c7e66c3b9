/// \file
/// What the parts of a coupling interval cost, with Google Benchmark: 4096 beads of 2 mm in a box of 16 x 16 x 32 cells
/// of 2.5 mm. `scripts/benchmark` times whole cases; this says which part to look at. Not a test: times have no limits.

#include "closures/diFeliceDrag.h"
#include "distribution/distribution.h"
#include "forces/dragOfMany.h"
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

constexpr int beadCount = 4096;
constexpr double diameter = 2e-3;
constexpr double cellSize = 2.5e-3;
constexpr std::array<int, 3> cells = {16, 16, 32};

ManyBeadsInFluid beadsInABed()
{
    std::mt19937 random(17);
    std::uniform_real_distribution<double> voidFraction(0.38, 0.95);
    std::uniform_real_distribution<double> slipSpeed(0.001, 0.3);
    ManyBeadsInFluid beads;
    beads.count = ManyBeadsInFluid::most;
    beads.density = 1000;
    beads.dynamicViscosity = 1e-3;
    for (std::size_t bead = 0; bead < beads.count; ++bead)
    {
        beads.diameter[bead] = diameter;
        beads.voidFraction[bead] = voidFraction(random);
        beads.logVoidFraction[bead] = std::log(beads.voidFraction[bead]);
        beads.slipSpeed[bead] = slipSpeed(random);
    }
    return beads;
}

void dragOfOneAfterTheOther(benchmark::State& state)
{
    const ManyBeadsInFluid beads = beadsInABed();
    const closures::DiFeliceDrag law;
    for ([[maybe_unused]] auto repetition : state)
    {
        for (std::size_t bead = 0; bead < beads.count; ++bead)
        {
            benchmark::DoNotOptimize(law({beads.diameter[bead], beads.voidFraction[bead], beads.logVoidFraction[bead],
                beads.slipSpeed[bead], beads.density, beads.dynamicViscosity}));
        }
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(beads.count));
}

void dragOfManyAtOnce(benchmark::State& state)
{
    const ManyBeadsInFluid beads = beadsInABed();
    const DragOfMany law = dragOfMany(closures::DiFeliceDrag::name);
    ManyCoefficients coefficients;
    for ([[maybe_unused]] auto repetition : state)
    {
        law(beads, coefficients);
        benchmark::DoNotOptimize(coefficients.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(beads.count));
}

/// The box, its beads and what spreads them.
class BedInABox
{
public:
    BedInABox()
        : mesh_(
            boxMesh(case_.time(), {0, 0, 0}, {cells[0] * cellSize, cells[1] * cellSize, cells[2] * cellSize}, cells)),
          distribution(properties(), *mesh_)
    {
        std::uniform_real_distribution<double> part(0, 1);
        for (int bead = 0; bead < beadCount; ++bead)
        {
            VisitingBead visitor{};
            visitor.reaction.setZero();
            visitor.volume = sphereVolume(0.5 * diameter);
            for (int axis = 0; axis < 3; ++axis)
            {
                visitor.position[axis] = diameter / 2 + (cells[axis] * cellSize - diameter) * part(random_);
            }
            visitor.radius = diameter / 2;
            visitor.id = bead + 1;
            beads.push_back(visitor);
        }
        distribution.normalise(distribution.findCells(beads));
    }

    /// All of them, as far as in an interval of 2 ms at .1 m/s.
    void move()
    {
        std::uniform_real_distribution<double> step(-2e-4, 2e-4);
        for (VisitingBead& bead : beads)
        {
            for (int axis = 0; axis < 3; ++axis)
            {
                const double end = cells[axis] * cellSize - diameter / 2;
                bead.position[axis] = std::clamp(bead.position[axis] + step(random_), diameter / 2, end);
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
                                                    "constDiffSmoothingProps { smoothingLength 6e-3; }")());
    }

    TemporaryCase case_;
    std::unique_ptr<Foam::fvMesh> mesh_;
    std::mt19937 random_{17};

public:
    Distribution distribution;
    std::vector<VisitingBead> beads;
};

void locateMovingBeads(benchmark::State& state)
{
    BedInABox bed;
    for ([[maybe_unused]] auto repetition : state)
    {
        state.PauseTiming();
        bed.move();
        state.ResumeTiming();
        bed.distribution.normalise(bed.distribution.findCells(bed.beads));
    }
    state.SetItemsProcessed(state.iterations() * beadCount);
}

void locateBeadsAtRest(benchmark::State& state)
{
    BedInABox bed;
    for ([[maybe_unused]] auto repetition : state)
    {
        bed.distribution.normalise(bed.distribution.findCells(bed.beads));
    }
    state.SetItemsProcessed(state.iterations() * beadCount);
}

/// Eight quantities, as an interval has: solid volume, impulse, coefficient, outstanding impulse.
constexpr Eigen::Index quantities = 8;

void distribute(benchmark::State& state)
{
    const BedInABox bed;
    const Eigen::MatrixXd amounts = Eigen::MatrixXd::Random(quantities, beadCount);
    for ([[maybe_unused]] auto repetition : state)
    {
        benchmark::DoNotOptimize(bed.distribution.densities(amounts));
    }
    state.SetItemsProcessed(state.iterations() * beadCount);
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

void sampleAtBeads(benchmark::State& state)
{
    const BedInABox bed;
    const Eigen::MatrixXd values = Eigen::MatrixXd::Random(quantities, bed.cellCount());
    for ([[maybe_unused]] auto repetition : state)
    {
        benchmark::DoNotOptimize(bed.distribution.sample(values));
    }
    state.SetItemsProcessed(state.iterations() * beadCount);
}

BENCHMARK(dragOfOneAfterTheOther);
BENCHMARK(dragOfManyAtOnce);
BENCHMARK(locateMovingBeads);
BENCHMARK(locateBeadsAtRest);
BENCHMARK(distribute);
BENCHMARK(smooth);
BENCHMARK(sampleAtBeads);

} // namespace

} // namespace clepsydra::tests

int main(int argc, char* argv[])
{
    MPI_Init(&argc, &argv);
    benchmark::Initialize(&argc, argv);
    const bool refused = benchmark::ReportUnrecognizedArguments(argc, argv);
    if (!refused)
    {
        benchmark::RunSpecifiedBenchmarks();
    }
    MPI_Finalize();
    return refused ? 1 : 0;
}
