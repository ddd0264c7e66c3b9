/// \file
/// Forces on parcels, `coarseGraining` other than 1: those on one real particle, times their number.

// Before OpenFOAM, whose macro Log means something else.
#include <gmock/gmock.h>

#include "forcesOnParticles.h"

#include "support/errorOf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace clepsydra::tests
{

namespace
{

using testing::AllOf;
using testing::HasSubstr;

constexpr double radius = 0.5e-3;
constexpr double density = 2500;

/// A sphere of the DEM in a fluid that moves, with all that the forces read.
class SphereInFluid
{
public:
    SphereInFluid(const std::string& couplingProperties, double sphereRadius)
        : test_(couplingProperties)
    {
        test_.engine().addParticle(1, Vector3d::Zero(), sphereRadius, density, {0.02, -0.01, -0.1});
        FluidAtParticle& fluid = test_.fluidAt(0);
        fluid.voidFraction = 0.6;
        fluid.logVoidFraction = std::log(0.6);
        fluid.velocity = {0.1, 0, 0.05};
        fluid.velocityInCells = fluid.velocity;
        fluid.pressureGradient = {100, -200, -3000};
        fluid.viscousStressDivergence = {7, 11, -13};
        fluid.acceleration = {1, -2, 3};
        fluid.sauterMeanDiameter = 0.8e-3;
    }

    Vector3d acceleration()
    {
        return test_.accelerationOf(0);
    }

    ReceivedImpulse received()
    {
        return test_.received(0);
    }

    Vector3d pressureImpulse()
    {
        return test_.takePressureImpulse();
    }

private:
    ForcesOnParticles test_;
};

const std::string modelA = "forceModels (GidaspowDrag gradPForce viscForce Archimedes virtualMassForce); ";
const std::string modelB = "modelType B; forceModels (BeetstraDrag Archimedes); ";
const std::string mixture = "forceModels (BeetstraDrag gradPForce viscForce Archimedes); "
                            "BeetstraDragProps { polydispersity Beetstra; factor 1.3; } ";

std::string withRatio(double ratio)
{
    return "coarseGraining " + std::to_string(ratio) + ';';
}

/// A parcel accelerates as one real particle does, and the fluid receives what its a^3 particles receive, also with a
/// ratio that is no whole number, in models A and B and in mixtures of sizes. With the parcel's own diameter in the drag law
/// it accelerates otherwise by more than a tenth; with a drag that is not multiplied the impulse is that of one particle.
TEST(Parcels, AccelerateAsTheirParticles)
{
    for (const std::string& forces : {modelA, modelB, mixture})
    {
        SphereInFluid real(forces, radius);
        const Vector3d expected = real.acceleration();
        for (const double ratio : {1.5, 2.0, 4.0})
        {
            const double number = ratio * ratio * ratio;
            SphereInFluid parcel(forces + withRatio(ratio), ratio * radius);
            EXPECT_LT((parcel.acceleration() - expected).norm(), 1e-12 * expected.norm()) << forces << ratio;
            const ReceivedImpulse ofReal = real.received();
            const ReceivedImpulse ofParcel = parcel.received();
            EXPECT_LT((ofParcel.impulse - number * ofReal.impulse).norm(), 1e-12 * ofParcel.impulse.norm());
            EXPECT_NEAR(ofParcel.implicitCoefficientTime / (number * ofReal.implicitCoefficientTime), 1, 1e-12);
            EXPECT_NEAR(ofParcel.addedMassTime, number * ofReal.addedMassTime, 1e-12 * ofParcel.addedMassTime);

            SphereInFluid large(forces, ratio * radius);
            EXPECT_GT((large.acceleration() - expected).norm(), 0.1 * expected.norm()) << forces << ratio;
        }
    }
}

/// The impulse of the pressure gradient, which the conservation check compares, is that on the parcel's whole volume.
TEST(Parcels, HaveThePressureForceOfTheirVolume)
{
    SphereInFluid parcel(modelA + withRatio(2), 2 * radius);
    parcel.acceleration();
    const Vector3d expected = -1e-5 * sphereVolume(2 * radius) * Vector3d(100, -200, -3000);
    EXPECT_LT((parcel.pressureImpulse() - expected).norm(), 1e-12 * expected.norm());
}

/// To the last bit.
TEST(Parcels, OfOneParticleChangeNothing)
{
    SphereInFluid plain(modelA, radius);
    SphereInFluid one(modelA + "coarseGraining 1;", radius);
    EXPECT_EQ(plain.acceleration(), one.acceleration());
    EXPECT_EQ(plain.received().impulse, one.received().impulse);
}

/// Of all models in the program, those that say so themselves may act on parcels, and all others are refused by name: also
/// one that is added later and says nothing.
TEST(Parcels, AreRefusedByModelsWithoutAScaling)
{
    const std::set<ForceFamily> scaled = {ForceFamily::drag, ForceFamily::pressureGradient, ForceFamily::viscousStress,
        ForceFamily::buoyancy, ForceFamily::addedMass};
    for (int number = 0; number <= static_cast<int>(ForceFamily::other); ++number)
    {
        const auto family = static_cast<ForceFamily>(number);
        for (const Foam::word& name : ForceLines::namesOf(family))
        {
            const std::string entries = "forceModels (" + name + "); lubricationForceProps { roughness 1e-6; } ";
            EXPECT_NO_THROW(ForcesOnParticles{entries}) << name;
            const std::string error = errorOf([&] { const ForcesOnParticles forces(entries + withRatio(2)); });
            if (scaled.count(family) > 0)
            {
                EXPECT_EQ(error, "") << name;
            }
            else
            {
                EXPECT_THAT(error, AllOf(HasSubstr("'coarseGraining' is 2"), HasSubstr('\'' + name + '\''),
                                       HasSubstr("allowed: without it, or coarseGraining 1")));
            }
        }
    }
}

/// The particles of a parcel are not all at the parcel's distance from a wall.
TEST(Parcels, AreRefusedBesideAWallCorrectionOfTheDrag)
{
    for (const std::string law : {"law Faxen; walls ( ((0 0 0) (0 0 1)) );", "law DiFelice1996; tubeDiameter 0.1;"})
    {
        const std::string entries = "forceModels (StokesDrag); StokesDragProps { wallCorrection { " + law + " } } ";
        EXPECT_NO_THROW(ForcesOnParticles{entries});
        EXPECT_THAT(errorOf([&] { const ForcesOnParticles forces(entries + withRatio(2)); }),
            AllOf(HasSubstr("'StokesDrag'"), HasSubstr("walls after")));
    }
}

TEST(Parcels, HaveARatioOfAtLeastOne)
{
    for (const std::string ratio : {"0.5", "0", "-2", "1e4"})
    {
        EXPECT_THAT(errorOf([&] { const ForcesOnParticles forces(modelA + "coarseGraining " + ratio + ';'); }),
            AllOf(HasSubstr("'coarseGraining'"), HasSubstr("allowed: a number from 1 to 1000")))
            << ratio;
    }
}

/// The log says of what the equation is; without parcels it says what it said before.
TEST(Parcels, AreInThePrintedEquations)
{
    EXPECT_THAT(printed("modelType A; " + modelA + "coarseGraining 2;"),
        AllOf(HasSubstr("stands for 8 particles with its diameter divided by 2"),
            HasSubstr("\nparcel              m dv/dt")));
    EXPECT_THAT(printed("modelType A; " + modelA),
        AllOf(testing::Not(HasSubstr("parcel")), HasSubstr("\nparticle            m dv/dt")));
}

} // namespace

} // namespace clepsydra::tests
