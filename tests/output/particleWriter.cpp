// First: OpenFOAM's `Log` is a macro, GoogleMock's a function.
#include <gmock/gmock.h>

#include "benchmarks/countMessages.h"
#include "output/particleWriter.h"
#include "support/errorOf.h"
#include "support/fakeEngine.h"
#include "support/smallDisk.h"
#include "support/temporaryCase.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <map>
#include <optional>

namespace clepsydra::tests
{

namespace
{

using Foam::Pstream;

/// Particles 0 .. count - 1, dealt in turn to so many ranks from a first one on, the last first; particle i with values made from i.
std::unique_ptr<FakeEngine> particlesOnRanks(int count, int firstRank, int ranks)
{
    auto engine = std::make_unique<FakeEngine>(0.01);
    for (int id = count - 1; id >= 0; --id)
    {
        if (firstRank + id % ranks == Pstream::myProcNo())
        {
            engine->addParticle(id, {1.0 * id, 2.0 * id, 3.0 * id}, 0.1 * (id + 1), 2500, {0, 3.0 * id, 4.0 * id});
        }
    }
    engine->initialise(nullptr);
    const ParticlesView particles = engine->particles();
    for (Eigen::Index i = 0; i < particles.size(); ++i)
    {
        particles.state[i].fluid.voidFraction = 1 - 0.1 * particles.id[i];
    }
    return engine;
}

/// What VTK's own reader finds in a file.
vtkNew<vtkPolyData> drawnIn(const std::filesystem::path& file)
{
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    vtkNew<vtkPolyData> drawn;
    drawn->ShallowCopy(reader->GetOutput());
    return drawn;
}

/// Exactly particles 0 .. count - 1, each once and with all that was made from its number.
void expectParticles(const std::filesystem::path& file, int count)
{
    const vtkNew<vtkPolyData> drawn = drawnIn(file);
    ASSERT_EQ(drawn->GetNumberOfPoints(), count);
    EXPECT_EQ(drawn->GetNumberOfVerts(), count);
    const auto value = [&](const char* name, vtkIdType point, int component) {
        vtkDataArray* array = drawn->GetPointData()->GetArray(name);
        return array != nullptr ? array->GetComponent(point, component) : -1;
    };
    std::map<int, vtkIdType> points;
    for (vtkIdType point = 0; point < count; ++point)
    {
        points[static_cast<int>(value("id", point, 0))] = point;
    }
    for (int id = 0; id < count; ++id)
    {
        ASSERT_EQ(points.count(id), 1u) << id;
        const vtkIdType point = points[id];
        EXPECT_EQ(drawn->GetPoint(point)[2], 3.0 * id);
        EXPECT_EQ(value("radius", point, 0), 0.1 * (id + 1));
        EXPECT_EQ(value("velocity", point, 1), 3.0 * id);
        EXPECT_EQ(value("angularVelocity", point, 2), 0);
        EXPECT_EQ(value("voidFraction", point, 0), 1 - 0.1 * id);
        EXPECT_DOUBLE_EQ(value("speed", point, 0), 5.0 * id);
        // On one rank: in one order at all times, whatever the engine's.
        EXPECT_TRUE(Pstream::parRun() || point == id);
    }
}

std::size_t filesIn(const std::filesystem::path& folder)
{
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

} // namespace

/// Particles on all ranks, then on all but the first, all but the last, and in the one file every value of each must be found
/// again. Writing one rank's particles, two ranks' to one place, leaving out an array or a piece fails, and so does a file
/// whose first piece, without particles, would name no arrays.
TEST(ParticleWriter, WritesTheParticlesOfAllRanksInOneFile)
{
    TemporaryCase temporaryCase;
    ParticleWriter writer(temporaryCase.time());
    const int ranks = Pstream::nProcs();
    const int some = std::max(1, ranks - 1);
    double time = 0;
    for (const auto& [first, count] : {std::pair(0, ranks), std::pair(ranks - some, some), std::pair(0, some)})
    {
        time += 0.25;
        writer.write(particlesOnRanks(10, first, count)->particles(), time);
        if (Pstream::master())
        {
            const std::string name = "particles_" + Foam::Time::timeName(time) + ".vtp";
            expectParticles(temporaryCase.folder() / "VTK" / name, 10);
        }
    }
    if (Pstream::master())
    {
        EXPECT_TRUE(std::filesystem::exists(temporaryCase.folder() / "VTK/particles.pvd"));
        EXPECT_EQ(filesIn(temporaryCase.folder() / "VTK"), 4u);
    }
}

/// Of 4000 particles of a rank, 92 bytes and more each, none goes to another rank: what is said beside the file does not depend
/// on them. A gathering of all particles fails; that they are written is shown above.
TEST(ParticleWriter, SendsNoParticles)
{
    TemporaryCase temporaryCase;
    ParticleWriter writer(temporaryCase.time());
    const auto sentWith = [&](int particlesOfRank) {
        const auto engine = particlesOnRanks(particlesOfRank * Pstream::nProcs(), 0, Pstream::nProcs());
        const double before = bytesSentSoFar();
        writer.write(engine->particles(), particlesOfRank);
        return bytesSentSoFar() - before;
    };
    const double few = sentWith(4);
    EXPECT_EQ(sentWith(4000), few);
    EXPECT_LT(few, 1000);
    EXPECT_EQ(few > 0, Pstream::parRun());
}

/// The last rank alone has no room: all ranks end with what it says, the file of that time is the old one, and nothing else
/// is left. One that waited for a rank that has failed would never come back; one that writes into the file itself leaves
/// half of it.
TEST(ParticleWriter, TellsOnAllRanksThatOneCouldNotWrite)
{
    TemporaryCase temporaryCase;
    ParticleWriter writer(temporaryCase.time());
    writer.write(particlesOnRanks(10, 0, Pstream::nProcs())->particles(), 0.25);
    {
        std::optional<SmallDisk> disk;
        if (Pstream::myProcNo() == Pstream::nProcs() - 1)
        {
            disk.emplace(100);
        }
        const auto more = particlesOnRanks(100, 0, Pstream::nProcs());
        EXPECT_THAT(errorOf([&] { writer.write(more->particles(), 0.25); }),
            testing::HasSubstr("VTK/particles_0.25.vtp.unfinished: File too large"));
    }
    if (Pstream::master())
    {
        expectParticles(temporaryCase.folder() / "VTK/particles_0.25.vtp", 10);
        EXPECT_EQ(filesIn(temporaryCase.folder() / "VTK"), 2u);
    }
    writer.write(particlesOnRanks(100, 0, Pstream::nProcs())->particles(), 0.25);
    if (Pstream::master())
    {
        expectParticles(temporaryCase.folder() / "VTK/particles_0.25.vtp", 100);
    }
}

/// Before filling there is no particle: a file without particles, not an error.
TEST(ParticleWriter, WritesNoParticles)
{
    TemporaryCase temporaryCase;
    ParticleWriter(temporaryCase.time()).write(particlesOnRanks(0, 0, 1)->particles(), 0);
    if (Pstream::master())
    {
        expectParticles(temporaryCase.folder() / "VTK/particles_0.vtp", 0);
    }
}

} // namespace clepsydra::tests
