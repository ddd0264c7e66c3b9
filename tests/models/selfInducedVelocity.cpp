/// \file
/// The self-induced velocity that is taken off the sampled one, of a particle alone and in a bed.

#include "couplingStep/selfInducedVelocityCorrection.h"
#include "support/boxMesh.h"
#include "support/temporaryCase.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clepsydra::tests
{

namespace
{

constexpr double smoothingBandwidth = 0.05;
constexpr double radius = 0.01;
constexpr double viscosity = 0.3;
constexpr double pi = 3.14159265358979323846;

class SelfMobility : public testing::Test
{
protected:
    SelfMobility()
    {
        case_.writeDictionary("constant/couplingProperties",
            "fluid incompressible; modelType A; couplingTimeStep 0.01; voidFractionModel divided; "
            "smoothingModel constDiffSmoothing; constDiffSmoothingProps { bandwidth "
                + std::to_string(smoothingBandwidth)
                + "; } selfInducedVelocityCorrection Oseen; forceModels (StokesDrag gradPForce viscForce Archimedes); "
                  "momCoupleModels (implicitCouple); DEM { engine liggghts; script none; }");
        mesh_ = boxMesh(case_.time(), Foam::point::zero, Foam::point::one, {8, 8, 8});
        readFromCase<Foam::fvSchemes>(*mesh_);
        settings_ = std::make_unique<CouplingSettings>(case_.time());
        smoothing_ = SmoothingModel::New(settings_->dict(), *mesh_);
        correction_ = std::make_unique<SelfInducedVelocityCorrection>(
            *settings_, FluidProperties{1000, viscosity, Vector3d::Zero()}, *smoothing_);
    }

    /// Of a particle at rest in a fluid at rest.
    double selfMobility(double voidFraction, double resistance) const
    {
        CouplingState state;
        state.fluid.voidFraction = voidFraction;
        // Cells so small that the lattice of cells is not felt.
        return correction_->selfMobility(
            state, Vector3d::Zero(), radius, Vector3d::Zero(), resistance, smoothingBandwidth / 50);
    }

    TemporaryCase case_;
    std::unique_ptr<Foam::fvMesh> mesh_;
    std::unique_ptr<CouplingSettings> settings_;
    Foam::autoPtr<SmoothingModel> smoothing_;
    std::unique_ptr<SelfInducedVelocityCorrection> correction_;
};

/// b2 of the Gaussian that spreads the force and samples the velocity: that of the smoothing, and of the particle's sphere
/// twice, whose variance along each axis is d2/20.
double bandwidthSqr()
{
    return smoothingBandwidth * smoothingBandwidth + 4 * radius * radius / 5;
}

/// Velocity per force at the middle of a Gaussian force in a porous medium (Brinkman) at rest. The integral of
/// k2 exp(-k2 b2/4)/(k2 + q2) over k, q2 = resistance/viscosity, is sqrt(pi)/b - pi q/2 exp(q2 b2/4) erfc(q b/2).
double brinkman(double resistance)
{
    const double b = std::sqrt(bandwidthSqr());
    const double q = std::sqrt(resistance / viscosity);
    const double integral = std::sqrt(pi) / b - 0.5 * pi * q * std::exp(0.25 * q * q * b * b) * std::erfc(0.5 * q * b);
    return integral / (3 * pi * pi * viscosity);
}

/// Alone in the fluid, whose only solid is its own: F/(3 pi^1.5 mu b).
TEST_F(SelfMobility, OfAParticleAloneIsStokes)
{
    const double ownSolid = 4.0 / 3 * pi * std::pow(radius, 3) / std::pow(pi * bandwidthSqr(), 1.5);
    const double expected = 1 / (3 * std::pow(pi, 1.5) * viscosity * std::sqrt(bandwidthSqr()));
    EXPECT_NEAR(selfMobility(1 - ownSolid, 0) / expected, 1, 1e-3);
    EXPECT_NEAR(selfMobility(1, 0) / expected, 1, 1e-3) << "a sampled void fraction may miss the particle itself";
    EXPECT_NEAR(brinkman(0) / expected, 1, 1e-12) << "this is what the bed's formula begins with";
}

/// In a bed the particle is a small part of the solid around it, and that part alone of its self-induced velocity is taken
/// off; and its neighbours hold back the fluid (Brinkman), here to a quarter. Without the neighbours' resistance the correction
/// is four times as large.
TEST_F(SelfMobility, InABedIsScreenedByTheNeighbours)
{
    const double ownSolid = 4.0 / 3 * pi * std::pow(radius, 3) / std::pow(pi * bandwidthSqr(), 1.5);
    const double isolated = ownSolid / 0.5;
    ASSERT_LT(isolated, 0.1);
    const double resistance = 20 * viscosity / bandwidthSqr();
    const double ofNeighbours = (1 - isolated) * resistance;
    EXPECT_LT(brinkman(ofNeighbours), 0.3 * brinkman(0));
    EXPECT_NEAR(selfMobility(0.5, resistance) / (isolated * brinkman(ofNeighbours)), 1, 2e-3);
}

} // namespace

} // namespace clepsydra::tests
