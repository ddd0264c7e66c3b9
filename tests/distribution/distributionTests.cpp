// How particles are distributed to cells: on real meshes with cells smaller and larger than a particle, beside a
// baffle, on one rank and on two. Every expectation is an identity that holds for any particles, so the particles are random.
//
// At the end: particles near cyclic patches.

#include "distribution/cyclicPatches.h"
#include "distribution/distribution.h"
#include "exchange/particleExchange.h"
#include "support/boxMesh.h"
#include "support/fakeEngine.h"
#include "support/temporaryCase.h"
#include "support/testCase.h"
#include "vectors.h"

#include "Pstream.H"
#include "Time.H"
#include "fvMesh.H"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace clepsydra::tests
{

namespace
{

constexpr double diameter = 2e-3;
constexpr double boxWidth = 0.016;
constexpr double boxHeight = 0.032;

const char* const baffleCommands = "topoSet > log.topoSet 2>&1 && createBaffles -overwrite > log.createBaffles 2>&1";

/// A zero-thickness wall at half the height of the box, over the box's depth, in a range of x, which may be in parts.
void addBaffle(TestCase& box, const std::vector<std::array<double, 2>>& ranges)
{
    std::string faces;
    for (const auto& [from, to] : ranges)
    {
        faces += std::string(" { name plate; type faceSet; action ") + (faces.empty() ? "new" : "add")
                 + "; source boxToFace; box (" + std::to_string(from) + " -1 0.0159) (" + std::to_string(to)
                 + " 1 0.0161); }";
    }
    const std::string header = "FoamFile { version 2.0; format ascii; class dictionary; object baffle; }\n";
    box.extraFiles["system/topoSetDict"] =
        header + "actions (" + faces
        + " { name plate; type faceZoneSet; action new; source setToFaceZone; faceSet plate; } );";
    box.extraFiles["system/createBafflesDict"] =
        header
        + "internalFacesOnly true; baffles { plate { type faceZone; zoneName plate; patchPairs "
          "{ type wall; patchFields {} } patches { master { name plate; type wall; } "
          "slave { name plate; type wall; } } } }";
}

/// Cubic cells in the box below.
Eigen::Vector3i cubes(double cellSize)
{
    const int across = static_cast<int>(std::lround(boxWidth / cellSize));
    return {across, across, 2 * across};
}

/// A box of water on all ranks: 16 x 16 x 32 mm.
class BoxOnRanks
{
public:
    using Ranges = std::vector<std::array<double, 2>>;

    BoxOnRanks(double cellSize, bool baffle, double baffleLength = boxWidth)
        : BoxOnRanks(cubes(cellSize), baffle ? Ranges{{-1, baffleLength}} : Ranges())
    {}

    /// \param baffle  the parts of a baffle along x; none where it is empty
    explicit BoxOnRanks(
        const Eigen::Vector3i& cells, const Ranges& baffle = {}, const std::array<bool, 3>& periodic = {})
    {
        Foam::fileName folder;
        if (Foam::Pstream::master())
        {
            case_ = std::make_unique<TestCase>();
            case_->box.upper = {boxWidth, boxWidth, boxHeight};
            case_->box.periodic = periodic;
            case_->cells = cells;
            case_->removeFile("0/U");
            case_->removeFile("0/p");
            case_->divideAmong(2);
            if (!baffle.empty())
            {
                addBaffle(*case_, baffle);
            }
            Outcome made = case_->makeMesh();
            if (made.succeeded() && !baffle.empty())
            {
                made = case_->runCommand(baffleCommands);
            }
            if (made.succeeded() && Foam::Pstream::parRun())
            {
                made = case_->runCommand("decomposePar > log.decomposePar 2>&1");
            }
            EXPECT_TRUE(made.succeeded()) << made.output;
            folder = case_->path().string();
        }
        Foam::Pstream::scatter(folder);
        Foam::fileName own = folder.name();
        if (Foam::Pstream::parRun())
        {
            own = own / ("processor" + Foam::name(Foam::Pstream::myProcNo()));
        }
        time_ = std::make_unique<Foam::Time>(Foam::Time::controlDictName, folder.path(), own);
        mesh_ = std::make_unique<Foam::fvMesh>(
            Foam::IOobject(Foam::fvMesh::defaultRegion, time_->timeName(), *time_, Foam::IOobject::MUST_READ));
    }

    const Foam::fvMesh& mesh() const
    {
        return *mesh_;
    }

private:
    std::unique_ptr<TestCase> case_;
    std::unique_ptr<Foam::Time> time_;
    std::unique_ptr<Foam::fvMesh> mesh_;
};

Foam::dictionary properties(const Foam::word& voidFractionModel, const Foam::word& smoothing)
{
    Foam::dictionary dict("couplingProperties");
    dict.add("voidFractionModel", voidFractionModel);
    dict.add("smoothingModel", smoothing);
    Foam::dictionary coefficients;
    coefficients.add("bandwidth", 3 * diameter);
    dict.add("constDiffSmoothingProps", coefficients);
    // It reaches 3 bandwidths: over several of the small cells, not through a baffle that the particle touches.
    Foam::dictionary gaussian;
    gaussian.add("bandwidth", 0.25 * diameter);
    dict.add("GaussianProps", gaussian);
    return dict;
}

/// A box of 3 x 3 x 4 cells of 2 mm of which the lower three layers are one cell, the first. Each rank makes its own.
std::unique_ptr<Foam::fvMesh> oneCellBelowNine(const Foam::Time& time)
{
    const std::unique_ptr<const Foam::fvMesh> equal = boxMesh(time, {0, 0, 0}, {6e-3, 6e-3, 8e-3}, {3, 3, 4});
    const auto merged = [](Foam::label cell) { return std::max(cell - 26, 0); };
    Foam::DynamicList<Foam::face> faces;
    Foam::DynamicList<Foam::label> owner;
    Foam::DynamicList<Foam::label> neighbour;
    forAll (equal->faces(), face)
    {
        const bool isInside = equal->isInternalFace(face);
        const Foam::label from = merged(equal->faceOwner()[face]);
        const Foam::label to = isInside ? merged(equal->faceNeighbour()[face]) : -1;
        if (from == to)
        {
            continue;
        }
        faces.append(equal->faces()[face]);
        owner.append(from);
        if (isInside)
        {
            neighbour.append(to);
        }
    }
    const Foam::label inside = neighbour.size();
    const Foam::label outside = faces.size() - inside;
    auto mesh = std::make_unique<Foam::fvMesh>(Foam::IOobject("coarseAndFine", time.timeName(), time),
        Foam::pointField(equal->points()), Foam::faceList(std::move(faces)), Foam::labelList(std::move(owner)),
        Foam::labelList(std::move(neighbour)), false);
    mesh->addFvPatches(Foam::List<Foam::polyPatch*>{new Foam::wallPolyPatch(
                           "walls", outside, inside, 0, mesh->boundaryMesh(), Foam::wallPolyPatch::typeName)},
        false);
    return mesh;
}

/// Particles put on a mesh by the whole chain: exchange between the ranks, shares, normalisation.
class ParticlesOnMesh
{
public:
    /// Every rank makes all particles and keeps its part of the numbers: not the part of space that it has the cells of.
    ParticlesOnMesh(const Foam::fvMesh& mesh, const std::vector<Vector3d>& positions, const Foam::dictionary& dict)
        : mesh_(mesh),
          engine_(1e-5),
          distribution_(dict, mesh),
          exchange_(MPI_COMM_WORLD, distribution_.cells().box(), distribution_.voidFractionModel().commonReach(),
              distribution_.periodicBox())
    {
        for (std::size_t particle = 0; particle < positions.size(); ++particle)
        {
            if (static_cast<int>(particle) % Foam::Pstream::nProcs() == Foam::Pstream::myProcNo())
            {
                engine_.addParticle(static_cast<int>(particle) + 1, positions[particle], diameter / 2);
            }
        }
        locate();
    }

    /// \param positions  of the same particles
    void moveTo(const std::vector<Vector3d>& positions)
    {
        for (Eigen::Index particle = 0; particle < engine_.particles().size(); ++particle)
        {
            const int id = engine_.particles().id[particle];
            engine_.moveParticle(id, positions[static_cast<std::size_t>(id) - 1]);
        }
        locate();
    }

    Foam::scalarField solidFraction() const
    {
        const auto& ghosts = exchange_.ghosts();
        Eigen::MatrixXd volumes(1, static_cast<Eigen::Index>(ghosts.size()));
        for (Eigen::Index particle = 0; particle < volumes.cols(); ++particle)
        {
            volumes(0, particle) = sphereVolume(ghosts[static_cast<std::size_t>(particle)].radius);
        }
        Foam::scalarField fraction(mesh_.nCells());
        columns(fraction) = distribution_.densities(volumes);
        return fraction;
    }

    Foam::scalarField smoothed(const Foam::scalarField& density) const
    {
        Eigen::MatrixXd densities = columns(density);
        distribution_.smooth(densities);
        Foam::scalarField result(density.size());
        columns(result) = densities;
        return result;
    }

    void smoothNearParticles()
    {
        bool asPlanned = false;
        while (!asPlanned)
        {
            RankTotals totals;
            distribution_.smoothNearParticles(totals);
            asPlanned = totals.reduce();
        }
    }

    /// A cell field at the particles of this rank.
    Eigen::RowVectorXd atParticles(const Foam::scalarField& field) const
    {
        return exchange_.sumAtOwners(distribution_.sample(columns(field)));
    }

    double integral(const Foam::scalarField& density) const
    {
        return Foam::gSum(Foam::scalarField(density * mesh_.V().field()));
    }

    /// Before normalisation.
    const Eigen::MatrixXd& shareSums() const
    {
        return shareSums_;
    }

private:
    void locate()
    {
        exchange_.send(engine_.particles(), Eigen::MatrixXd(0, engine_.particles().size()));
        shareSums_ = exchange_.sumAtOwners(distribution_.findCells(exchange_.ghosts()));
        distribution_.normalise(exchange_.toGhosts(shareSums_));
    }

    const Foam::fvMesh& mesh_;
    FakeEngine engine_;
    Distribution distribution_;
    ParticleExchange exchange_;
    Eigen::MatrixXd shareSums_;
};

/// Centres of particles that may touch the walls; the same on every rank.
std::vector<Vector3d> randomParticles(int count, const Vector3d& low, const Vector3d& high)
{
    std::mt19937 random(17);
    std::uniform_real_distribution<double> part(0, 1);
    std::vector<Vector3d> positions;
    for (int particle = 0; particle < count; ++particle)
    {
        Vector3d position;
        for (int axis = 0; axis < 3; ++axis)
        {
            const double room = high[axis] - low[axis] - diameter;
            position[axis] = low[axis] + diameter / 2 + room * part(random);
        }
        positions.push_back(position);
    }
    return positions;
}

std::vector<Vector3d> particlesEverywhere()
{
    return randomParticles(200, Vector3d::Zero(), {boxWidth, boxWidth, boxHeight});
}

} // namespace

class OnMesh : public testing::TestWithParam<std::tuple<double, const char*, const char*>>
{};

// The cells hold the particles' volume, to rounding, whatever the cells' size, the model, the smoothing and the number of
// ranks. An empty distribution holds nothing; one that is not normalised at walls or rank boundaries loses per cents.
TEST_P(OnMesh, CellsHoldTheParticlesVolume)
{
    const auto& [cellSize, model, smoothing] = GetParam();
    const BoxOnRanks box(cellSize, false);
    const std::vector<Vector3d> positions = particlesEverywhere();
    const ParticlesOnMesh particles(box.mesh(), positions, properties(model, smoothing));

    const double particleVolume = static_cast<double>(positions.size()) * sphereVolume(diameter / 2);
    EXPECT_NEAR(particles.integral(particles.solidFraction()) / particleVolume, 1, 1e-12);
    EXPECT_NEAR(particles.integral(particles.smoothed(particles.solidFraction())) / particleVolume, 1, 1e-12);
}

// What a particle samples is the adjoint of what it gives: sum over particles of V_p f(particle) = sum over cells of the particle's
// share of V f, with smoothing on either side. This is action = reaction for the pressure gradient. Sampling from the
// host cell, or smoothing on one side only, fails by per cents.
TEST_P(OnMesh, SamplingIsTheAdjointOfGiving)
{
    const auto& [cellSize, model, smoothing] = GetParam();
    const BoxOnRanks box(cellSize, false);
    const ParticlesOnMesh particles(box.mesh(), particlesEverywhere(), properties(model, smoothing));

    Foam::scalarField field(box.mesh().nCells());
    forAll (field, cell)
    {
        const Foam::vector& centre = box.mesh().C()[cell];
        field[cell] = std::sin(400 * centre.x()) + 100 * centre.z() * centre.y();
    }
    const double onParticles =
        Foam::returnReduce(sphereVolume(diameter / 2) * particles.atParticles(particles.smoothed(field)).sum(),
            Foam::sumOp<Foam::scalar>());
    const double onCells = particles.integral(Foam::scalarField(field * particles.smoothed(particles.solidFraction())));
    EXPECT_NEAR(onParticles / onCells, 1, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Cells, OnMesh,
    testing::Combine(testing::Values(1e-3, 4e-3), testing::Values("divided", "centre", "Gaussian"),
        testing::Values("off", "constDiffSmoothing")));

// On bricks the slabs cut the sphere so that its shares add up to one without normalisation, at any position and on
// any number of ranks. Weights that only look like shares do not.
TEST(Divided, SharesOfBricksAddUpToOne)
{
    for (const double cellSize : {1e-3, 4e-3})
    {
        const BoxOnRanks box(cellSize, false);
        const ParticlesOnMesh particles(box.mesh(), particlesEverywhere(), properties("divided", "off"));
        for (Eigen::Index particle = 0; particle < particles.shareSums().cols(); ++particle)
        {
            EXPECT_NEAR(particles.shareSums()(0, particle), 1, 1e-9)
                << "particle " << particle << ", cells of " << cellSize;
        }
    }
}

/// The part of a sphere that lies in a box, by the middles of fine strips in x and y and the exact chord along z.
double partInBox(const Vector3d& centre, double radius, const clepsydra::Box& box)
{
    constexpr int strips = 400;
    const Vector3d low = (box.min() - centre).cwiseMax(-radius);
    const Vector3d high = (box.max() - centre).cwiseMin(radius);
    const Vector3d step = (high - low) / strips;
    if (step.minCoeff() <= 0)
    {
        return 0;
    }
    double volume = 0;
    for (int i = 0; i < strips; ++i)
    {
        for (int j = 0; j < strips; ++j)
        {
            const double x = low.x() + (i + 0.5) * step.x();
            const double y = low.y() + (j + 0.5) * step.y();
            const double chord = std::sqrt(std::max(0.0, radius * radius - x * x - y * y));
            volume += std::max(0.0, std::min(chord, high.z()) - std::max(-chord, low.z()));
        }
    }
    return volume * step.x() * step.y() / sphereVolume(radius);
}

// The share of a particle in a brick is the part of it that lies there, where faces, edges and corners of cells pass through
// it, with cells of half a particle and of two, by a quadrature that knows nothing of the formula. The product of the parts
// between opposite faces, whose sums are right as well, has .0244 instead of .0153, and a hundredth where there is nothing.
TEST(Divided, ShareInABrickIsThePartOfTheSphereInIt)
{
    for (const double cellSize : {1e-3, 4e-3})
    {
        const BoxOnRanks box(cellSize, false);
        const CellSlabs cells(box.mesh());
        for (const Vector3d& centre :
            randomParticles(12, Vector3d::Constant(3e-3), Vector3d::Constant(boxWidth - 3e-3)))
        {
            for (int cell = 0; cell < box.mesh().nCells(); ++cell)
            {
                const Vector3d middle = toEigen(box.mesh().C()[cell]);
                const Vector3d half = Vector3d::Constant(0.5 * cellSize);
                const clepsydra::Box brick(middle - half, middle + half);
                if (cells.isNear(cell, centre, diameter / 2))
                {
                    EXPECT_NEAR(cells.share(cell, centre, diameter / 2, diameter / 2),
                        partInBox(centre, diameter / 2, brick), 1e-5)
                        << "particle at " << centre.transpose() << ", cell at " << middle.transpose();
                }
            }
        }
    }
}

// Particles that lie on a baffle of zero thickness, even pressed a little into it, put no volume behind it: not by their
// shares and not by diffusion. Kernels by distance, or without the wall rule, put per cents there.
TEST(Baffle, NothingLeaksThrough)
{
    for (const double cellSize : {1e-3, 4e-3})
    {
        const BoxOnRanks box(cellSize, true);
        std::vector<Vector3d> positions = randomParticles(50, {0, 0, boxHeight / 2}, {boxWidth, boxWidth, boxHeight});
        for (Vector3d& position : positions)
        {
            position.z() = boxHeight / 2 + 0.49 * diameter;
        }
        for (const char* model : {"divided", "centre", "Gaussian"})
        {
            const ParticlesOnMesh particles(box.mesh(), positions, properties(model, "constDiffSmoothing"));
            const Foam::scalarField raw = particles.solidFraction();
            const Foam::scalarField smooth = particles.smoothed(raw);
            double behind = 0;
            forAll (raw, cell)
            {
                if (box.mesh().C()[cell].z() < boxHeight / 2)
                {
                    behind = std::max({behind, std::abs(raw[cell]), std::abs(smooth[cell])});
                }
            }
            EXPECT_EQ(behind, 0) << model << ", cells of " << cellSize;
            const double particleVolume = static_cast<double>(positions.size()) * sphereVolume(diameter / 2);
            EXPECT_NEAR(particles.integral(smooth) / particleVolume, 1, 1e-12);
        }
    }
}

/// A void fraction model by itself: the part of each cell in the volume of a particle.
class PartsOfParticle
{
public:
    PartsOfParticle(const BoxOnRanks& box, const char* model, double kernelBandwidth)
        : cells_(box.mesh()),
          cellCount_(box.mesh().nCells())
    {
        Foam::dictionary dict = properties(model, "off");
        dict.subDict("GaussianProps").set("bandwidth", kernelBandwidth);
        model_ = VoidFractionModel::New(dict, cells_);
    }

    Foam::scalarField at(const Vector3d& centre) const
    {
        GhostParticle particle{};
        particle.position = centre;
        particle.radius = diameter / 2;
        std::vector<Foam::label> near;
        cells_.cellsNear(centre, model_->reach(particle), near);
        Foam::scalarField parts(cellCount_, 0.0);
        for (const Foam::label cell : near)
        {
            parts[cell] = model_->share(cell, particle);
        }
        return Foam::scalarField(parts / Foam::gSum(parts));
    }

private:
    const CellSlabs cells_;
    const Foam::label cellCount_;
    Foam::autoPtr<VoidFractionModel> model_;
};

// A particle beside the rim of a baffle that covers half of the box, in the plane of the baffle: what lies under the baffle
// hardly changes where the centre goes from half a micrometre above the plane to half a micrometre below. A kernel that takes
// the plane of the wall as endless moves a fifth of the particle from one side to the other.
TEST(Baffle, NothingJumpsBesideItsRim)
{
    const double rim = boxWidth / 2;
    for (const double cellSize : {1e-3, 2e-3})
    {
        const BoxOnRanks box(cellSize, true, rim);
        for (const char* model : {"divided", "Gaussian"})
        {
            const PartsOfParticle partsOfParticle(box, model, diameter);
            const auto partUnderBaffle = [&](double above) {
                const Foam::scalarField parts =
                    partsOfParticle.at({rim + 0.5 * diameter, boxWidth / 2, boxHeight / 2 + above});
                double part = 0;
                forAll (parts, cell)
                {
                    const Foam::point& at = box.mesh().C()[cell];
                    part += at.x() < rim && at.z() < boxHeight / 2 ? parts[cell] : 0;
                }
                return Foam::returnReduce(part, Foam::sumOp<Foam::scalar>());
            };
            const double before = partUnderBaffle(0.5e-6);
            EXPECT_NEAR(partUnderBaffle(-0.5e-6), before, 1e-3) << model << ", cells of " << cellSize;
            // The cells on either side of the baffle hold all of the kernel to the left of the rim, erfc(r/b)/2, before
            // the shares are normalised.
            const double left = 0.5 * std::erfc(0.5);
            EXPECT_NEAR(before, std::string(model) == "Gaussian" ? left / (1 + left) : 0, 0.02)
                << model << ", cells of " << cellSize;
        }
    }
}

// On its way around the rim, from below the baffle to above it, a particle's share of any cell changes by less the smaller the
// steps are. Where a wall cuts shares off at once, the largest change does not fall with the step.
TEST(Baffle, SharesAreContinuousAroundItsRim)
{
    const double rim = boxWidth / 2;
    const BoxOnRanks box(1e-3, true, rim);
    for (const char* model : {"divided", "Gaussian"})
    {
        const PartsOfParticle partsOfParticle(box, model, 0.5 * diameter);
        for (const double distance : {0.5 * diameter, 0.8 * diameter})
        {
            const auto largestChange = [&](int steps) {
                // In contact with the rim, and as far as the baffle's sides allow.
                const double end = M_PI - std::asin(0.5 * diameter / distance) * 0.999;
                double largest = 0;
                Foam::scalarField before;
                for (int step = 0; step <= steps; ++step)
                {
                    const double angle = end * (2.0 * step / steps - 1);
                    const Foam::scalarField now = partsOfParticle.at({rim + distance * std::cos(angle), 0.51 * boxWidth,
                        boxHeight / 2 + distance * std::sin(angle)});
                    if (step > 0)
                    {
                        largest = std::max(largest, Foam::gMax(Foam::mag(Foam::scalarField(now - before))));
                    }
                    before = now;
                }
                return largest;
            };
            const double coarse = largestChange(100);
            const double fine = largestChange(400);
            EXPECT_LT(fine, 0.35 * coarse) << model << " at " << distance << ": " << coarse;
        }
    }
}

// A kernel reaches a cell behind a baffle where the way around the rim is short enough, (L2 - r2)/b2 < 9, and no other. Where
// rounding decides about ways that are longer, some of these cells get exp(-9) of their full share.
TEST(Baffle, NothingComesAroundARimThatIsTooFar)
{
    const double rim = boxWidth / 2;
    const double bandwidth = 0.47 * diameter;
    const BoxOnRanks box(1e-3, true, rim);
    const PartsOfParticle partsOfParticle(box, "Gaussian", bandwidth);
    Foam::label reached = 0;
    Foam::label tooFar = 0;
    for (double x = 0.2 * rim; x < rim; x += 0.031 * rim)
    {
        const Vector3d centre(x, 0.4 * boxWidth, boxHeight / 2 + 0.5 * diameter);
        const Foam::scalarField parts = partsOfParticle.at(centre);
        forAll (parts, cell)
        {
            const Vector3d at = toEigen(box.mesh().C()[cell]);
            // The cells right under the baffle.
            if (at.x() > rim || std::abs(at.z() - boxHeight / 2 + 0.5e-3) > 0.1e-3)
            {
                continue;
            }
            const double around = std::hypot(rim - centre.x(), centre.z() - boxHeight / 2)
                                  + std::hypot(rim - at.x(), at.z() - boxHeight / 2);
            const double detourSqr = std::pow(std::hypot(around, at.y() - centre.y()), 2) - (at - centre).squaredNorm();
            if (detourSqr > 9.001 * bandwidth * bandwidth)
            {
                EXPECT_LT(parts[cell], 1e-20) << x << ": " << at.transpose();
                ++tooFar;
            }
            reached += parts[cell] > 1e-6;
        }
    }
    EXPECT_GT(Foam::returnReduce(reached, Foam::sumOp<Foam::label>()), 50);
    EXPECT_GT(Foam::returnReduce(tooFar, Foam::sumOp<Foam::label>()), 500);
}

// The boxes near a point are those that a look at all of them finds: in three arms of 26 m with 2 x 2 cells of 10 mm each, and
// among boxes of very different sizes. Bins of a cell's size over the box around the arms would be 2e10.
TEST(BoxTree, FindsWhatALookAtAllFinds)
{
    std::vector<clepsydra::Box> boxes;
    constexpr double width = 0.01;
    for (int axis = 0; axis < 3; ++axis)
    {
        for (int along = 0; along < 2600; ++along)
        {
            for (int across = 0; across < 4; ++across)
            {
                Vector3d low;
                low[axis] = along * width;
                low[(axis + 1) % 3] = (across % 2) * width;
                low[(axis + 2) % 3] = (across / 2) * width;
                boxes.emplace_back(low, low + Vector3d::Constant(width));
            }
        }
    }
    boxes.emplace_back(Vector3d(0, 0, 0), Vector3d(30, 30, 30));
    const BoxTree tree(boxes);
    EXPECT_EQ(tree.around().min(), Vector3d(0, 0, 0));
    EXPECT_EQ(tree.around().max(), Vector3d(30, 30, 30));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-1, 27);
    for (int query = 0; query < 60; ++query)
    {
        Vector3d centre(0.012, 0.004, 0.011);
        centre[query % 3] = place(random);
        const double radius = query % 2 == 0 ? 0.004 : 0.3;
        std::vector<int> found;
        tree.forEachNear(centre, radius, [&](int box) { found.push_back(box); });
        std::sort(found.begin(), found.end());
        std::vector<int> expected;
        for (std::size_t box = 0; box < boxes.size(); ++box)
        {
            if (cubeMeets(boxes[box], centre, radius))
            {
                expected.push_back(static_cast<int>(box));
            }
        }
        EXPECT_EQ(found, expected) << centre.transpose();
    }
    int none = 0;
    BoxTree().forEachNear(Vector3d::Zero(), 1, [&](int) { ++none; });
    EXPECT_EQ(none, 0);
}

// A mesh's walls are not quite the engine's: at an edge that snappyHexMesh cut short a small particle's centre may lie behind them.
// The particle is whole in the cells that it is the least behind; with walls that give nothing it would be in no cell.
TEST(Wall, AParticleBehindItByLessThanItsRadiusIsInTheCellBeforeIt)
{
    for (const double cellSize : {1e-3, 4e-3})
    {
        const BoxOnRanks box(cellSize, false);
        // in a corner, 0.6 of the radius below the bottom and 0.2 outside a side
        const Vector3d centre(-0.1 * diameter, boxWidth / 2 + 0.3e-3, -0.3 * diameter);
        for (const char* model : {"divided", "centre", "Gaussian"})
        {
            const ParticlesOnMesh particles(box.mesh(), {centre}, properties(model, "off"));
            const Foam::scalarField density = particles.solidFraction();
            const double volume = sphereVolume(diameter / 2);
            EXPECT_NEAR(particles.integral(density) / volume, 1, 1e-12) << model;
            if (std::string(model) == "divided")
            {
                const Foam::scalarField height(box.mesh().C().primitiveField().component(2));
                const Foam::scalarField fromSide(box.mesh().C().primitiveField().component(0));
                EXPECT_NEAR(particles.integral(Foam::scalarField(density * height)) / volume, 0.5 * cellSize, 1e-9);
                EXPECT_NEAR(particles.integral(Foam::scalarField(density * fromSide)) / volume, 0.5 * cellSize, 1e-9);
            }
        }
    }
}

// d(eps)/dt of a moving particle converges as the step falls: its jump from one step to the next falls with the step. With
// the cell of the centre it grows instead, which is the noise of the pressure in many codes.
TEST(Divided, VoidFractionIsSmoothInTime)
{
    const BoxOnRanks box(4e-3, false);
    const Vector3d velocity(0.1, 0.07, -0.2);
    const auto largestJump = [&](const char* model, double step) {
        const auto at = [&](double time) {
            return ParticlesOnMesh(
                box.mesh(), {Vector3d(0.0061, 0.0067, 0.0161) + time * velocity}, properties(model, "off"))
                .solidFraction();
        };
        Foam::scalarField before = at(-step);
        Foam::scalarField now = at(0);
        double largest = 0;
        for (double time = 0; time < 0.02; time += step)
        {
            const Foam::scalarField after = at(time + step);
            largest = std::max(largest, Foam::gMax(Foam::mag(Foam::scalarField(after - 2 * now + before))) / step);
            before = now;
            now = after;
        }
        return largest;
    };
    EXPECT_LT(largestJump("divided", 0.25e-3), 0.6 * largestJump("divided", 0.5e-3));
    EXPECT_GT(largestJump("centre", 0.25e-3), 1.5 * largestJump("centre", 0.5e-3));
}

// The kernel is the Gaussian of its bandwidth b, variance b2/2 along each axis (plus a cell's own s2/12), also where it
// spans the boundary of the ranks: the visit of a particle that touches no cell of a rank, but reaches some. A kernel cut at
// the particle's radius or at the rank's boundary is narrower.
TEST(Gaussian, HasItsBandwidth)
{
    const double bandwidth = diameter;
    const double cellSize = 1e-3;
    const BoxOnRanks box(cellSize, false);
    Foam::dictionary dict = properties("Gaussian", "off");
    dict.subDict("GaussianProps").set("bandwidth", bandwidth);
    const Vector3d centre(boxWidth / 2 - 0.6 * diameter, boxWidth / 2, boxHeight / 2);
    const ParticlesOnMesh particles(box.mesh(), {centre}, dict);
    const Foam::scalarField density = particles.solidFraction();
    const double volume = particles.integral(density);
    EXPECT_NEAR(volume / sphereVolume(diameter / 2), 1, 1e-12);
    for (const Foam::direction axis : {0, 2})
    {
        const Foam::scalarField from(box.mesh().C().primitiveField().component(axis) - centre[axis]);
        const double variance = particles.integral(Foam::scalarField(density * Foam::sqr(from))) / volume;
        // A wall 6.8 mm away keeps the tail.
        EXPECT_NEAR(variance / (0.5 * bandwidth * bandwidth + cellSize * cellSize / 12), 1, 0.01)
            << "axis " << int(axis);
    }
}

// The smoothing is the same on any mesh: the cloud of one particle has the variance of the kernel, b2/2 along each axis,
// on cells of half a particle and of two. Averaging over neighbours instead would widen with the cells.
TEST(ConstDiffSmoothing, KernelsWidthIsThatOfTheSmoothingBandwidth)
{
    const double smoothingBandwidth = 1.5 * diameter;
    for (const double cellSize : {1e-3, 2e-3})
    {
        const BoxOnRanks box(cellSize, false);
        Foam::dictionary dict = properties("divided", "constDiffSmoothing");
        dict.subDict("constDiffSmoothingProps").set("bandwidth", smoothingBandwidth);
        const Vector3d centre(boxWidth / 2, boxWidth / 2, boxHeight / 2);
        const ParticlesOnMesh particles(box.mesh(), {centre}, dict);
        const Foam::scalarField raw = particles.solidFraction();
        const Foam::scalarField heights(box.mesh().C().primitiveField().component(2));
        const auto variance = [&](const Foam::scalarField& density) {
            return particles.integral(Foam::scalarField(density * Foam::sqr(heights - centre.z())))
                   / particles.integral(density);
        };
        const double added = variance(particles.smoothed(raw)) - variance(raw);
        EXPECT_NEAR(added / (0.5 * smoothingBandwidth * smoothingBandwidth), 1, 5e-4) << "cells of " << cellSize;
    }
}

// What one cell holds spreads as the exact solution of diffusion on a lattice of cells between walls says: along each
// axis e^-2s I_n(2s) for n cells away, s = b2/(4 h2), and the walls' mirror images; the modified Bessel functions are the
// standard library's. This is the whole operator, on one rank and on two, with cells of b/6 and of 4 b/3. One implicit
// step instead, or a series cut too early, misses the peak by tens of per cents. A value below zero would be a void
// fraction above one.
TEST(ConstDiffSmoothing, IsTheExponentialOfDiffusionOnALattice)
{
    const double smoothingBandwidth = 3 * diameter;
    for (const double cellSize : {1e-3, 8e-3})
    {
        const BoxOnRanks box(cellSize, false);
        const double doubleTime = 0.5 * smoothingBandwidth * smoothingBandwidth / (cellSize * cellSize);
        const auto onLine = [&](int cells, int from, int to) {
            double sum = 0;
            for (int image = -8; image <= 8; ++image)
            {
                for (const int source : {2 * image * cells + from, 2 * image * cells - 1 - from})
                {
                    sum += std::exp(-doubleTime) * std::cyl_bessel_i(std::abs(to - source), doubleTime);
                }
            }
            return sum;
        };
        const auto indexOf = [&](const Foam::vector& centre) {
            return (Eigen::Vector3d(centre.x(), centre.y(), centre.z()) / cellSize).array().floor().cast<int>().eval();
        };
        const Eigen::Array3i cells = cubes(cellSize).array();
        const Eigen::Array3i source(cells[0] / 2, 0, 1);
        const Foam::vectorField& centres = box.mesh().C().primitiveField();
        Foam::scalarField density(box.mesh().nCells(), 0.0);
        forAll (density, cell)
        {
            density[cell] = (indexOf(centres[cell]) == source).all() ? 1 : 0;
        }
        const ParticlesOnMesh none(box.mesh(), {}, properties("divided", "constDiffSmoothing"));
        const Foam::scalarField smooth = none.smoothed(density);

        double worst = 0;
        forAll (smooth, cell)
        {
            const Eigen::Array3i at = indexOf(centres[cell]);
            double expected = 1;
            for (int axis = 0; axis < 3; ++axis)
            {
                expected *= onLine(cells[axis], source[axis], at[axis]);
            }
            worst = std::max(worst, std::abs(smooth[cell] - expected));
        }
        EXPECT_LT(worst, 1e-6) << "cells of " << cellSize;
        EXPECT_GT(Foam::gMin(smooth), -1e-6) << "cells of " << cellSize;
        EXPECT_NEAR(Foam::gSum(smooth), 1, 1e-13) << "cells of " << cellSize;
    }
}

// A cell that has nine neighbours on one side, as beside a finer part of a mesh, and its neighbours: what each quantity in
// them becomes is the exponential of the matrix of diffusion, from its eigenvectors. A sweep that stops at six neighbours,
// as many as a hexahedron has, misses values by per cents.
TEST(ConstDiffSmoothing, IsTheExponentialOfDiffusionBesideAFinerMesh)
{
    const TemporaryCase folder;
    const std::unique_ptr<Foam::fvMesh> mesh = oneCellBelowNine(folder.time());
    const Foam::label cellCount = mesh->nCells();
    ASSERT_EQ(mesh->cells()[0].size(), 9 + 9 + 4 * 9);
    Eigen::MatrixXd diffusion = Eigen::MatrixXd::Zero(cellCount, cellCount);
    Foam::scalarField density(cellCount);
    forAll (mesh->neighbour(), face)
    {
        const Foam::label owner = mesh->owner()[face];
        const Foam::label neighbour = mesh->neighbour()[face];
        const double conductance = mesh->magSf()[face] * mesh->deltaCoeffs()[face];
        diffusion(owner, owner) += conductance;
        diffusion(neighbour, neighbour) += conductance;
        diffusion(owner, neighbour) -= conductance;
        diffusion(neighbour, owner) -= conductance;
    }
    forAll (density, cell)
    {
        density[cell] = std::sin(1 + 2 * cell);
    }
    const Eigen::VectorXd root = columns(mesh->V().field()).transpose().array().sqrt();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(
        root.cwiseInverse().asDiagonal() * diffusion * root.cwiseInverse().asDiagonal());
    const Foam::dictionary dict = properties("divided", "constDiffSmoothing");
    const double time = Foam::sqr(dict.subDict("constDiffSmoothingProps").get<double>("bandwidth")) / 4;
    const Eigen::VectorXd weighted = root.cwiseProduct(columns(density).transpose());
    const Eigen::VectorXd decay = (-time * modes.eigenvalues()).array().exp();
    const Eigen::VectorXd expected =
        (modes.eigenvectors() * decay.asDiagonal() * modes.eigenvectors().transpose() * weighted).cwiseQuotient(root);

    const ParticlesOnMesh none(*mesh, {}, dict);
    const Foam::scalarField smooth = none.smoothed(density);
    forAll (smooth, cell)
    {
        EXPECT_NEAR(smooth[cell], expected[cell], 1e-5) << cell;
    }
    EXPECT_NEAR(none.integral(smooth) / none.integral(Foam::mag(density)),
        none.integral(density) / none.integral(Foam::mag(density)), 1e-14);
}

// On cells of b/60 it is the Gaussian exp(-r2/b2) itself, to 1e-4 of the peak and no nearer zero anywhere: the lattice's
// peak is 1 + h2/(4 b2) times as high.
TEST(ConstDiffSmoothing, IsAGaussianOnAFineMesh)
{
    const int layers = 640;
    const double cellSize = boxHeight / layers;
    const double smoothingBandwidth = 60 * cellSize;
    const BoxOnRanks box(Eigen::Vector3i(2, 1, layers));
    Foam::dictionary dict = properties("divided", "constDiffSmoothing");
    dict.subDict("constDiffSmoothingProps").set("bandwidth", smoothingBandwidth);
    const Foam::scalarField heights(box.mesh().C().primitiveField().component(2));
    const double source = 0.5 * (layers + 1) * cellSize; // the middle of a cell, for there is an even number
    Foam::scalarField density(heights.size(), 0.0);
    forAll (density, cell)
    {
        density[cell] = std::abs(heights[cell] - source) < 0.1 * cellSize ? 1 / cellSize : 0;
    }
    const ParticlesOnMesh none(box.mesh(), {}, dict);
    const Foam::scalarField smooth = none.smoothed(density);
    const double peak = 1 / (std::sqrt(M_PI) * smoothingBandwidth);
    forAll (smooth, cell)
    {
        const double away = (heights[cell] - source) / smoothingBandwidth;
        ASSERT_NEAR(smooth[cell] / peak, std::exp(-away * away), 1e-4) << away;
    }
}

// Particles near one end: beyond four smoothing bandwidths and two cells, cells keep exactly what they have, 0, where the smoothing of the
// whole mesh leaves the rounding of its series; nearer they are the same to a millionth of the peak. Still conservative
// and self-adjoint to rounding, also where the boundary between two ranks passes through.
TEST(ConstDiffSmoothing, LeavesOutWhatIsFarFromParticles)
{
    constexpr double smoothingBandwidth = 1.5 * diameter;
    double farAway = 0;
    // The last is wider than the smoothing bandwidth.
    for (const double cellSize : {1e-3, 2e-3, 4e-3})
    {
        const BoxOnRanks box(cellSize, false);
        Foam::dictionary dict = properties("divided", "constDiffSmoothing");
        dict.subDict("constDiffSmoothingProps").set("bandwidth", smoothingBandwidth);
        ParticlesOnMesh particles(box.mesh(), {{0.0085, 0.01, 0.002}, {0.004, 0.01, 0.003}}, dict);
        const Foam::scalarField density = particles.solidFraction();
        const Foam::scalarField whole = particles.smoothed(density);
        particles.smoothNearParticles();
        const Foam::scalarField near = particles.smoothed(density);
        const double peak = Foam::gMax(whole);
        const Foam::vectorField& centres = box.mesh().C();
        forAll (near, cell)
        {
            ASSERT_NEAR(near[cell] / peak, whole[cell] / peak, 1e-6) << toEigen(centres[cell]).transpose();
            if (centres[cell].z() > 0.004 + 4 * smoothingBandwidth + 3 * cellSize)
            {
                EXPECT_EQ(near[cell], 0);
                farAway = std::max(farAway, std::abs(whole[cell]));
            }
        }
        EXPECT_NEAR(particles.integral(near) / particles.integral(density), 1, 1e-13);
        const Foam::scalarField other(
            centres.component(Foam::vector::Z)() + 0.3 * centres.component(Foam::vector::X)());
        EXPECT_NEAR(
            particles.integral(near * other) / particles.integral(density * particles.smoothed(other)), 1, 1e-12);
    }
    EXPECT_GT(Foam::returnReduce(farAway, Foam::maxOp<double>()), 0) << "the box is too small to leave anything out";
}

namespace
{

/// The steps of some particles: their places in each.
using Steps = std::vector<std::vector<Vector3d>>;

/// 24 particles that touch each other.
std::vector<Vector3d> gatheredAt(double x, double z)
{
    std::vector<Vector3d> positions;
    for (int particle = 0; particle < 24; ++particle)
    {
        positions.emplace_back(x + 1e-3 * (particle % 2), 0.003 + 1e-3 * (particle / 2 % 3), z + 1e-3 * (particle / 6));
    }
    return positions;
}

/// As many, over the whole box.
std::vector<Vector3d> spreadOut()
{
    std::vector<Vector3d> positions = particlesEverywhere();
    positions.resize(24);
    return positions;
}

/// What is left out is in each step what a model finds that sees these particles for the first time, to the last bit.
/// \return reductions in each step to find it
std::vector<long> expectFollowed(const Steps& steps, double smoothingBandwidth)
{
    const BoxOnRanks box(1e-3, false);
    Foam::dictionary dict = properties("divided", "constDiffSmoothing");
    dict.subDict("constDiffSmoothingProps").set("bandwidth", smoothingBandwidth);
    ParticlesOnMesh kept(box.mesh(), steps.front(), dict);
    std::vector<long> reductions;
    for (std::size_t step = 0; step < steps.size(); ++step)
    {
        kept.moveTo(steps[step]);
        const long before = RankTotals::reductions();
        kept.smoothNearParticles();
        reductions.push_back(RankTotals::reductions() - before);
        ParticlesOnMesh fresh(box.mesh(), steps[step], dict);
        fresh.smoothNearParticles();
        const Foam::scalarField density = fresh.solidFraction();
        const Foam::scalarField expected = fresh.smoothed(density);
        const Foam::scalarField found = kept.smoothed(density);
        Foam::label different = 0;
        forAll (found, cell)
        {
            different += found[cell] == expected[cell] ? 0 : 1;
        }
        EXPECT_EQ(Foam::returnReduce(different, Foam::sumOp<Foam::label>()), 0) << "cells in step " << step;
    }
    return reductions;
}

} // namespace

// Particles that creep, jump, spread over the whole box and gather again. A model that keeps the cells of the step before
// smooths where no particle is, or nowhere. While particles creep, the ranks confirm the plan in one reduction.
TEST(ConstDiffSmoothing, FollowsTheParticles)
{
    Steps steps;
    for (int step = 0; step < 5; ++step)
    {
        steps.push_back(gatheredAt(0.003 + 2e-4 * step, 0.003));
    }
    for (const auto& positions :
        {gatheredAt(0.012, 0.025), spreadOut(), gatheredAt(0.003, 0.003), gatheredAt(0.0075, 0.016)})
    {
        steps.push_back(positions);
    }
    const std::vector<long> reductions = expectFollowed(steps, diameter);
    for (std::size_t step = 1; step < 5; ++step)
    {
        EXPECT_EQ(reductions[step], 1) << "step " << step;
    }
}

// Particles that are everywhere at first, so that all cells are smoothed. One that goes on with all has the rounding of its
// series in cells without particles when these have gathered.
TEST(ConstDiffSmoothing, LeavesOutCellsOnceParticlesHaveGathered)
{
    expectFollowed({spreadOut(), gatheredAt(0.003, 0.003)}, diameter);
}

// Particles that at first are so far from the other rank's cells that one round finds all near ones, and then beside them. One
// that keeps the number of rounds leaves out cells of the other rank.
TEST(ConstDiffSmoothing, FindsCellsOfAnotherRankOnceParticlesAreNearIt)
{
    expectFollowed({gatheredAt(0.0015, 0.003), gatheredAt(0.0055, 0.003)}, 0.25 * diameter);
}

// Quantities that pass the mesh together do not touch one another, however many they are.
TEST(ConstDiffSmoothing, SmoothsEachQuantityByItself)
{
    const BoxOnRanks box(4e-3, false);
    const Distribution distribution(properties("divided", "constDiffSmoothing"), box.mesh());
    Eigen::MatrixXd together = Eigen::MatrixXd::Random(13, box.mesh().nCells());
    const Eigen::MatrixXd before = together;
    distribution.smooth(together);
    for (Eigen::Index row = 0; row < together.rows(); ++row)
    {
        Eigen::MatrixXd alone = before.row(row);
        distribution.smooth(alone);
        EXPECT_LT((together.row(row) - alone).cwiseAbs().maxCoeff(), 1e-14) << row;
        EXPECT_LT(alone.cwiseAbs().maxCoeff(), 0.9 * before.row(row).cwiseAbs().maxCoeff());
    }
}

// Particles near cyclic patches, on one rank and on two, between which the patches then lie. A periodic mesh has no
// beginning: where particles are moved by half its length, so that they pass its ends, everything moves with them by
// whole cells and is otherwise the same to rounding. Without images the part of a particle beyond an end is missing at
// the other end, and with images in one of the operations only, sums and samples differ.

namespace
{

using Axes = std::array<bool, 3>;

/// Values of all cells of the box, on every rank, by their places in it.
class WholeBox
{
public:
    WholeBox(const Foam::fvMesh& mesh, double cellSize, const Foam::scalarField& values)
        : counts_(cubes(cellSize)),
          values_(Eigen::VectorXd::Zero(counts_.prod()))
    {
        forAll (values, cell)
        {
            values_[indexOf(placeOf(mesh, cellSize, cell))] = values[cell];
        }
        MPI_Allreduce(
            MPI_IN_PLACE, values_.data(), static_cast<int>(values_.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    }

    static Eigen::Vector3i placeOf(const Foam::fvMesh& mesh, double cellSize, Foam::label cell)
    {
        return (toEigen(mesh.C()[cell]) / cellSize).array().floor().cast<int>();
    }

    /// Largest difference to another one whose values are moved by a number of cells, around the ends of the box.
    double difference(const WholeBox& other, const Eigen::Vector3i& moved) const
    {
        double largest = 0;
        Eigen::Vector3i at;
        for (at.z() = 0; at.z() < counts_.z(); ++at.z())
        {
            for (at.y() = 0; at.y() < counts_.y(); ++at.y())
            {
                for (at.x() = 0; at.x() < counts_.x(); ++at.x())
                {
                    const Eigen::Vector3i there = (at + moved).binaryExpr(counts_, [](int i, int n) { return i % n; });
                    largest = std::max(largest, std::abs(values_[indexOf(at)] - other.values_[indexOf(there)]));
                }
            }
        }
        return largest;
    }

    double largest() const
    {
        return values_.cwiseAbs().maxCoeff();
    }

private:
    Eigen::Index indexOf(const Eigen::Vector3i& at) const
    {
        return at.x() + counts_.x() * (at.y() + counts_.y() * at.z());
    }

    Eigen::Vector3i counts_;
    Eigen::VectorXd values_;
};

/// Particles in the middle of the box, away from its ends; the same on every rank.
std::vector<Vector3d> particlesInTheMiddle(int count)
{
    std::mt19937 random(23);
    std::uniform_real_distribution<double> part(0.35, 0.65);
    std::vector<Vector3d> positions;
    for (int particle = 0; particle < count; ++particle)
    {
        positions.emplace_back(boxWidth * part(random), boxWidth * part(random), boxHeight * part(random));
    }
    return positions;
}

/// The particles moved by half the box along the periodic axes: the first third is where an engine leaves them until it
/// builds its lists, beyond the ends; the second third is wrapped; the others are some lengths away.
std::vector<Vector3d> movedByHalf(std::vector<Vector3d> positions, const PeriodicBox& periodic)
{
    for (std::size_t particle = 0; particle < positions.size(); ++particle)
    {
        positions[particle] += 0.5 * periodic.length;
        if (particle % 3 == 1)
        {
            positions[particle] = periodic.wrapped(positions[particle]);
        }
        if (particle % 3 == 2)
        {
            positions[particle] -= 2 * periodic.length;
        }
    }
    return positions;
}

/// A field without symmetry, as a function of the place in the box.
double valueAt(const Eigen::Vector3i& at, const Eigen::Vector3i& counts)
{
    return std::sin(1.7 * (at.x() % counts.x())) + std::cos(0.9 * (at.y() % counts.y())) * ((at.z() % counts.z()) % 5);
}

std::string textOf(const Axes& axes)
{
    std::string text = "periodic along ";
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
    {
        text += axes[axis] ? std::string(1, "xyz"[axis]) : "";
    }
    return text;
}

} // namespace

class Periodic : public testing::TestWithParam<std::tuple<double, Axes>>
{};

// Across the ends of the box as in its middle: void fraction, smoothing on the whole mesh and near the particles, and
// what is sampled.
TEST_P(Periodic, AcrossTheEndsAsInTheMiddle)
{
    const auto& [cellSize, axes] = GetParam();
    SCOPED_TRACE(textOf(axes) + ", cells of " + std::to_string(cellSize));
    const BoxOnRanks box(cubes(cellSize), {}, axes);
    const BoxOnRanks walled(cellSize, false);
    const PeriodicBox periodic = periodicBoxOf(box.mesh());
    Eigen::Vector3i moved;
    for (int axis = 0; axis < 3; ++axis)
    {
        ASSERT_NEAR(periodic.length[axis], axes[axis] ? (axis == 2 ? boxHeight : boxWidth) : 0, 1e-15);
        moved[axis] = axes[axis] ? cubes(cellSize)[axis] / 2 : 0;
    }
    const std::vector<Vector3d> inMiddle = particlesInTheMiddle(30);
    const std::vector<Vector3d> acrossEnds = movedByHalf(inMiddle, periodic);
    const Eigen::Vector3i counts = cubes(cellSize);
    Foam::scalarField field(box.mesh().nCells());
    Foam::scalarField movedField(field.size());
    forAll (field, cell)
    {
        const Eigen::Vector3i at = WholeBox::placeOf(box.mesh(), cellSize, cell);
        field[cell] = valueAt(at, counts);
        movedField[cell] = valueAt(at + counts - moved, counts);
    }

    for (const char* model : {"divided", "centre", "Gaussian"})
    {
        SCOPED_TRACE(model);
        Foam::dictionary dict = properties(model, "constDiffSmoothing");
        // Near the particles is not everywhere then, along the longest side, and no cell lies exactly where it ends.
        dict.subDict("constDiffSmoothingProps").set("bandwidth", 0.45 * diameter);
        ParticlesOnMesh middle(box.mesh(), inMiddle, dict);
        ParticlesOnMesh ends(box.mesh(), acrossEnds, dict);
        const auto whole = [&, size = cellSize](
                               const Foam::scalarField& values) { return WholeBox(box.mesh(), size, values); };

        const WholeBox solid = whole(middle.solidFraction());
        EXPECT_LT(solid.difference(whole(ends.solidFraction()), moved), 1e-11 * solid.largest());
        // As in a box with walls, which these particles do not reach.
        const ParticlesOnMesh apart(walled.mesh(), inMiddle, dict);
        EXPECT_LT(WholeBox(walled.mesh(), cellSize, apart.solidFraction()).difference(solid, {0, 0, 0}),
            1e-13 * solid.largest());
        const double particleVolume = 30 * sphereVolume(diameter / 2);
        EXPECT_NEAR(ends.integral(ends.solidFraction()) / particleVolume, 1, 1e-12);

        for (const bool nearOnly : {false, true})
        {
            const WholeBox smooth = whole(middle.smoothed(middle.solidFraction()));
            const WholeBox smoothAtEnds = whole(ends.smoothed(ends.solidFraction()));
            EXPECT_LT(smooth.difference(smoothAtEnds, moved), 1e-11 * smooth.largest()) << nearOnly;
            EXPECT_NEAR(ends.integral(ends.smoothed(ends.solidFraction())) / particleVolume, 1, 1e-12) << nearOnly;
            middle.smoothNearParticles();
            ends.smoothNearParticles();
        }
        const Eigen::RowVectorXd sampled = middle.atParticles(field);
        EXPECT_LT((sampled - ends.atParticles(movedField)).cwiseAbs().maxCoeff(), 1e-10);
        const Eigen::RowVectorXd smoothSampled = middle.atParticles(middle.smoothed(field));
        EXPECT_LT((smoothSampled - ends.atParticles(ends.smoothed(movedField))).cwiseAbs().maxCoeff(), 1e-10);
    }
}

INSTANTIATE_TEST_SUITE_P(Axes, Periodic,
    testing::Combine(testing::Values(1e-3, 4e-3), testing::Values(Axes{true, false, false}, Axes{false, false, true},
                                                      Axes{true, true, false}, Axes{true, true, true})));

// The shares of all images add up to one without normalisation. One image too many is a particle of double volume.
TEST(PeriodicShares, OfAllImagesAddUpToOne)
{
    const BoxOnRanks box(cubes(4e-3), {}, {true, true, true});
    const ParticlesOnMesh particles(
        box.mesh(), movedByHalf(particlesInTheMiddle(60), periodicBoxOf(box.mesh())), properties("divided", "off"));
    ASSERT_GT(
        Foam::returnReduce(static_cast<Foam::label>(particles.shareSums().cols()), Foam::sumOp<Foam::label>()), 0);
    for (Eigen::Index particle = 0; particle < particles.shareSums().cols(); ++particle)
    {
        EXPECT_NEAR(particles.shareSums()(0, particle), 1, 1e-9);
    }
}

// A kernel that is wider than the box has several images in each cell. Its shares are those of a box twice as long with
// two particles; here: the kernel becomes uniform, to exp(-(pi b/L)2).
TEST(PeriodicShares, OfAKernelWiderThanTheBoxAreUniform)
{
    const BoxOnRanks box(cubes(4e-3), {}, {true, true, true});
    Foam::dictionary dict = properties("Gaussian", "off");
    dict.subDict("GaussianProps").set("bandwidth", 1.5 * boxHeight);
    const ParticlesOnMesh particles(box.mesh(), {Vector3d(0.001, 0.002, 0.031)}, dict);
    const Foam::scalarField fraction = particles.solidFraction();
    const double mean = sphereVolume(diameter / 2) / (boxWidth * boxWidth * boxHeight);
    EXPECT_NEAR(Foam::gMin(fraction) / mean, 1, 2e-3);
    EXPECT_NEAR(Foam::gMax(fraction) / mean, 1, 2e-3);
}

// A baffle that passes the cyclic patches does not end there: what lies under it is the same as under one in the middle of
// the box. With walls that end at the patches, kernels pass around the ends of the baffle that are none.
TEST(PeriodicBaffle, AcrossTheEndsAsInTheMiddle)
{
    constexpr double cellSize = 1e-3;
    // A leak around an end that is none is a tenth.
    constexpr double rounding = 1e-11;
    const Eigen::Vector3i cells = cubes(cellSize);
    const Eigen::Vector3i moved(cells.x() / 2, 0, 0);
    const BoxOnRanks middle(cells, {{0.25 * boxWidth, 0.75 * boxWidth}}, {true, false, false});
    const BoxOnRanks ends(cells, {{-1, 0.25 * boxWidth}, {0.75 * boxWidth, 1}}, {true, false, false});
    Foam::dictionary dict = properties("Gaussian", "constDiffSmoothing");
    // Its reach ends in cells, not at a face of some, where rounding would decide.
    dict.subDict("GaussianProps").set("bandwidth", 0.47 * diameter);
    // On the middle of the baffle, off its middle so that the ways to its two ends differ, and beside its end.
    for (const double x : {0.5 * boxWidth, 0.46 * boxWidth, 0.3 * boxWidth, 0.21 * boxWidth})
    {
        SCOPED_TRACE(x);
        const Vector3d at(x, 0.4 * boxWidth, boxHeight / 2 + 0.5 * diameter);
        const ParticlesOnMesh onMiddle(middle.mesh(), {at}, dict);
        const ParticlesOnMesh onEnds(
            ends.mesh(), {periodicBoxOf(ends.mesh()).wrapped(at + Vector3d(boxWidth / 2, 0, 0))}, dict);
        const Foam::scalarField fraction = onMiddle.solidFraction();
        const WholeBox solid(middle.mesh(), cellSize, fraction);
        EXPECT_LT(solid.difference(WholeBox(ends.mesh(), cellSize, onEnds.solidFraction()), moved),
            rounding * solid.largest());
        const WholeBox smooth(middle.mesh(), cellSize, onMiddle.smoothed(fraction));
        EXPECT_LT(smooth.difference(WholeBox(ends.mesh(), cellSize, onEnds.smoothed(onEnds.solidFraction())), moved),
            rounding * smooth.largest());
    }
}

// The images near a box are those that a look at many finds.
TEST(PeriodicBoxTest, FindsEachImageNearABoxOnce)
{
    const PeriodicBox periodic{{-1, 0, 5}, {2, 0, 3}};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-9, 9);
    std::uniform_real_distribution<double> size(0, 4);
    for (int query = 0; query < 200; ++query)
    {
        const Vector3d low(place(random), place(random), place(random));
        const clepsydra::Box box(low, low + Vector3d(size(random), size(random), size(random)));
        const Vector3d centre(place(random), place(random), place(random));
        const double radius = size(random);
        int expected = 0;
        for (int x = -20; x <= 20; ++x)
        {
            for (int z = -20; z <= 20; ++z)
            {
                expected += cubeMeets(box, periodic.image(centre, {x, 0, z}), radius) ? 1 : 0;
            }
        }
        std::map<std::pair<int, int>, int> found;
        periodic.forEachImage(box, centre, radius, [&](const Vector3d& at, const Eigen::Vector3i& periods) {
            EXPECT_TRUE(cubeMeets(box, at, radius));
            EXPECT_EQ(periods.y(), 0);
            ++found[{periods.x(), periods.z()}];
        });
        EXPECT_EQ(static_cast<int>(found.size()), expected);
        for (const auto& [periods, count] : found)
        {
            EXPECT_EQ(count, 1);
        }
        const clepsydra::Box around(centre - Vector3d::Constant(radius), centre + Vector3d::Constant(radius));
        EXPECT_EQ(periodic.imagesIntersect(around, box), expected > 0);
        const Vector3d wrapped = periodic.wrapped(centre);
        EXPECT_TRUE(wrapped.x() >= -1 && wrapped.x() <= 1 && wrapped.y() == centre.y());
        EXPECT_LE(std::abs(periodic.nearest(centre - low).z()), 1.5 + 1e-12);
        EXPECT_LT(periodic.nearest(wrapped - centre).norm(), 1e-12);
    }
    const PeriodicBox none;
    int calls = 0;
    none.forEachImage(clepsydra::Box(), Vector3d::Zero(), 1, [&](const Vector3d&, const Eigen::Vector3i&) { ++calls; });
    periodic.forEachImage(
        clepsydra::Box(), Vector3d::Zero(), 1, [&](const Vector3d&, const Eigen::Vector3i&) { ++calls; });
    EXPECT_EQ(calls, 0);
    EXPECT_FALSE(periodic.imagesIntersect(clepsydra::Box(), clepsydra::Box(Vector3d::Zero(), Vector3d::Ones())));
}

} // namespace clepsydra::tests
