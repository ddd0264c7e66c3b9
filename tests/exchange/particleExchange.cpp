// Ghost particles without a mesh: the plan which rank sends to which, and what is kept from one coupling step to the next.

#include "exchange/particleExchange.h"

#include "benchmarks/countMessages.h"
#include "support/fakeEngine.h"

#include "Pstream.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <set>
#include <utility>

namespace
{

/// Allocations by new of more than this number of bytes.
constexpr std::size_t largeBytes = 1000;
long largeAllocations = 0;

} // namespace

void* operator new(std::size_t size)
{
    largeAllocations += size > largeBytes ? 1 : 0;
    if (void* const memory = std::malloc(std::max<std::size_t>(size, 1)))
    {
        return memory;
    }
    throw std::bad_alloc();
}

// Not inlined, or GCC takes free() for the wrong partner of new.
[[gnu::noinline]] void operator delete(void* memory) noexcept
{
    std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}

namespace clepsydra::tests
{

namespace
{

constexpr double radius = 0.01;
constexpr int perRank = 200;

/// The cells of rank i are between x = i and i + 1 m. Particles lie on a line through all of them; each rank has those that
/// have their centres in its own cells, and others near them where they were moved.
class ParticlesOnALine : public testing::Test
{
protected:
    explicit ParticlesOnALine(const PeriodicBox& periodic = {})
        : periodic_(periodic),
          engine_(1e-5),
          exchange_(MPI_COMM_WORLD, cells(Foam::Pstream::myProcNo()), 0, periodic)
    {
        for (int i = 0; i < perRank; ++i)
        {
            const int particle = Foam::Pstream::myProcNo() * perRank + i;
            engine_.addParticle(particle + 1, positionOf(particle), radius);
        }
    }

    static Box cells(int rank)
    {
        return Box(Vector3d(rank, 0, 0), Vector3d(rank + 1, 1, 1));
    }

    Vector3d positionOf(int particle) const
    {
        return {(particle + 0.5) / perRank + moved_, 0.5, 0.5};
    }

    /// All particles of all ranks along the line.
    void moveTo(double moved)
    {
        moved_ = moved;
        for (int i = 0; i < perRank; ++i)
        {
            const int particle = Foam::Pstream::myProcNo() * perRank + i;
            engine_.moveParticle(particle + 1, positionOf(particle));
        }
    }

    /// What each particle adds: its id.
    Eigen::MatrixXd contributions()
    {
        return engine_.particles().id.cast<double>().transpose();
    }

    bool sendAsPlanned()
    {
        RankTotals totals;
        exchange_.sendAsPlanned(engine_.particles(), contributions(), totals);
        used_ = false;
        totals.add({}, [this](const RankNumbers&) { used_ = true; });
        return totals.reduce();
    }

    /// The lengths of the periodic box between a particle and those of its images that touch a rank's cells; 0 for itself.
    std::set<int> imagesAt(int rank, int particle) const
    {
        constexpr int most = 3;
        std::set<int> images;
        for (int periods = periodic_.isPeriodic() ? -most : 0; periods <= (periodic_.isPeriodic() ? most : 0);
             ++periods)
        {
            if (cubeMeets(cells(rank), imageOf(particle, periods), radius))
            {
                images.insert(periods);
            }
        }
        return images;
    }

    Vector3d imageOf(int particle, int periods) const
    {
        return periodic_.image(positionOf(particle), {periods, 0, 0});
    }

    /// The ghosts are the particles of all ranks, and their images, that touch this rank's cells, with what they add; and each
    /// reports to its owner.
    void expectAllGhosts() const
    {
        std::set<std::pair<int, int>> expected;
        for (int particle = 0; particle < perRank * Foam::Pstream::nProcs(); ++particle)
        {
            for (const int periods : imagesAt(Foam::Pstream::myProcNo(), particle))
            {
                expected.emplace(particle + 1, periods);
            }
        }
        std::set<std::pair<int, int>> found;
        Eigen::Index ghost = 0;
        for (const GhostParticle& particle : exchange_.ghosts())
        {
            const int id = static_cast<int>(particle.id);
            const double away = particle.position.x() - positionOf(id - 1).x();
            const int periods = periodic_.isPeriodic() ? static_cast<int>(std::lround(away / periodic_.length.x())) : 0;
            found.emplace(id, periods);
            EXPECT_EQ(particle.position, imageOf(id - 1, periods));
            EXPECT_EQ(exchange_.contributions()(0, ghost++), id);
        }
        EXPECT_EQ(found, expected);
        EXPECT_EQ(exchange_.ghosts().size(), expected.size()) << "a particle is there twice";

        const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(1, ghost);
        const Eigen::MatrixXd ghostsOfEach = exchange_.sumAtOwners(ones);
        EXPECT_EQ(exchange_.toGhosts(ghostsOfEach).size(), ghost);
        for (int i = 0; i < perRank; ++i)
        {
            std::size_t touched = 0;
            for (int rank = 0; rank < Foam::Pstream::nProcs(); ++rank)
            {
                touched += imagesAt(rank, Foam::Pstream::myProcNo() * perRank + i).size();
            }
            EXPECT_EQ(ghostsOfEach(0, i), static_cast<double>(touched));
        }
    }

    const PeriodicBox periodic_;
    FakeEngine engine_;
    ParticleExchange exchange_;
    double moved_ = 0;
    bool used_ = false;
};

/// The same where the line is closed to a ring.
class ParticlesOnARing : public ParticlesOnALine
{
protected:
    ParticlesOnARing()
        : ParticlesOnALine({Vector3d::Zero(), Vector3d(Foam::Pstream::nProcs(), 0, 0)})
    {}
};

} // namespace

// While particles stay in the boxes that their ranks have published, a step makes one collective call, which the caller may
// share with others, and it has all ghosts. A plan that is made in each step makes three.
TEST_F(ParticlesOnALine, KeepThePlanInTheirBoxes)
{
    ASSERT_TRUE(sendAsPlanned());
    expectAllGhosts();
    for (int step = 1; step <= 10; ++step)
    {
        moveTo(0.01 * step);
        const double before = collectiveCallsSoFar();
        EXPECT_TRUE(sendAsPlanned()) << step;
        EXPECT_EQ(collectiveCallsSoFar() - before, Foam::Pstream::parRun() ? 1 : 0);
        EXPECT_TRUE(used_);
        expectAllGhosts();
    }
}

// All particles jump by more than the margin of their boxes, and with several ranks to the cells of ranks that did not expect
// them. No total of that step may be used; the repetition has all ghosts. An exchange that trusts its plan lacks them.
TEST_F(ParticlesOnALine, MakeANewPlanWhenTheyLeaveTheirBoxes)
{
    ASSERT_TRUE(sendAsPlanned());
    moveTo(-1.7);
    EXPECT_FALSE(sendAsPlanned());
    EXPECT_FALSE(used_);
    EXPECT_TRUE(sendAsPlanned());
    EXPECT_TRUE(used_);
    expectAllGhosts();
    // By send() without a repetition by the caller.
    moveTo(3.1);
    exchange_.send(engine_.particles(), contributions());
    expectAllGhosts();
}

// Where space is periodic, particles touch the cells at both ends, and other ones do in each step. An exchange that keeps the
// images of the step before with its memory puts ghosts at wrong places.
TEST_F(ParticlesOnARing, HaveTheirImagesInEachStep)
{
    ASSERT_TRUE(sendAsPlanned());
    expectAllGhosts();
    for (int step = 1; step <= 10; ++step)
    {
        moveTo(0.01 * step);
        EXPECT_TRUE(sendAsPlanned()) << step;
        expectAllGhosts();
    }
    moveTo(0.7);
    EXPECT_FALSE(sendAsPlanned());
    EXPECT_TRUE(sendAsPlanned());
    expectAllGhosts();
}

// The particles of one rank alone leave its box: all ranks find it.
TEST_F(ParticlesOnALine, OfOneRankLeaveItsBox)
{
    ASSERT_TRUE(sendAsPlanned());
    if (Foam::Pstream::master())
    {
        engine_.moveParticle(1, {0.5, 0.5, 40});
    }
    EXPECT_FALSE(sendAsPlanned());
    EXPECT_TRUE(sendAsPlanned());
}

// A step like the one before takes no memory for its messages and ghosts, each of which is larger than what is counted here.
// When each call made new messages, a step took several such pieces in each of its three exchanges.
TEST_F(ParticlesOnALine, TakeNoMemoryInAStepLikeTheLast)
{
    static_assert(perRank * sizeof(double) > largeBytes);
    const Eigen::MatrixXd added = contributions();
    const auto step = [&] {
        RankTotals totals;
        exchange_.sendAsPlanned(engine_.particles(), added, totals);
        totals.reduce();
        exchange_.toGhosts(exchange_.sumAtOwners(Eigen::MatrixXd::Ones(1, added.cols() + 10)
                                                     .leftCols(static_cast<Eigen::Index>(exchange_.ghosts().size()))));
    };
    for (int i = 0; i < 3; ++i)
    {
        step();
    }
    const long before = largeAllocations;
    for (int i = 0; i < 5; ++i)
    {
        step();
    }
    EXPECT_EQ(largeAllocations, before);
}

} // namespace clepsydra::tests
