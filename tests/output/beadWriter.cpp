#include "output/beadWriter.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

namespace clepsydra::tests
{

namespace
{

/// Beads 5, 4 .. 0 dealt to the ranks in turn, bead i with values made from i; every value must be found again in the
/// file at place i, through VTK's own reader. Writing one rank's beads, leaving out an array, or the engine's order
/// fails.
TEST(BeadWriter, WritesTheBeadsOfAllRanksSortedById)
{
    TemporaryCase temporaryCase;
    FakeEngine engine(0.01);
    for (int id = 5; id >= 0; --id)
    {
        if (id % Foam::Pstream::nProcs() == Foam::Pstream::myProcNo())
        {
            engine.addBead(id, {1.0 * id, 2.0 * id, 3.0 * id}, 0.1 * (id + 1), 2500, {0, 3.0 * id, 4.0 * id});
        }
    }
    engine.initialise(nullptr);
    const BeadsView beads = engine.beads();
    for (Eigen::Index i = 0; i < beads.size(); ++i)
    {
        beads.state[i].fluid.voidFraction = 1 - 0.1 * beads.id[i];
    }

    BeadWriter(temporaryCase.time()).write(beads, 0.25);

    if (!Foam::Pstream::master())
    {
        return;
    }
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName((temporaryCase.folder() / "VTK/beads_0.25.vtp").c_str());
    reader->Update();
    vtkPolyData& written = *reader->GetOutput();
    ASSERT_EQ(written.GetNumberOfPoints(), 6);
    EXPECT_EQ(written.GetNumberOfVerts(), 6);
    const auto value = [&](const char* name, int bead, int component) {
        vtkDataArray* array = written.GetPointData()->GetArray(name);
        return array != nullptr ? array->GetComponent(bead, component) : -1;
    };
    for (int id = 0; id < 6; ++id)
    {
        EXPECT_EQ(value("id", id, 0), id);
        EXPECT_EQ(written.GetPoint(id)[2], 3.0 * id);
        EXPECT_EQ(value("radius", id, 0), 0.1 * (id + 1));
        EXPECT_EQ(value("velocity", id, 1), 3.0 * id);
        EXPECT_EQ(value("angularVelocity", id, 2), 0);
        EXPECT_EQ(value("voidFraction", id, 0), 1 - 0.1 * id);
        EXPECT_DOUBLE_EQ(value("speed", id, 0), 5.0 * id);
    }
    EXPECT_TRUE(std::filesystem::exists(temporaryCase.folder() / "VTK/beads.pvd"));
}

/// Before pouring there is no bead: a file without beads, not an error.
TEST(BeadWriter, WritesNoBeads)
{
    TemporaryCase temporaryCase;
    FakeEngine engine(0.01);
    engine.initialise(nullptr);
    BeadWriter(temporaryCase.time()).write(engine.beads(), 0);
    if (Foam::Pstream::master())
    {
        EXPECT_TRUE(std::filesystem::exists(temporaryCase.folder() / "VTK/beads_0.vtp"));
    }
}

} // namespace

} // namespace clepsydra::tests
