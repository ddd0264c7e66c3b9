/// \file
/// Torque on a rotating sphere, against values worked out by hand from the printed formula.

#include "closures/rotationTorque.h"

#include "relative.h"

namespace
{

using namespace clepsydra::closures;

/// Creeping flow: T = 8 pi mu a^3 w. 1 mm particle in water, .1/s: 8 pi*1e-3*.125e-9 = 3.141593e-12 N m s, also without
/// any rotation. The diameter in place of the radius is eight times that.
TEST(RotationTorque, InCreepingFlow)
{
    EXPECT_RELATIVE(rotationTorqueCoefficient({1e-3, 0.0, 0.1, 1000.0, 1e-3}), 3.141592654e-12, 1e-9);
    EXPECT_RELATIVE(rotationTorqueCoefficient({1e-3, 0.0, 0.0, 1000.0, 1e-3}), 3.141592654e-12, 1e-9);
}

/// 2 mm particle in water at 50/s, a = 1 mm: Re_a = 1000*50*1e-6/1e-3 = 50; C_M = 6.45/7.071068 + 32.1/50 = .9121677 +
/// .642 = 1.5541677; T = .5*1000*1e-15*2500*1.5541677 = 1.942710e-9 N m, /50 = 3.885419e-11. With Re_r = 200 put into
/// the formula of the radius it would be 1.54 times that. At 1000/s, Re_a = 1000: C_M = .2039669 + .0321 = .2360669;
/// T/w = .5*1000*1e-15*1000*.2360669 = 1.180335e-10.
TEST(RotationTorque, AtFiniteReynoldsNumber)
{
    EXPECT_RELATIVE(rotationTorqueCoefficient({2e-3, 0.0, 50.0, 1000.0, 1e-3}), 3.885419e-11, 1e-6);
    EXPECT_RELATIVE(rotationTorqueCoefficient({2e-3, 0.0, 1000.0, 1000.0, 1e-3}), 1.180335e-10, 1e-6);
}

/// The two parts cross at sqrt(Re_a) = (16 pi - 32.1)/6.45 = 2.816355, Re_a = 7.931856, Re_r = 31.72742; the handbooks
/// print 32 for it. The torque is continuous there and starts to grow above it.
TEST(RotationTorque, JoinsItsTwoParts)
{
    // 1 m, 1 kg/m3 and 1 Pa s make |w| the Reynolds number
    const auto inUnitsOfCreepingFlow = [](double reynolds) {
        return rotationTorqueCoefficient({1.0, 0.0, reynolds, 1.0, 1.0}) / pi;
    };
    EXPECT_DOUBLE_EQ(inUnitsOfCreepingFlow(31.72), 1.0);
    EXPECT_NEAR(inUnitsOfCreepingFlow(31.73), 1.0, 1e-4);
    EXPECT_GT(inUnitsOfCreepingFlow(31.73), 1.0);
    // 12.9/sqrt(32) + 128.4/32 = 2.280419 + 4.0125 = 6.292919 for 64 pi/32 = 6.283185
    EXPECT_RELATIVE(inUnitsOfCreepingFlow(32.0), 6.292919 / 6.283185, 1e-6);
}

} // namespace
