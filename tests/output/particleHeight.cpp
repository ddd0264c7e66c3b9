// First: OpenFOAM's `Log` is a macro, GoogleMock's a function.
#include <gmock/gmock.h>

#include "functionObjects/particleHeight.h"
#include "functionObjects/observedParticles.h"
#include "support/boxMesh.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"

#include "IStringStream.H"
#include "functionObject.H"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <vector>

namespace clepsydra::tests
{

namespace
{

using Foam::Pstream;

/// Two particles in a unit cube, 1 at rest and 2 that moves, each on the last rank.
class TwoParticles
{
public:
    explicit TwoParticles(TemporaryCase& temporaryCase)
        : mesh_(boxMesh(temporaryCase.time(), {0, 0, 0}, {1, 1, 1}, {2, 2, 2})),
          engine_(0.01),
          observed_(*mesh_, engine_)
    {
        if (Pstream::myProcNo() == Pstream::nProcs() - 1)
        {
            engine_.addParticle(1, {0.5, 0.5, 0.5}, 0.01);
            engine_.addParticle(2, {0.25, 0.5, 0.75}, 0.01, 2500, {0.3, 0, -0.4});
        }
        engine_.initialise(nullptr);
    }

    void advance()
    {
        engine_.advance(1);
    }

    void removeParticle(int id)
    {
        if (engine_.particles().size() > 0)
        {
            engine_.removeParticle(id);
        }
    }

private:
    std::unique_ptr<Foam::fvMesh> mesh_;
    FakeEngine engine_;
    ObservedParticles observed_;
};

/// Of the rows of a .dat file; empty where there is none, and on ranks other than the master.
std::vector<double> timesOfRows(const std::filesystem::path& file)
{
    std::vector<double> times;
    std::ifstream in(file);
    for (std::string line; Pstream::master() && std::getline(in, line);)
    {
        double time = 0;
        if (line.front() != '#' && std::istringstream(line) >> time)
        {
            times.push_back(time);
        }
    }
    return times;
}

/// Particle 2 along an axis that is neither z nor of length 1: height .25*.6 + .75*.8 = .75, velocity .3*.6 - .4*.8 = -.14,
/// in the row that OpenFOAM itself leaves out, at t = 0, and in each of the run's steps. The other particle, the z axis, an
/// axis that is not normalised or one rank's part only give other numbers.
TEST(ParticleHeight, FollowsTheParticleNamed)
{
    TemporaryCase temporaryCase(
        "functions { height { type particleHeight; particle 2; axis (3 0 4); } } endTime 0.03;");
    TwoParticles particles(temporaryCase);
    while (temporaryCase.time().loop())
    {}

    if (Pstream::master())
    {
        std::ifstream in(temporaryCase.folder() / "postProcessing/height/0/height.dat");
        int rows = 0;
        for (std::string line; std::getline(in, line);)
        {
            double time = 0;
            double height = 0;
            double velocity = 0;
            if (line.front() != '#' && std::istringstream(line) >> time >> height >> velocity)
            {
                EXPECT_NEAR(time, 0.01 * rows, 1e-9);
                EXPECT_NEAR(height, 0.75, 1e-6);
                EXPECT_NEAR(velocity, -0.14, 1e-6);
                ++rows;
            }
        }
        EXPECT_EQ(rows, 4);
    }
}

/// A particle that falls from .75 m, at .4 m/s and faster, is at .7450, .7391, .7321 m after steps of .01 s: a run that would
/// go on to 1 s ends when it is below .736 m, with the step after, as OpenFOAM's `writeNow` does.
TEST(ParticleHeight, EndsTheRunBelowAHeight)
{
    TemporaryCase temporaryCase(
        "functions { height { type particleHeight; particle 2; stopBelow 0.736; } } endTime 1;");
    TwoParticles particles(temporaryCase);
    int steps = 0;
    while (temporaryCase.time().loop())
    {
        particles.advance();
        ++steps;
    }
    EXPECT_EQ(steps, 4);
}

/// When the particle has left there are no more rows, and the run goes on, also when it is resumed. Rows of height 0 would be
/// taken for a particle that lies still, and 0 for below every floor.
TEST(ParticleHeight, EndsWithItsParticle)
{
    TemporaryCase temporaryCase(
        "functions { height { type particleHeight; particle 2; stopBelow 0.1; } } endTime 0.05;");
    TwoParticles particles(temporaryCase);
    int steps = 0;
    while (temporaryCase.time().loop())
    {
        if (++steps == 3)
        {
            particles.removeParticle(2);
        }
    }
    EXPECT_EQ(steps, 5);
    if (Pstream::master())
    {
        std::ifstream in(temporaryCase.folder() / "postProcessing/height/0/height.dat");
        int rows = 0;
        for (std::string line; std::getline(in, line);)
        {
            rows += line.front() != '#';
        }
        EXPECT_EQ(rows, 3);
    }
    const Foam::dictionary dict(Foam::IStringStream("type particleHeight; particle 2;")());
    EXPECT_NO_THROW(Foam::functionObject::New("resumed", temporaryCase.time(), dict));
}

/// A run that is stopped has, resumed, the rows of one that is not: a row every .1 s, where it is stopped at .15 s, at which
/// none is due, and at .2 s, whose row goes to the next table. One that takes a row at every start has one at .15 s, one that
/// takes none there lacks that of .2 s. An earlier table that has lost a row is reported.
TEST(ParticleHeight, GoesOnAfterARestart)
{
    TemporaryCase temporaryCase;
    const auto runFrom = [&](const std::string& start, const std::string& end) {
        temporaryCase.restart(
            "stopAt endTime; deltaT 0.01; writeControl timeStep; writeInterval 5; runTimeModifiable no; "
            "functions { height { type particleHeight; particle 2; executeControl timeStep; executeInterval 10; "
            "writeControl "
            "none; } } "
            "startFrom startTime; startTime "
            + start + "; endTime " + end + ';');
        const TwoParticles particles(temporaryCase);
        testing::internal::CaptureStdout();
        while (temporaryCase.time().loop())
        {
            temporaryCase.time().write();
        }
        return testing::internal::GetCapturedStdout();
    };
    const std::filesystem::path tables = temporaryCase.folder() / "postProcessing/height";
    const auto expectRows = [&](const std::string& start, const std::vector<double>& times) {
        EXPECT_THAT(timesOfRows(tables / start / "height.dat"),
            testing::Pointwise(testing::DoubleNear(1e-9), Pstream::master() ? times : std::vector<double>()))
            << start;
    };
    runFrom("0", "0.15");
    EXPECT_THAT(runFrom("0.15", "0.2"), testing::Not(testing::HasSubstr("WARNING")));
    EXPECT_THAT(runFrom("0.2", "0.3"), testing::Not(testing::HasSubstr("WARNING")));
    expectRows("0", {0, 0.1});
    expectRows("0.15", {});
    expectRows("0.2", {0.2, 0.3});
    if (Pstream::master())
    {
        std::filesystem::remove(tables / "0/height.dat");
    }
    const std::string said = runFrom("0.3", "0.35");
    if (Pstream::master())
    {
        EXPECT_THAT(said, testing::HasSubstr("WARNING: height.dat has 1 rows"));
        EXPECT_THAT(said, testing::HasSubstr("but 3 were written"));
    }
}

/// A particle that is not there must end the run with words that help, and leave no file behind.
TEST(ParticleHeight, RefusesAParticleThatIsNotThere)
{
    TemporaryCase temporaryCase;
    TwoParticles particles(temporaryCase);
    const Foam::dictionary dict(Foam::IStringStream("type particleHeight; particle 3;")());
    try
    {
        Foam::functionObject::New("particleHeight", temporaryCase.time(), dict);
        ADD_FAILURE() << "taken";
    }
    catch (const Foam::IOerror& error)
    {
        EXPECT_THAT(std::string(error.message()),
            testing::AllOf(testing::HasSubstr("'particle' is 3"), testing::HasSubstr("2 particles")));
    }
    EXPECT_FALSE(std::filesystem::exists(temporaryCase.folder() / "postProcessing"));
}

} // namespace

} // namespace clepsydra::tests
