// A few particles that enter and leave, without a fluid: the part of each that is inside; the checks find losses.

#include <gmock/gmock.h>

#include "benchmarks/countMessages.h"
#include "conservation/conservationCheck.h"
#include "support/boxMesh.h"
#include "support/errorOf.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"
#include "insertionAndRemoval/insertionAndRemoval.h"

#include "IStringStream.H"
#include "functionObject.H"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

namespace clepsydra::tests
{

namespace
{

using namespace Foam;

constexpr double radius = 0.05;
constexpr double interval = 0.01;

dictionary entries(const std::string& text)
{
    IStringStream stream(text);
    return dictionary(stream);
}

/// A unit cube; on several ranks each makes one of its own, at the same place.
struct Cube
{
    TemporaryCase temporaryCase;
    std::unique_ptr<fvMesh> mesh = boxMesh(temporaryCase.time(), point::zero, point::one, {4, 4, 4});
};

/// As in a coupling step: the balances over all ranks are known afterwards.
void advanceOverStep(InsertionAndRemoval& insertionAndRemoval, const ParticlesView& particles, int newFrom,
    const FindOutsideMesh& findOutsideMesh = nullptr)
{
    RankTotals totals;
    insertionAndRemoval.advance(particles, newFrom, interval, findOutsideMesh, totals);
    totals.reduce();
}

/// Part of a sphere below a plane by summing up thin discs, and the height of its centroid over the sphere's centre.
std::pair<double, double> numerically(double planeHeight)
{
    constexpr int discs = 200000;
    double volume = 0;
    double moment = 0;
    for (int disc = 0; disc < discs; ++disc)
    {
        const double z = -1 + (disc + 0.5) * 2 / discs;
        if (z < planeHeight)
        {
            volume += 0.75 * (1 - z * z) * 2 / discs;
            moment += 0.75 * z * (1 - z * z) * 2 / discs;
        }
    }
    return {volume, moment / volume};
}

} // namespace

// The part of a particle inside and its centroid, from just touching the outlet to wholly beyond, against a sum of thin discs,
// which knows no formula. A particle that goes at once, or in proportion to its way, fails; so does one whose part is put
// where its centre is.
TEST(ParticleOutletsTest, ASphereIsCutByTheOutletsPlane)
{
    const Cube cube;
    const ParticleOutlets outlets(entries("particleOutlets (yMax zMin);"), *cube.mesh);
    for (const double below : {-1.2, -0.999, -0.5, 0., 0.3, 0.9})
    {
        const Vector3d centre(0.4, 0.6, -below * radius);
        const PartWithin part = outlets.partWithin(centre, radius, 0.01);
        const auto [volume, centroid] = numerically(-below);
        EXPECT_NEAR(part.share, volume, 1e-6) << below;
        EXPECT_EQ(part.outlet, below > -1 ? 1 : -1) << below;
        EXPECT_NEAR(part.shift.z() / radius, below > -1 ? -centroid : 0, 1e-4) << below;
        EXPECT_NEAR(part.shift.head<2>().norm(), 0, 1e-12);
    }
    // Far beyond within the travel of a coupling step, and where the coupling step before had nothing of it either.
    EXPECT_EQ(outlets.partWithin({0.4, 0.6, -0.3}, radius, 0.3).share, 0);
    EXPECT_EQ(outlets.partWithin({0.4, 0.6, -0.3}, radius, 0.01).share, 1);
    // Beyond a patch that is no outlet, and beside one by more than its radius.
    EXPECT_EQ(outlets.partWithin({0.4, -0.01, 0.5}, radius, 0.01).share, 1);
    const ParticleOutlets floor(entries("particleOutlets (zMin);"), *cube.mesh);
    EXPECT_EQ(floor.partWithin({0.4, 1.0 + 1.1 * radius, 0.0}, radius, 0).share, 1);
}

// What is inside changes without a jump on a path round the outlet's edge; one that measured to the plane alone would
// lose most of a particle when it comes from the side.
TEST(ParticleOutletsTest, TheShareIsContinuousAtTheOutletsEdge)
{
    const Cube cube;
    const ParticleOutlets outlets(entries("particleOutlets (zMin);"), *cube.mesh);
    double last = 1;
    for (double x = 1 + 2 * radius; x > 0.9; x -= 0.01 * radius)
    {
        const double share = outlets.partWithin({x, 0.5, 0.2 * radius}, radius, 0).share;
        EXPECT_LT(std::abs(share - last), 0.02) << x;
        last = share;
    }
    EXPECT_LT(last, 0.8);
}

TEST(ParticleOutletsTest, OnlyPatchesOfTheMeshAreOutlets)
{
    const Cube cube;
    const auto errorWith = [&](const std::string& names) {
        return errorOf([&] { ParticleOutlets(entries("particleOutlets (" + names + ");"), *cube.mesh); });
    };
    EXPECT_THAT(errorWith("zMni"), testing::HasSubstr("did you mean 'zMin'"));
    EXPECT_THAT(errorWith("zMin xMin"), testing::IsEmpty());
}

// A particle that leaves, one that turns back, one that comes in, over 160 coupling steps: in each the volume inside,
// added up particle by particle, is what was there at first plus what the balances say, to rounding, although no
// particle is ever wholly in or out at once. At the end one is taken out, counted with its mass and momentum, and the
// engine has it no more.
TEST(InsertionAndRemovalTest, TheBalancesFollowTheVolumeInside)
{
    const Cube cube;
    FakeEngine engine(1e-3, Vector3d::Zero());
    const bool mine = Pstream::master();
    InsertionAndRemoval insertionAndRemoval(entries("particleOutlets (zMin);"), *cube.mesh, interval);
    if (mine)
    {
        engine.addParticle(1, {0.5, 0.5, 0.06}, radius, 2500, {0, 0, -0.3});
        engine.addParticle(2, {0.2, 0.5, 0.06}, radius, 2500, {0, 0, -0.1});
    }
    engine.initialise(nullptr);
    const double first = insertionAndRemoval.start(engine.particles(), true);
    const auto volumeInside = [&] {
        double volume = 0;
        for (Eigen::Index particle = 0; particle < engine.particles().size(); ++particle)
        {
            volume += volumeInFluid(engine.particles(), particle);
        }
        return returnReduce(volume, sumOp<scalar>());
    };
    EXPECT_NEAR(first, 2 * sphereVolume(radius), 1e-15);
    double largestStep = 0;
    double last = first;
    label removed = 0;
    ParticleTransfer inserted;
    ParticleTransfer left;
    for (int step = 1; step <= 160; ++step)
    {
        if (step == 30 && mine)
        {
            // turns back
            engine.moveParticle(2, {0.2, 0.5, 0.06});
        }
        if (step == 20 && mine)
        {
            engine.addParticle(3, {0.8, 0.5, 0.5}, radius);
        }
        engine.advance(10);
        advanceOverStep(insertionAndRemoval, engine.particles(), step == 20 ? 2 : 3);
        const double now = volumeInside();
        EXPECT_NEAR(now, first + insertionAndRemoval.netVolume(), 1e-15) << step;
        largestStep = step == 30 ? largestStep : std::max(largestStep, std::abs(now - last));
        last = now;
        removed += insertionAndRemoval.removeDeparted(engine);
        inserted += insertionAndRemoval.lastInserted();
        left += insertionAndRemoval.lastDeparted()[0];
    }
    EXPECT_EQ(removed, 2);
    EXPECT_EQ(returnReduce(label(engine.particles().size()), sumOp<label>()), 1);
    EXPECT_EQ(inserted.particles, 1);
    EXPECT_EQ(left.particles, 2);
    const double mass = 2500 * sphereVolume(radius);
    EXPECT_NEAR(left.mass, 2 * mass, 1e-12);
    EXPECT_NEAR(left.momentum.z(), -0.4 * mass, 1e-12);
    EXPECT_NEAR(inserted.volume, sphereVolume(radius), 1e-15);
    EXPECT_LT(largestStep, 0.25 * sphereVolume(radius));
}

// A particle that is inserted over ten coupling steps leaves through the outlet within eight of them: it never was in the
// fluid whole. What has entered is then what has left, and in each step the volume inside, added up particle by particle, is
// what the balances say. Where the part beyond the outlet counts as entered, too, a part of a particle is there too much.
TEST(InsertionAndRemovalTest, AParticleThatLeavesWhileItIsInsertedHasNeverEnteredWhole)
{
    const Cube cube;
    FakeEngine engine(1e-3, Vector3d::Zero());
    InsertionAndRemoval insertionAndRemoval(
        entries("particleOutlets (zMin); insertionTime 0.1;"), *cube.mesh, interval);
    engine.initialise(nullptr);
    EXPECT_EQ(insertionAndRemoval.start(engine.particles(), true), 0);
    if (Pstream::master())
    {
        engine.addParticle(1, {0.5, 0.5, 0.03}, radius, 2500, {0, 0, -1});
    }
    double largest = 0;
    ParticleTransfer inserted;
    ParticleTransfer left;
    for (int step = 1; step <= 10; ++step)
    {
        engine.advance(10);
        advanceOverStep(insertionAndRemoval, engine.particles(), step == 1 ? 0 : 1);
        double inside = 0;
        for (Eigen::Index particle = 0; particle < engine.particles().size(); ++particle)
        {
            inside += volumeInFluid(engine.particles(), particle);
        }
        inside = returnReduce(inside, sumOp<scalar>());
        EXPECT_NEAR(inside, insertionAndRemoval.netVolume(), 1e-15) << step;
        largest = std::max(largest, inside);
        insertionAndRemoval.removeDeparted(engine);
        inserted += insertionAndRemoval.lastInserted();
        left += insertionAndRemoval.lastDeparted()[0];
    }
    EXPECT_EQ(inserted.particles, 1);
    EXPECT_EQ(left.particles, 1);
    EXPECT_NEAR(inserted.volume, left.volume, 1e-15);
    EXPECT_LT(inserted.volume, sphereVolume(radius));
    EXPECT_GT(largest, 0.01 * sphereVolume(radius));
}

// Resumed with fewer outlets, others, or the same in another order, particleFlux refuses and leaves its table as it was. It began at
// 0 again without a word, or went on counting what leaves through one outlet in the columns of another.
TEST(ParticleFluxTest, RefusesOtherOutletsThanBeforeARestart)
{
    TemporaryCase temporaryCase;
    const auto restart = [&](const std::string& more) {
        temporaryCase.restart("stopAt endTime; endTime 0.02; deltaT 0.01; writeControl timeStep; writeInterval 2; "
                              "runTimeModifiable no; startFrom startTime; "
                              + more);
        return boxMesh(temporaryCase.time(), point::zero, point::one, {4, 4, 4});
    };
    {
        const auto mesh = restart("startTime 0; functions { flux { type particleFlux; } }");
        const InsertionAndRemoval insertionAndRemoval(entries("particleOutlets (zMin yMax);"), *mesh, interval);
        while (temporaryCase.time().loop())
        {
            temporaryCase.time().write();
        }
    }
    const auto table = [&] {
        std::ifstream in(temporaryCase.folder() / "postProcessing/flux/0/flux.dat");
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    const std::string before = table();
    const auto errorWith = [&](const std::string& outlets) {
        const auto mesh = restart("startTime 0.02;");
        const InsertionAndRemoval insertionAndRemoval(entries("particleOutlets (" + outlets + ");"), *mesh, interval);
        return errorOf([&] { functionObject::New("flux", temporaryCase.time(), entries("type particleFlux;")); });
    };
    for (const char* others : {"zMin", "zMin xMin", "yMax zMin"})
    {
        EXPECT_THAT(errorWith(others), testing::AllOf(testing::HasSubstr("'particleOutlets'"),
                                           testing::HasSubstr("(zMin yMax)"), testing::HasSubstr("allowed:")))
            << others;
        if (Pstream::master())
        {
            EXPECT_EQ(table(), before) << others;
        }
    }
    EXPECT_THAT(errorWith("zMin yMax"), testing::IsEmpty());
}

// The conservation check holds what the cells have against these balances. Each fault that it is there for ends the run.
TEST(InsertionAndRemovalTest, TheConservationCheckFindsVolumeThatIsLost)
{
    const Cube cube;
    const auto conservationError = [&](double cells, double netVolume) {
        ConservationCheck conservation(dictionary::null, cube.temporaryCase.time());
        conservation.setInitialSolidVolume(1e-6);
        conservation.recordNetInsertion(netVolume);
        return errorOf([&] { conservation.recordSolidVolume(cells, cells, ClippedVolume()); });
    };
    EXPECT_EQ(conservationError(0.9e-6, -0.1e-6), "");
    EXPECT_EQ(conservationError(1.2e-6, 0.2e-6), "");
    // recorded twice, not recorded at all, of the wrong sign
    EXPECT_THAT(conservationError(0.9e-6, -0.2e-6), testing::HasSubstr("solidVolumeTolerance"));
    EXPECT_THAT(conservationError(0.9e-6, 0), testing::HasSubstr("solidVolumeTolerance"));
    EXPECT_THAT(conservationError(0.9e-6, 0.1e-6), testing::HasSubstr("solidVolumeTolerance"));
}

// A particle that was to be taken out and is still there, or one that went with it.
TEST(InsertionAndRemovalTest, TheCensusFindsParticlesThatStayOrGoWithTheOthers)
{
    for (const int remaining : {3, 2, 1})
    {
        FakeEngine engine(1e-3);
        const int rank = Pstream::myProcNo();
        for (int id = 1; id <= 3 && rank == 0; ++id)
        {
            engine.addParticle(id, Vector3d::Constant(0.1 * id), radius);
        }
        ParticleCensus census;
        census.count(engine.particles());
        for (int id = 3; id > remaining && rank == 0; --id)
        {
            engine.removeParticle(id);
        }
        const std::string error = errorOf([&] { census.countAfterRemoval(engine.particles(), 1); });
        EXPECT_EQ(error.empty(), remaining == 2) << error;
        if (remaining == 2)
        {
            // Its number is free again: the next that comes in has it, and is no old one.
            if (rank == 0)
            {
                engine.addParticle(3, Vector3d::Constant(0.5), radius);
            }
            EXPECT_EQ(census.count(engine.particles()), 2);
            EXPECT_EQ(census.inserted(), 1);
            EXPECT_EQ(census.removed(), 1);
            EXPECT_EQ(census.lost(), 0);
        }
    }
}

// One of 5000 particles is lost while another goes to the other rank: the one that is named with its place is the lost one, and
// to find out, the ranks tell each other of these two, not of all that they have.
TEST(InsertionAndRemovalTest, TheCensusNamesALostParticleWithoutAListOfAll)
{
    constexpr int count = 5000;
    FakeEngine engine(1e-3);
    for (int id = Pstream::myProcNo() + 1; id <= count; id += Pstream::nProcs())
    {
        engine.addParticle(id, Vector3d::Constant(1e-4 * id), radius);
    }
    ParticleCensus census;
    census.count(engine.particles());
    const int lost = 10 * Pstream::nProcs() + 1;
    const int moved = lost + Pstream::nProcs();
    if (Pstream::master())
    {
        engine.removeParticle(lost);
        engine.removeParticle(moved);
    }
    if (Pstream::myProcNo() == Pstream::nProcs() - 1)
    {
        engine.addParticle(moved, Vector3d::Zero(), radius);
    }
    const double before = bytesSentSoFar();
    const std::string error = errorOf([&] { census.count(engine.particles()); });
    EXPECT_THAT(error, testing::HasSubstr("1 of 5000 particles were lost"));
    EXPECT_THAT(error, testing::HasSubstr("particle " + std::to_string(lost) + ", last seen at (0.00"));
    EXPECT_THAT(error, testing::Not(testing::HasSubstr("particle " + std::to_string(moved) + ',')));
    const double bytes = bytesSentSoFar() - before;
    EXPECT_LT(bytes, 1000);
    EXPECT_TRUE(bytes > 0 || !Pstream::parRun());
}

// The particle with the highest id is lost while another one is inserted in the same coupling step: LIGGGHTS gives it the
// id that has become free. Counted by ids alone, all are there, and none is new.
TEST(InsertionAndRemovalTest, TheCensusTellsALostParticleFromANewOneWithItsId)
{
    FakeEngine engine(1e-3);
    const bool mine = Pstream::master();
    for (int id = 1; id <= 3 && mine; ++id)
    {
        engine.addParticle(id, Vector3d::Constant(0.1 * id), radius);
    }
    ParticleCensus census;
    census.count(engine.particles());
    if (mine)
    {
        engine.removeParticle(3);
        engine.insertParticle(3, Vector3d::Constant(0.5), radius);
    }
    const std::string error = errorOf([&] { census.count(engine.particles()); });
    EXPECT_THAT(error, testing::HasSubstr("1 of 3 particles were lost"));
    EXPECT_THAT(error, testing::HasSubstr("particle 3, last seen at (0.3 0.3 0.3"));
}

// A particle that leaves the mesh takes its volume out of the fluid at once, is counted and stays in the engine; when it
// comes back, its volume enters within insertionTime. In each step the volume inside is what the balances say.
TEST(InsertionAndRemovalTest, AParticleOutsideTheMeshIsNotInTheFluid)
{
    const Cube cube;
    FakeEngine engine(1e-3, Vector3d::Zero());
    const bool mine = Pstream::master();
    InsertionAndRemoval insertionAndRemoval(entries("insertionTime 0.05;"), *cube.mesh, interval);
    if (mine)
    {
        engine.addParticle(1, {0.5, 0.5, 0.5}, radius);
        engine.addParticle(2, {0.2, 0.5, 0.5}, radius);
    }
    engine.initialise(nullptr);
    const FindOutsideMesh findOutsideMesh = [&] {
        std::vector<bool> outside;
        for (Eigen::Index particle = 0; particle < engine.particles().size(); ++particle)
        {
            outside.push_back(engine.particles().position(2, particle) < 0);
        }
        return outside;
    };
    const double first = insertionAndRemoval.start(engine.particles(), true, findOutsideMesh);
    const auto volumeInside = [&] {
        double volume = 0;
        for (Eigen::Index particle = 0; particle < engine.particles().size(); ++particle)
        {
            volume += volumeInFluid(engine.particles(), particle);
        }
        return returnReduce(volume, sumOp<scalar>());
    };
    const double ofOne = sphereVolume(radius);
    EXPECT_NEAR(first, 2 * ofOne, 1e-15);
    for (int step = 1; step <= 30; ++step)
    {
        if (mine && (step == 5 || step == 15))
        {
            engine.moveParticle(1, {0.5, 0.5, step == 5 ? -0.5 : 0.5});
        }
        engine.advance(10);
        advanceOverStep(insertionAndRemoval, engine.particles(), 2, findOutsideMesh);
        EXPECT_NEAR(volumeInside(), first + insertionAndRemoval.netVolume(), 1e-15) << step;
        EXPECT_EQ(insertionAndRemoval.outsideMesh(), step >= 5 && step < 15 ? 1 : 0) << step;
        EXPECT_EQ(insertionAndRemoval.leftMesh(), step >= 5 ? 1 : 0) << step;
        EXPECT_EQ(insertionAndRemoval.removeDeparted(engine), 0);
        if (step >= 5 && step < 15)
        {
            EXPECT_NEAR(volumeInside(), ofOne, 1e-15) << step;
        }
        if (step == 15)
        {
            EXPECT_LT(volumeInside(), 1.2 * ofOne);
            EXPECT_GT(volumeInside(), 1.05 * ofOne);
        }
    }
    EXPECT_NEAR(volumeInside(), 2 * ofOne, 1e-15);
}

} // namespace clepsydra::tests
