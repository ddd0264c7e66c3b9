// First: OpenFOAM's `Log` is a macro, GoogleMock's a function.
#include <gmock/gmock.h>

#include "functionObjects/observedParticles.h"
#include "functionObjects/particleBins.h"
#include "functionObjects/particleMeans.h"
#include "support/boxMesh.h"
#include "support/errorOf.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"

#include "IOdictionary.H"
#include "IStringStream.H"
#include "OStringStream.H"
#include "functionObject.H"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace clepsydra::tests
{

namespace
{

using Foam::Pstream;

constexpr double deltaT = 0.01;
constexpr double radius = 0.01;

/// A unit cube with particles that no force moves, or gravity alone. Particle i is on rank i modulo the number of ranks.
class Cloud
{
public:
    /// \param top  of the mesh
    Cloud(TemporaryCase& temporaryCase, const Vector3d& gravity, double top = 1)
        : mesh_(boxMesh(temporaryCase.time(), {0, 0, 0}, {1, 1, top}, {2, 2, 2})),
          engine_(deltaT, gravity),
          observed_(*mesh_, engine_)
    {
        engine_.initialise(nullptr);
    }

    void add(const Vector3d& position, const Vector3d& velocity)
    {
        if (added_++ % Pstream::nProcs() == Pstream::myProcNo())
        {
            engine_.addParticle(added_, position, radius, 2500, velocity);
        }
    }

    void advance(int steps)
    {
        engine_.advance(steps);
    }

private:
    std::unique_ptr<Foam::fvMesh> mesh_;
    FakeEngine engine_;
    ObservedParticles observed_;
    int added_ = 0;
};

/// In the order in which the program does it: function objects first, so that the checkpoint holds their state.
void run(Foam::Time& time, Cloud& cloud)
{
    time.functionObjects().start();
    while (time.value() < time.endTime().value() - 0.5 * deltaT)
    {
        ++time;
        cloud.advance(1);
        time.functionObjects().execute();
        time.write();
    }
    time.functionObjects().end();
}

std::string controls(const std::string& entries, double startTime, double endTime, int writeInterval)
{
    std::ostringstream text;
    text << "stopAt endTime; deltaT " << deltaT << "; startFrom startTime; startTime " << startTime << "; endTime "
         << endTime << "; writeControl timeStep; writeInterval " << writeInterval << "; runTimeModifiable no;\n"
         << "functions { means { type particleMeans; " << entries << " } }";
    return text.str();
}

/// Rows of a table as text; empty on ranks other than the master.
std::vector<std::string> lines(const TemporaryCase& temporaryCase, const std::string& startTime)
{
    std::vector<std::string> rows;
    std::ifstream in(temporaryCase.folder() / "postProcessing/means" / startTime / "means.dat");
    for (std::string line; Pstream::master() && std::getline(in, line);)
    {
        if (line.front() != '#')
        {
            rows.push_back(line);
        }
    }
    return rows;
}

struct Row
{
    double time, x, y, z, sampledTimes, particles, speed, deviation, vx, vy, vz, solidFraction;
};

std::vector<Row> rows(const TemporaryCase& temporaryCase, const std::string& startTime)
{
    std::vector<Row> all;
    for (const std::string& line : lines(temporaryCase, startTime))
    {
        Row row{};
        std::istringstream(line) >> row.time >> row.x >> row.y >> row.z >> row.sampledTimes >> row.particles
            >> row.speed >> row.deviation >> row.vx >> row.vy >> row.vz >> row.solidFraction;
        all.push_back(row);
    }
    return all;
}

/// Each rank writes the sums of all ranks with its part of a checkpoint. A rank that keeps its own sums, or memory that it has
/// given back, fails.
void expectSameStateOnAllRanks(const Foam::Time& time)
{
    Foam::OStringStream here;
    time.lookupObject<Foam::IOdictionary>("means").writeData(here);
    EXPECT_THAT(here.str(), testing::HasSubstr("sampledTimes"));
    Foam::string ofMaster = here.str();
    Pstream::scatter(ofMaster);
    EXPECT_EQ(here.str(), ofMaster) << "rank " << Pstream::myProcNo();
}

/// Bins of 0.4 x 2 x 0.25 m in a box of 1 x 0.5 x 0.5 m at (1, 0, 0): three, one and two; the last along x is 0.2 m wide.
/// What a bin's number, centre or volume gets wrong shows in one of them; so does a point at a face or outside.
TEST(ParticleBins, DivideABox)
{
    const ParticleBins bins({{1, 0, 0}, {2, 0.5, 0.5}}, {0.4, 2, 0.25});
    ASSERT_EQ(bins.count(), 6);
    EXPECT_EQ(bins.binOf({1, 0, 0}), 0);
    EXPECT_EQ(bins.binOf({1.39, 0.4, 0.1}), 0);
    EXPECT_EQ(bins.binOf({1.41, 0.4, 0.1}), 1);
    EXPECT_EQ(bins.binOf({1.9, 0.1, 0.25}), 5);
    EXPECT_EQ(bins.binOf({2, 0.5, 0.5}), 5);
    EXPECT_EQ(bins.binOf({2.001, 0.2, 0.2}), -1);
    EXPECT_EQ(bins.binOf({1.5, -0.001, 0.2}), -1);
    EXPECT_LT((bins.centre(1) - Vector3d(1.6, 0.25, 0.125)).norm(), 1e-12);
    EXPECT_LT((bins.centre(5) - Vector3d(1.9, 0.25, 0.375)).norm(), 1e-12);
    EXPECT_NEAR(bins.volume(0), 0.4 * 0.5 * 0.25, 1e-12);
    EXPECT_NEAR(bins.volume(5), 0.2 * 0.5 * 0.25, 1e-12);
}

/// 0.28 m are 35 bins of 8 mm, although the quotient of the two numbers is not 35 exactly: one more bin, empty and without
/// volume, would spoil every solid fraction.
TEST(ParticleBins, AreAsManyAsTheSizesSay)
{
    EXPECT_EQ(ParticleBins::numberOf({{-0.14, 0, 0}, {0.14, 0.04, 1}}, {8e-3, 1e9, 8e-3}), 35 * 1 * 125);
}

/// Two particles of 0.5 and 1.5 m/s in one half of the cube, one of 2 m/s in the other, three steps: means 1 ± 0.5 and
/// 2 ± 0 m/s, velocities (0.6, 0, 0.4) and (0, -2, 0), on any number of ranks. The speed of the mean velocity would be 0.72,
/// one rank's particles alone have other means, a sum over steps without its count three times these.
TEST(ParticleMeans, AverageOverParticlesAndTime)
{
    TemporaryCase temporaryCase(controls("binSize (0.5 9 9); writePrecision 12;", 0, 0.03, 3));
    Cloud cloud(temporaryCase, Vector3d::Zero());
    cloud.add({0.2, 0.5, 0.5}, {0.3, 0, -0.4});
    cloud.add({0.3, 0.5, 0.5}, {0.9, 0, 1.2});
    cloud.add({0.7, 0.5, 0.5}, {0, -2, 0});
    run(temporaryCase.time(), cloud);
    expectSameStateOnAllRanks(temporaryCase.time());

    const std::vector<Row> found = rows(temporaryCase, "0");
    if (Pstream::master())
    {
        ASSERT_EQ(found.size(), 2U);
        const double solid = sphereVolume(radius) / 0.5;
        const Row expected[] = {{0.03, 0.25, 0.5, 0.5, 3, 6, 1, 0.5, 0.6, 0, 0.4, 2 * solid},
            {0.03, 0.75, 0.5, 0.5, 3, 3, 2, 0, 0, -2, 0, solid}};
        for (std::size_t bin = 0; bin < 2; ++bin)
        {
            const Row& ours = found[bin];
            const Row& right = expected[bin];
            EXPECT_NEAR(ours.time, right.time, 1e-10);
            EXPECT_NEAR(ours.x, right.x, 1e-10);
            EXPECT_NEAR(ours.y, right.y, 1e-10);
            EXPECT_NEAR(ours.z, right.z, 1e-10);
            EXPECT_EQ(ours.sampledTimes, right.sampledTimes);
            EXPECT_EQ(ours.particles, right.particles);
            EXPECT_NEAR(ours.speed, right.speed, 1e-10);
            EXPECT_NEAR(ours.deviation, right.deviation, 1e-6) << "the root of what rounding leaves of 0";
            EXPECT_NEAR(ours.vx, right.vx, 1e-10);
            EXPECT_NEAR(ours.vy, right.vy, 1e-10);
            EXPECT_NEAR(ours.vz, right.vz, 1e-10);
            EXPECT_NEAR(ours.solidFraction, right.solidFraction, 1e-10);
        }
    }
}

/// A particle of 1 m/s passes from one bin into the next between the samples of 0.05 and 0.06 s; another stays outside the
/// box. From 0.04 s on, every second step: 0.04 in the first bin, 0.06, 0.08 and 0.1 in the second. Samples at the steps at
/// which OpenFOAM only writes (0.05), or before 0.04 s, and a box that is ignored change the counts.
TEST(ParticleMeans, KeepTheirTimesAndTheirBox)
{
    TemporaryCase temporaryCase(
        controls("binSize (0.25 1 1); box (0 0 0) (0.5 1 0.5); timeStart 0.04; executeInterval 2;", 0, 0.1, 5));
    Cloud cloud(temporaryCase, Vector3d::Zero());
    cloud.add({0.195, 0.5, 0.25}, {1, 0, 0});
    cloud.add({0.195, 0.5, 0.75}, {5, 0, 0});
    run(temporaryCase.time(), cloud);

    const std::vector<Row> found = rows(temporaryCase, "0");
    if (Pstream::master())
    {
        ASSERT_EQ(found.size(), 3U);
        EXPECT_NEAR(found[0].time, 0.05, 1e-9);
        EXPECT_EQ(found[0].sampledTimes, 1);
        EXPECT_EQ(found[0].particles, 1);
        EXPECT_NEAR(found[1].time, 0.1, 1e-9);
        EXPECT_NEAR(found[1].x, 0.125, 1e-9);
        EXPECT_EQ(found[1].sampledTimes, 4);
        EXPECT_EQ(found[1].particles, 1);
        EXPECT_NEAR(found[2].x, 0.375, 1e-9);
        EXPECT_EQ(found[2].particles, 3);
        EXPECT_NEAR(found[2].solidFraction, 3 * sphereVolume(radius) / (4 * 0.25 * 0.5), 1e-8);
    }
}

/// Twenty particles that fall through the bins of one case.
void fill(Cloud& cloud)
{
    for (int i = 0; i < 20; ++i)
    {
        cloud.add({0.05 * i + 0.01, 0.03 * i + 0.1, 0.99 - 0.02 * i}, {0.01 * i, 0.1 / (i + 3), 0.3 - 0.07 * i});
    }
}

const std::string resumedBins = "binSize (0.3 0.3 0.3); executeInterval 3; writePrecision 16;";

/// Rows at 0.1 and 0.2 s of a run that is stopped at 0.1 s, between the samples of the steps 9 and 12, and resumed: to the
/// last digit those of a run that goes through, each once. Sums that are forgotten, kept with the fields' 6 digits or sampled
/// once more, and rows that are lost or doubled, fail. The box around the mesh remains that of the start also where the mesh has
/// moved by then; bins of the present one are others, so that the means could not continue.
TEST(ParticleMeans, GoOnAfterARestart)
{
    const Vector3d gravity(0, 0, -9.81);
    TemporaryCase through(controls(resumedBins, 0, 0.2, 10));
    {
        Cloud cloud(through, gravity);
        fill(cloud);
        run(through.time(), cloud);
    }
    const std::vector<std::string> whole = lines(through, "0");
    for (const double topAtResume : {1.0, 0.8})
    {
        TemporaryCase stopped(controls(resumedBins, 0, 0.1, 10));
        {
            Cloud cloud(stopped, gravity);
            fill(cloud);
            run(stopped.time(), cloud);
        }
        const std::vector<std::string> first = lines(stopped, "0");
        stopped.restart(controls(resumedBins, 0.1, 0.2, 10));
        {
            Cloud cloud(stopped, gravity, topAtResume);
            fill(cloud);
            cloud.advance(10);
            run(stopped.time(), cloud);
        }
        if (Pstream::master())
        {
            EXPECT_GT(first.size(), 5U);
            EXPECT_GT(whole.size(), first.size() + 5);
            EXPECT_EQ(lines(stopped, "0.1"), whole);
            EXPECT_TRUE(lines(stopped, "0").empty());
            EXPECT_EQ(first, std::vector<std::string>(whole.begin(), whole.begin() + std::ptrdiff_t(first.size())));
        }
    }
}

/// Means of other bins cannot continue: the error names both, and the table that is there stays as it was.
TEST(ParticleMeans, RefuseOtherBinsAfterARestart)
{
    TemporaryCase temporaryCase(controls(resumedBins, 0, 0.1, 10));
    {
        Cloud cloud(temporaryCase, Vector3d::Zero());
        fill(cloud);
        run(temporaryCase.time(), cloud);
    }
    const std::vector<std::string> before = lines(temporaryCase, "0");
    temporaryCase.restart(controls("binSize (0.3 0.3 0.2);", 0.1, 0.2, 10));
    Cloud cloud(temporaryCase, Vector3d::Zero());
    const Foam::dictionary dict(Foam::IStringStream("type particleMeans; binSize (0.3 0.3 0.2); executeInterval 3;")());
    EXPECT_THAT(errorOf([&] { Foam::functionObject::New("means", temporaryCase.time(), dict); }),
        testing::AllOf(testing::HasSubstr("give bins of (0.3 0.3 0.2)"),
            testing::HasSubstr("they were (0.3 0.3 0.3) from (0 0 0) to (1 1 1)"), testing::HasSubstr("allowed: ")));
    EXPECT_EQ(lines(temporaryCase, "0"), before);
}

std::string errorWith(const std::string& entries)
{
    TemporaryCase temporaryCase;
    const Cloud cloud(temporaryCase, Vector3d::Zero());
    const Foam::dictionary dict(Foam::IStringStream("type particleMeans; " + entries)());
    std::string error = errorOf([&] { Foam::functionObject::New("means", temporaryCase.time(), dict); });
    EXPECT_FALSE(std::filesystem::exists(temporaryCase.folder() / "postProcessing"));
    return error;
}

/// Each must stop the run with words that help; a function object that takes anything gives no error at all.
TEST(ParticleMeans, RefuseWhatTheyCannotUse)
{
    EXPECT_THAT(errorWith(""), testing::HasSubstr("binSize"));
    EXPECT_THAT(errorWith("binSize (0.1 0 0.1);"),
        testing::AllOf(testing::HasSubstr("'binSize' is (0.1 0 0.1)"), testing::HasSubstr("three sizes > 0")));
    EXPECT_THAT(errorWith("binSize (1e-9 0.1 0.1);"),
        testing::AllOf(testing::HasSubstr("'binSize' is"), testing::HasSubstr("at most 1e+06 bins")));
    EXPECT_THAT(errorWith("binSize (0.1 0.1 0.1); box (0 0 0) (1 0 1);"),
        testing::AllOf(testing::HasSubstr("'box' is"), testing::HasSubstr("the second above the first")));
    EXPECT_THAT(errorWith("binSize (0.1 0.1 0.1); executeControl runTime;"),
        testing::AllOf(testing::HasSubstr("'executeControl' is runTime"), testing::HasSubstr("allowed: timeStep")));
    EXPECT_THAT(errorWith("binSize (0.1 0.1 0.1); executeInterval 0;"), testing::HasSubstr("'executeInterval' is 0"));
}

} // namespace

} // namespace clepsydra::tests
