#include "output/particleWriter.h"

#include "files/wholeFile.h"
#include "output/vtkParticles.h"
#include "output/vtkSeries.h"
#include "ranks.h"

#include <mpi.h>

#include <cstdint>

namespace clepsydra
{

namespace
{

void exitOnProblem(const std::string& problem)
{
    using namespace Foam;

    if (!problem.empty())
    {
        FatalErrorInFunction << problem.c_str() << exit(FatalError);
    }
}

/// Position in the common file at which this rank's part of the given size begins. Collective.
std::uint64_t placeOf(std::uint64_t bytes)
{
    std::uint64_t end = bytes;
    if (Foam::Pstream::parRun())
    {
        MPI_Scan(&bytes, &end, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    }
    return end - bytes;
}

} // namespace

ParticleWriter::ParticleWriter(const Foam::Time& time)
    : folder_(std::string(time.globalPath() / "VTK"))
{
    exitOnProblem(problemOfRanks([&] {
        if (Foam::Pstream::master())
        {
            series_ = std::make_unique<VtkSeries>(folder_ / "particles.pvd", time.startTime().value());
        }
    }));
}

ParticleWriter::~ParticleWriter() = default;

void ParticleWriter::write(const ParticlesView& particles, double time, const double* temperatures)
{
    using Foam::Pstream;

    const std::string name = "particles_" + Foam::Time::timeName(time) + ".vtp";
    const std::filesystem::path file = folder_ / name;
    std::string part;
    std::string problem = problemOfRanks([&] {
        if (Pstream::master())
        {
            std::filesystem::create_directories(folder_);
            beginInParts(file);
        }
        part = partOfVtp(particles, Pstream::master(), Pstream::myProcNo() == Pstream::nProcs() - 1, temperatures);
    });
    if (problem.empty())
    {
        problem = problemOfRanks([&, place = placeOf(part.size())] { writePart(file, place, part); });
    }
    if (problem.empty())
    {
        problem = problemOfRanks([&] {
            if (Pstream::master())
            {
                finishInParts(file);
                series_->add(time, name);
            }
        });
    }
    if (!problem.empty() && Pstream::master())
    {
        discardParts(file);
    }
    exitOnProblem(problem);
}

} // namespace clepsydra
