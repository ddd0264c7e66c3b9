// First: OpenFOAM's `Log` is a macro, GoogleMock's a function.
#include <gmock/gmock.h>

#include "files/wholeFile.h"
#include "output/vtkSeries.h"
#include "support/temporaryCase.h"

#include <gtest/gtest.h>

#include <fstream>

namespace clepsydra::tests
{

namespace
{

std::string entry(const std::string& time, const std::string& file)
{
    return R"(timestep=")" + time + R"(" part="0" file=")" + file + '"';
}

/// Three files, then a restart from 0.2 s that writes 0.25 s: 0, 0.1 and 0.2 s must still be there, 0.3 s of the old
/// run must not. A series that starts again loses the first, one that only appends shows the last.
TEST(VtkSeries, GoesOnAfterARestart)
{
    TemporaryCase temporaryCase;
    if (!Foam::Pstream::master())
    {
        return;
    }
    const std::filesystem::path file = temporaryCase.folder() / "particles.pvd";
    VtkSeries first(file, 0);
    for (const char* time : {"0", "0.1", "0.2", "0.3"})
    {
        const std::string data = std::string("particles_") + time + ".vtp";
        std::ofstream(temporaryCase.folder() / data) << "data";
        first.add(std::stod(time), data);
    }
    EXPECT_THAT(textOf(file), testing::HasSubstr(entry("0.3", "particles_0.3.vtp")));

    VtkSeries(file, 0.1 + 0.1).add(0.25, "particles_0.25.vtp");

    const std::string text = textOf(file);
    EXPECT_THAT(text, testing::HasSubstr(entry("0", "particles_0.vtp")));
    EXPECT_THAT(text, testing::HasSubstr(entry("0.1", "particles_0.1.vtp")));
    EXPECT_THAT(text, testing::HasSubstr(entry("0.2", "particles_0.2.vtp")));
    EXPECT_THAT(text, testing::HasSubstr(entry("0.25", "particles_0.25.vtp")));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("particles_0.3.vtp")));
}

/// The same moment twice is one entry, the later: ParaView shows two otherwise.
TEST(VtkSeries, ReplacesTheSameTime)
{
    TemporaryCase temporaryCase;
    if (!Foam::Pstream::master())
    {
        return;
    }
    const std::filesystem::path file = temporaryCase.folder() / "particles.pvd";
    VtkSeries series(file, 0);
    series.add(0.3, "old.vtp");
    series.add(0.1 + 0.2, "new.vtp");
    EXPECT_THAT(textOf(file), testing::HasSubstr("new.vtp"));
    EXPECT_THAT(textOf(file), testing::Not(testing::HasSubstr("old.vtp")));
}

/// Somebody's other file of that name must stop the run before it is overwritten.
TEST(VtkSeries, RefusesWhatIsNoSeries)
{
    TemporaryCase temporaryCase;
    if (!Foam::Pstream::master())
    {
        return;
    }
    const std::filesystem::path file = temporaryCase.folder() / "particles.pvd";
    std::ofstream(file) << "shopping list";
    EXPECT_THROW(VtkSeries(file, 0), std::runtime_error);
    EXPECT_EQ(textOf(file), "shopping list");
}

} // namespace

} // namespace clepsydra::tests
