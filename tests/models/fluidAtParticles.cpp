/// \file
/// What the forces read of the fluid, held against flows whose acceleration and vorticity are known: a field that is
/// computed with a wrong sign, or not at all, would still give every force that is tested with fluid values put in by hand.

#include "couplingStep/couplingStep.h"
#include "support/boxMesh.h"
#include "support/fakeEngine.h"
#include "support/fluidWithoutContinuity.h"
#include "support/temporaryCase.h"
#include "vectors.h"

#include "fvcFlux.H"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

namespace
{

using namespace Foam;

using Flow = std::function<vector(const vector& position)>;

constexpr double density = 1000;
constexpr int cells = 12;
constexpr double cellSize = 1.0 / cells;

/// One particle that is held in the middle of a cell of a box of one cubic metre, in a fluid whose velocity is given.
class ParticleInFlow
{
public:
    /// Another particle, which is held as well.
    struct Neighbour
    {
        Vector3d fromMiddle;
        double radius;
    };

    /// \param entries  of couplingProperties, beside the usual ones
    explicit ParticleInFlow(
        const std::string& entries, double couplingTimeStep = 1e-3, const std::vector<Neighbour>& neighbours = {})
        : case_("deltaT " + std::to_string(couplingTimeStep) + ";"),
          engine_(1e-4, Vector3d::Zero()),
          couplingTimeStep_(couplingTimeStep)
    {
        case_.writeDictionary("constant/couplingProperties",
            "fluid incompressible; modelType A; couplingTimeStep " + std::to_string(couplingTimeStep)
                + "; voidFractionModel divided; smoothingModel off; momCoupleModels (explicitCouple); "
                  "useDDTvoidfraction off; "
                  "DEM { engine liggghts; script none; } "
                  "forceModels (StokesDrag gradPForce viscForce Archimedes virtualMassForce SaffmanLiftForce); "
                + entries);
        mesh_ = boxMesh(case_.time(), point::zero, point::one, {cells, cells, cells});
        readFromCase<fvSchemes>(*mesh_);
        readFromCase<fvSolution>(*mesh_);
        engine_.addParticle(1, middle(), 0.02);
        engine_.holdParticle(1);
        for (const Neighbour& neighbour : neighbours)
        {
            const int id = 2 + static_cast<int>(&neighbour - neighbours.data());
            engine_.addParticle(id, middle() + neighbour.fromMiddle, neighbour.radius);
            engine_.holdParticle(id);
        }
        U_ = std::make_unique<volVectorField>(IOobject("U", case_.time().timeName(), *mesh_), *mesh_,
            dimensionedVector("U", dimVelocity, vector::zero), "calculated");
        p_ = std::make_unique<volScalarField>(IOobject("p", case_.time().timeName(), *mesh_), *mesh_,
            dimensionedScalar("p", dimPressure / dimDensity, 0), "zeroGradient");
        settings_ = std::make_unique<CouplingSettings>(case_.time());
        const FluidProperties fluid{density, 1e-3, Vector3d::Zero()};
        models_ = std::make_unique<FluidModels>(*mesh_, *settings_, fluid, timers_);
        couplingStep_ =
            std::make_unique<CouplingStep>(*mesh_, *settings_, fluid, engine_, models_.get(), timers_, false);
        couplingStep_->start(*U_, fvc::flux(*U_), *p_);
    }

    /// Where the particle is: not in the middle of the box, where much is zero.
    static Vector3d middle()
    {
        return cellSize * Vector3d(7.5, 4.5, 8.5);
    }

    void setFlow(const Flow& flow)
    {
        forAll (*U_, cell)
        {
            (*U_)[cell] = flow(mesh_->C()[cell]);
        }
        for (fvPatchVectorField& patch : U_->boundaryFieldRef())
        {
            const vectorField& centres = patch.patch().Cf();
            patch == vectorField(centres.size());
            forAll (centres, face)
            {
                patch[face] = flow(centres[face]);
            }
        }
    }

    /// One coupling step, in which the fluid comes from one flow to another.
    void advance(const Flow& before, const Flow& after)
    {
        case_.time().setDeltaT(couplingStep_->lengthWithin(VGREAT), false);
        ++case_.time();
        setFlow(before);
        U_->storeOldTime();
        setFlow(after);
        ParticlesInFluid particles = couplingStep_->advanceParticles(VGREAT);
        couplingStep_->fluidToParticles(
            recordWithoutContinuity(particles, particles.momentumSource(*U_), *U_, *p_), *U_, fvc::flux(*U_), *p_);
    }

    const FluidAtParticle& fluid(Eigen::Index particle = 0)
    {
        return engine_.particles().state[particle].fluid;
    }

    /// Length of the next coupling step [s].
    double nextCouplingTimeStep()
    {
        return couplingStep_->lengthWithin(VGREAT);
    }

    double couplingTimeStep() const
    {
        return couplingTimeStep_;
    }

private:
    TemporaryCase case_;
    std::unique_ptr<fvMesh> mesh_;
    PhaseTimers timers_;
    FakeEngine engine_;
    const double couplingTimeStep_;
    std::unique_ptr<volVectorField> U_;
    std::unique_ptr<volScalarField> p_;
    std::unique_ptr<CouplingSettings> settings_;
    std::unique_ptr<FluidModels> models_;
    std::unique_ptr<CouplingStep> couplingStep_;
};

/// A fluid that turns as a solid body with the angular velocity W: its acceleration is W x (W x r), towards the axis, and
/// its vorticity 2 W. The convective part with the wrong sign points away from the axis, and so does one with the
/// transposed gradient, which is antisymmetric here; without it, there is none.
TEST(FluidAtParticles, TurnsAsASolidBody)
{
    ParticleInFlow test("");
    const Vector3d turning(1, -2, 3);
    const Flow rotation = [&](const vector& at) { return toFoam(turning.cross(toEigen(at))); };
    test.advance(rotation, rotation);
    const Vector3d expected = turning.cross(turning.cross(ParticleInFlow::middle()));
    EXPECT_GT(expected.norm(), 5);
    EXPECT_LT((test.fluid().acceleration - expected).norm(), 1e-9) << test.fluid().acceleration.transpose();
    EXPECT_LT((test.fluid().vorticity - 2 * turning).norm(), 1e-9) << test.fluid().vorticity.transpose();
}

/// A stream that converges along x: U = (k x, -k y, 0) has the acceleration U dU/dx = (k2 x, k2 y, 0) where it is steady and
/// no vorticity. Where all of it gets faster by 3 m/s2 along z meanwhile, that comes in addition.
TEST(FluidAtParticles, AccelerateInAConvergingStream)
{
    ParticleInFlow test("");
    const double k = 2;
    const Flow stream = [&](const vector& at) { return vector(k * at.x(), -k * at.y(), 0); };
    const Flow faster = [&](const vector& at) { return stream(at) + vector(0, 0, 3 * test.couplingTimeStep()); };
    const Vector3d at = ParticleInFlow::middle();
    test.advance(stream, stream);
    EXPECT_LT((test.fluid().acceleration - k * k * Vector3d(at.x(), at.y(), 0)).norm(), 1e-9);
    EXPECT_LT(test.fluid().vorticity.norm(), 1e-9);
    test.advance(stream, faster);
    EXPECT_LT((test.fluid().acceleration - Vector3d(k * k * at.x(), k * k * at.y(), 3)).norm(), 1e-9);
}

const std::string withPolydispersity =
    "forceModels (DiFeliceDrag gradPForce viscForce Archimedes); DiFeliceDragProps { polydispersity Beetstra; } ";

/// Three particles in one cell, of 4 cm, 2 cm and 2 cm: <d> = (64 + 8 + 8)/(16 + 4 + 4) = 3.333 cm for each of them,
/// and 2 cm for one that is alone in a cell far away. A mean by number (2.667) or by volume ((80/3)^(1/3) = 2.99), or
/// that of all particles of the run, fails.
TEST(FluidAtParticles, HaveTheSauterMeanDiameterOfTheirSurroundings)
{
    ParticleInFlow test(
        withPolydispersity, 1e-3, {{{0.03, 0, 0}, 0.01}, {{0, -0.03, 0}, 0.01}, {{-3 * cellSize, 0, 0}, 0.01}});
    test.advance([](const vector&) { return vector(0.1, 0, 0); }, [](const vector&) { return vector(0.1, 0, 0); });
    for (const Eigen::Index particle : {0, 1, 2})
    {
        EXPECT_NEAR(test.fluid(particle).sauterMeanDiameter, 0.1 / 3, 1e-15);
    }
    EXPECT_NEAR(test.fluid(3).sauterMeanDiameter, 0.02, 1e-16);
}

/// With smoothing a large particle and a small one that are one cell apart each see more of themselves than of the
/// other, and particles of one size see that size to rounding, wherever they are.
TEST(FluidAtParticles, HaveTheSauterMeanDiameterAsTheVoidFractionIsSmoothed)
{
    const std::string smoothed =
        withPolydispersity + "smoothingModel constDiffSmoothing; constDiffSmoothingProps { bandwidth 0.1; }";
    const Flow flow = [](const vector&) { return vector(0.1, 0, 0); };
    ParticleInFlow mixture(smoothed, 1e-3, {{{cellSize, 0, 0}, 0.01}});
    mixture.advance(flow, flow);
    const double ofBoth = 0.072 / 2; // (4^3 + 2^3)/(4^2 + 2^2) = 3.6 cm
    EXPECT_GT(mixture.fluid(0).sauterMeanDiameter, ofBoth);
    EXPECT_LT(mixture.fluid(0).sauterMeanDiameter, 0.0399);
    EXPECT_LT(mixture.fluid(1).sauterMeanDiameter, ofBoth);
    EXPECT_GT(mixture.fluid(1).sauterMeanDiameter, 0.0201);

    ParticleInFlow equal(smoothed, 1e-3, {{{cellSize, 0.01, 0}, 0.02}, {{-2.4 * cellSize, 0, 0.02}, 0.02}});
    equal.advance(flow, flow);
    for (const Eigen::Index particle : {0, 1, 2})
    {
        EXPECT_NEAR(equal.fluid(particle).sauterMeanDiameter, 0.04, 1e-16);
    }
}

/// Without a force that needs it nothing is computed.
TEST(FluidAtParticles, HaveNoSauterMeanDiameterUnlessAForceNeedsIt)
{
    ParticleInFlow test("");
    test.advance([](const vector&) { return vector::zero; }, [](const vector&) { return vector::zero; });
    EXPECT_EQ(test.fluid().sauterMeanDiameter, 0);
}

/// The particle rests; the fluid goes at 0.1 m/s in most of the box and at 1 m/s along one wall. With maxCo 0.05 and cells of
/// 1/12 m the fast cells allow 0.05/12 s, which is 41 whole DEM steps of 1e-4 s. A limit by the slowest cells, or by the
/// particles alone, leaves the 100 steps of the start. The flow at the end of the last coupling
/// step counts, so that the jet acts from the second coupling step on.
TEST(CourantLimit, OfTheFluidIsThatOfTheFastestCell)
{
    ParticleInFlow test(
        "adjustableCouplingTimeStep yes; maxCo 0.05; minCouplingTimeStep 1e-4; maxCouplingTimeStep 0.01;", 0.01);
    const Flow jet = [](const vector& at) { return vector(0, 0, at.x() < cellSize ? 1 : 0.1); };
    EXPECT_NEAR(test.nextCouplingTimeStep(), 0.01, 1e-12);
    test.advance(jet, jet);
    EXPECT_NEAR(test.nextCouplingTimeStep(), 0.01, 1e-12);
    test.advance(jet, jet);
    EXPECT_NEAR(test.nextCouplingTimeStep(), 41e-4, 1e-12);
}

} // namespace

} // namespace clepsydra::tests
