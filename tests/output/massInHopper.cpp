// First: OpenFOAM's `Log` is a macro, GoogleMock's a function.
#include <gmock/gmock.h>

#include "functionObjects/massInHopper.h"
#include "functionObjects/observedParticles.h"
#include "functionObjects/trailingRate.h"
#include "support/boxMesh.h"
#include "support/errorOf.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"

#include "IStringStream.H"
#include "functionObject.H"

#include <gtest/gtest.h>

#include <sstream>

namespace clepsydra::tests
{

namespace
{

using Foam::Pstream;

struct Row
{
    double time;
    double mass;
    double particles;
    double rate;
};

/// Rows of a .dat file; empty on ranks other than the master.
std::vector<Row> rows(const std::filesystem::path& file)
{
    std::vector<Row> all;
    std::ifstream in(file);
    for (std::string line; Pstream::master() && std::getline(in, line);)
    {
        Row row{};
        if (line.front() != '#' && std::istringstream(line) >> row.time >> row.mass >> row.particles >> row.rate)
        {
            all.push_back(row);
        }
    }
    return all;
}

std::string functions(const std::string& more)
{
    return "functions { massInHopper { type massInHopper; patch xMin; " + more + " } }";
}

constexpr double radius = 0.01;
const double particleMass = 2500 * sphereVolume(radius);
const Vector3d inside(0.1, 0.5, 0.5);
const Vector3d outside(0.1, 0.5, -0.1);

/// A unit cube whose wall xMin plays the hopper's wall: axis through (0, 0.5), radius 0.5, bottom at z = 0. Ten particles
/// are in it, 0 to 9, particle i on rank i modulo the number of ranks.
class Discharge
{
public:
    /// \param bottom  of the mesh
    explicit Discharge(TemporaryCase& temporaryCase, double bottom = 0)
        : mesh_(boxMesh(temporaryCase.time(), {0, 0, bottom}, {1, 1, bottom + 1}, {2, 2, 2})),
          engine_(0.01),
          observed_(*mesh_, engine_)
    {
        for (int id = 0; id < 10; ++id)
        {
            if (mine(id))
            {
                engine_.addParticle(id, inside, radius);
            }
        }
        engine_.initialise(nullptr);
    }

    /// Moves a particle below the bottom.
    void drop(int id)
    {
        if (mine(id))
        {
            engine_.moveParticle(id, outside);
        }
    }

    /// Moves a particle that is below the bottom into the hopper.
    void raise(int id)
    {
        if (mine(id))
        {
            engine_.moveParticle(id, inside);
        }
    }

    void insert(int id)
    {
        if (mine(id))
        {
            engine_.addParticle(id, inside, radius);
        }
    }

    const Foam::fvMesh& mesh() const
    {
        return *mesh_;
    }

private:
    static bool mine(int id)
    {
        return id % Pstream::nProcs() == Pstream::myProcNo();
    }

    std::unique_ptr<Foam::fvMesh> mesh_;
    FakeEngine engine_;
    ObservedParticles observed_;
};

/// Runs to the end; the particle with the number of the step leaves in that step, up to particle `last`.
void run(Foam::Time& time, Discharge& discharge, int last)
{
    for (int particle = 0; time.loop(); ++particle)
    {
        if (particle <= last)
        {
            discharge.drop(particle);
        }
        time.write();
    }
}

/// The cylinder from a patch that two ranks share: each rank's box continues the other's along x, so that the wall
/// yMin spans x = 0..n on n ranks. Bounds that are not reduced give each rank a cylinder of its own.
TEST(HopperCylinder, SpansThePatchOfAllRanks)
{
    TemporaryCase temporaryCase;
    const int rank = Pstream::myProcNo();
    const int ranks = Pstream::nProcs();
    const auto mesh = boxMesh(temporaryCase.time(), {double(rank), 0, -0.5}, {rank + 1.0, 1, 2}, {2, 2, 2});
    const HopperCylinder hopper(mesh->boundaryMesh()["yMin"], {0, 0, 3});

    EXPECT_LT((hopper.foot() - Vector3d(0.5 * ranks, 0, -0.5)).norm(), 1e-12);
    EXPECT_NEAR(hopper.radius(), 0.5 * ranks, 1e-12);
}

/// Below the bottom and beside the wall is out, above the rim is in: "always in" and a bound at the rim fail.
TEST(HopperCylinder, HoldsWhatIsAboveItsBottom)
{
    TemporaryCase temporaryCase;
    const auto mesh = boxMesh(temporaryCase.time(), {0, 0, 0}, {1, 1, 1}, {1, 1, 1});
    const HopperCylinder hopper(mesh->boundaryMesh()["xMin"], {0, 0, 1});

    EXPECT_TRUE(hopper.contains({0, 0.5, 0.001}));
    EXPECT_TRUE(hopper.contains({0.49, 0.5, 5}));
    EXPECT_FALSE(hopper.contains({0, 0.5, -0.001}));
    EXPECT_FALSE(hopper.contains({0.51, 0.5, 0.5}));
}

/// 10, 9, 9, 4 at 0, 1, 2, 4 s with a window of 2 s: 0, then (10 - 9)/1, (10 - 9)/2, (9 - 4)/2. The difference of
/// neighbours, or a mean since the start, gives other numbers.
TEST(TrailingRate, IsTheMeanOverTheWindow)
{
    TrailingRate rate(2);
    EXPECT_DOUBLE_EQ(rate.add(0, 10), 0);
    EXPECT_DOUBLE_EQ(rate.add(1, 9), 1);
    EXPECT_DOUBLE_EQ(rate.add(2, 9), 0.5);
    EXPECT_DOUBLE_EQ(rate.add(4, 4), 2.5);
}

/// One particle leaves in each of the first ten of 100 steps of 0.01 s. Row k must hold 10 - k particles of all ranks and their
/// mass, and the rate one particle per step; nothing written, one rank's particles only or a wrong sign fails. The row at
/// t = 0 is what OpenFOAM leaves out by itself.
TEST(MassInHopper, RecordsTheDischarge)
{
    TemporaryCase temporaryCase(functions(""));
    Discharge discharge(temporaryCase);
    run(temporaryCase.time(), discharge, 9);

    EXPECT_EQ(MassInHopper::lastCount(temporaryCase.time()), 0);
    if (Pstream::master())
    {
        const auto all = rows(temporaryCase.folder() / "postProcessing/massInHopper/0/massInHopper.dat");
        ASSERT_EQ(all.size(), 101U);
        for (std::size_t i = 0; i <= 10; ++i)
        {
            const auto left = static_cast<double>(10 - i);
            EXPECT_NEAR(all[i].time, 0.01 * static_cast<double>(i), 1e-9);
            EXPECT_EQ(all[i].particles, left);
            EXPECT_NEAR(all[i].mass, left * particleMass, 1e-5 * particleMass);
            EXPECT_NEAR(all[i].rate, i == 0 ? 0 : particleMass / 0.01, 1e-5 * particleMass / 0.01);
        }
        EXPECT_NEAR(all[15].rate, 0.5 * particleMass / 0.01, 1e-5 * particleMass / 0.01)
            << "0.1 s, half of them with an outflow";
        EXPECT_EQ(all.back().rate, 0);
    }
}

/// Rows at most 0.025 s apart with steps of 0.01 s means every second step, and a last row at the end. Waiting until
/// 0.025 s have passed would give every third.
TEST(MassInHopper, KeepsTheSampleInterval)
{
    TemporaryCase temporaryCase(functions("sampleInterval 0.025;") + " endTime 0.05;");
    Discharge discharge(temporaryCase);
    run(temporaryCase.time(), discharge, 9);

    if (Pstream::master())
    {
        std::vector<double> times;
        for (const Row& row : rows(temporaryCase.folder() / "postProcessing/massInHopper/0/massInHopper.dat"))
        {
            times.push_back(row.time);
        }
        EXPECT_THAT(times, testing::Pointwise(testing::DoubleNear(1e-9), {0.0, 0.02, 0.04, 0.05}));
    }
}

/// The last particle leaves in the step to 0.05 s; with stopWhenFlowStops 0.2 the run must end just after 0.25 s, with its
/// fields written, not at 1 s. Before the first departure nothing must stop it.
TEST(MassInHopper, EndsTheRunWhenTheFlowStops)
{
    TemporaryCase temporaryCase(functions("stopWhenFlowStops 0.2;"));
    Discharge discharge(temporaryCase);
    run(temporaryCase.time(), discharge, 4);

    EXPECT_NEAR(temporaryCase.time().value(), 0.26, 1e-9);
    EXPECT_TRUE(std::filesystem::exists(std::string(temporaryCase.time().timePath())));
    EXPECT_EQ(MassInHopper::lastCount(temporaryCase.time()), 5);
}

/// One particle leaves in each step to 0.5 s, and from the second on another one comes in, so that the number remains: the run must
/// end just after 0.7 s. A look at the number alone ends it after 0.21 s, one at the new particles too, where they were inserted
/// elsewhere long before.
TEST(MassInHopper, SeesParticlesLeaveWhileOthersComeIn)
{
    for (const bool fromElsewhere : {false, true})
    {
        TemporaryCase temporaryCase(functions("stopWhenFlowStops 0.2;"));
        Discharge discharge(temporaryCase);
        for (int id = 10; fromElsewhere && id < 59; ++id)
        {
            discharge.insert(id);
            discharge.drop(id);
        }
        for (int step = 0; temporaryCase.time().loop(); ++step)
        {
            if (step < 50)
            {
                discharge.drop(step);
            }
            if (step > 0 && step < 50 && fromElsewhere)
            {
                discharge.raise(9 + step);
            }
            else if (step > 0 && step < 50)
            {
                discharge.insert(9 + step);
            }
        }
        EXPECT_NEAR(temporaryCase.time().value(), 0.71, 1e-9) << fromElsewhere;
        EXPECT_EQ(MassInHopper::lastCount(temporaryCase.time()), 9);
    }
}

TEST(MassInHopper, DoesNotStopBeforeTheFlowBegins)
{
    // As above without a departure: a clock that starts at t = 0 ends the run at 0.2 s.
    TemporaryCase temporaryCase(functions("stopWhenFlowStops 0.2;"));
    Discharge discharge(temporaryCase);
    run(temporaryCase.time(), discharge, -1);

    EXPECT_NEAR(temporaryCase.time().value(), 1, 1e-9);
}

/// A run that ends at 0.1 s and goes on from there: the old curve stays up to 0.1 s, the new one has its own folder and
/// begins there, so that every time has one row; and the last departure (0.05 s) is remembered, so that the run ends at
/// 0.25 s though no particle leaves in it. Forgetting it, doubling the row of 0.1 s or writing into the old file fails. Where
/// the mesh has moved down by then, the hopper stays where it was: the five that have left are not in it again.
TEST(MassInHopper, GoesOnAfterARestart)
{
    const std::string entries = "stopAt endTime; deltaT 0.01; writeControl timeStep; writeInterval 10; "
                                "runTimeModifiable no; startFrom startTime; "
                                + functions("stopWhenFlowStops 0.2;");
    for (const double bottomAtResume : {0.0, -0.5})
    {
        TemporaryCase temporaryCase;
        temporaryCase.restart(entries + "startTime 0; endTime 0.1;");
        {
            Discharge discharge(temporaryCase);
            run(temporaryCase.time(), discharge, 4);
        }
        temporaryCase.restart(entries + "startTime 0.1; endTime 1;");
        {
            Discharge discharge(temporaryCase, bottomAtResume);
            for (int particle = 0; particle <= 4; ++particle)
            {
                discharge.drop(particle);
            }
            run(temporaryCase.time(), discharge, -1);
        }

        EXPECT_NEAR(temporaryCase.time().value(), 0.26, 1e-9);
        if (Pstream::master())
        {
            const std::filesystem::path folder = temporaryCase.folder() / "postProcessing/massInHopper";
            const auto first = rows(folder / "0/massInHopper.dat");
            ASSERT_EQ(first.size(), 10U);
            EXPECT_NEAR(first.back().time, 0.09, 1e-9);
            const auto second = rows(folder / "0.1/massInHopper.dat");
            ASSERT_FALSE(second.empty());
            EXPECT_NEAR(second.front().time, 0.1, 1e-9);
            EXPECT_EQ(second.front().particles, 5);
        }
    }
}

/// The text of the error that making the function object with these entries raises. No file may be left behind, for OpenFOAM would then give the next run's another name.
std::string errorWith(const std::string& entries)
{
    TemporaryCase temporaryCase;
    Discharge discharge(temporaryCase);
    const Foam::dictionary dict(Foam::IStringStream("type massInHopper; " + entries)());
    std::string error = errorOf([&] { Foam::functionObject::New("massInHopper", temporaryCase.time(), dict); });
    EXPECT_FALSE(std::filesystem::exists(temporaryCase.folder() / "postProcessing"));
    return error;
}

/// Each must stop the run with words that help; a function object that takes anything gives no error at all.
TEST(MassInHopper, RefusesWhatItCannotUse)
{
    EXPECT_THAT(errorWith("patch hoper;"),
        testing::AllOf(testing::HasSubstr("'hoper'"), testing::HasSubstr("xMin xMax yMin yMax zMin zMax")));
    EXPECT_THAT(errorWith(""), testing::HasSubstr("patch"));
    EXPECT_THAT(errorWith("patch xMin; sampleInterval 0.001;"),
        testing::AllOf(testing::HasSubstr("'sampleInterval' is 0.001"), testing::HasSubstr("time step, 0.01 s")));
    EXPECT_THAT(errorWith("patch xMin; rateWindow -1;"), testing::HasSubstr("'rateWindow' is -1"));
    EXPECT_THAT(errorWith("patch xMin; axis (0 0 0);"), testing::HasSubstr("'axis'"));
}

} // namespace

} // namespace clepsydra::tests
