/// \file
/// Added mass of a sphere, alone and among others.

#include "closures/addedMass.h"

#include "relative.h"

namespace
{

using namespace clepsydra::closures;

/// Half of the displaced fluid: 2 mm particle in water, .5*1000*4.188790e-9 = 2.094395e-6 kg. The whole of it is twice that.
TEST(AddedMass, OfAnIsolatedParticleIsHalfTheDisplacedFluid)
{
    EXPECT_RELATIVE(addedMass(isolatedAddedMassCoefficient, 1000.0, 4.188790e-9), 2.094395e-6, 1e-9);
    EXPECT_DOUBLE_EQ(zuberAddedMassCoefficient(1.0), isolatedAddedMassCoefficient);
}

/// Zuber at phi .1, .3, .6: 1.2/1.8 = .666667; 1.6/1.4 = 1.142857; 2.2/.8 = 2.75. phi for eps fails at all of them.
TEST(AddedMass, GrowsWithTheSolidFraction)
{
    EXPECT_RELATIVE(zuberAddedMassCoefficient(0.9), 0.6666666667, 1e-9);
    EXPECT_RELATIVE(zuberAddedMassCoefficient(0.7), 1.1428571429, 1e-9);
    EXPECT_RELATIVE(zuberAddedMassCoefficient(0.4), 2.75, 1e-9);
}

/// Glass (2540) in water: (1 - .3937008) 9.81/(1 + .1968504) = 5.947795/1.1968504 = 4.969539; without added mass 5.95.
/// Density ratio 1.05: .0476190*9.81/(1 + .4761905) = .3164516; a bubble without mass: -2 g.
TEST(AddedMass, SlowsTheStartFromRest)
{
    EXPECT_RELATIVE(accelerationFromRest(9.81, 1000.0, 2540.0, 0.5), 4.969539, 1e-6);
    EXPECT_RELATIVE(accelerationFromRest(9.81, 1000.0, 1050.0, 0.5), 0.3164516, 1e-6);
    EXPECT_RELATIVE(accelerationFromRest(9.81, 1000.0, 1e-6, 0.5), -19.62, 1e-6);
}

} // namespace
