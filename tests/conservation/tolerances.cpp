// What the conservation check calls an error: relative to what is exchanged in one coupling step and in one cell, so that a
// long run or a large one hides nothing; not below the rounding of what cancels; and whatever is not a number.

#include "conservation/faults.h"

#include "conservation/conservationCheck.h"

#include <limits>

namespace clepsydra::tests
{

namespace
{

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

class Tolerances : public testing::Test
{
protected:
    Tolerances()
        : case_("deltaT 0.01;"),
          conservation_(dictionary::null, case_.time())
    {}

    /// One coupling step in which the particles receive an impulse and the fluid loses another [N s].
    void exchange(double received, double lost, double semiImplicit = 0, double magnitudes = 0)
    {
        conservation_.recordMomentum(
            {vector(received, 0, 0), std::abs(received)}, vector(lost, 0, 0), {vector(semiImplicit, 0, 0), magnitudes});
    }

    TemporaryCase case_;
    ConservationCheck conservation_;
};

} // namespace

// After a thousand steps in which much is exchanged, one step loses a millionth of its own impulse, 1e-9 of all that was
// exchanged so far. A check relative to the sum since the start finds nothing.
TEST_F(Tolerances, MomentumIsThatOfOneCouplingStep)
{
    for (int step = 0; step < 1000; ++step)
    {
        EXPECT_NO_THROW(exchange(1, 1));
    }
    expectFound([&] { exchange(1, 1 - 1e-6); }, "momentumTolerance");
}

// Particles that move with the fluid receive nothing, 1e-26 N s of rounding, whereas drag times velocity is 1e-10 N s on
// either side. Relative to what was received the error is 0.5, and a right run ends.
TEST_F(Tolerances, MomentumIsNotBelowTheRoundingOfWhatCancels)
{
    conservation_.setInitialMomentum({vector::zero, 1e-10});
    EXPECT_NO_THROW(exchange(1e-26, 0.5e-26, 0, 1e-10));
    // What is lost beyond rounding is still found.
    expectFound([&] { exchange(1e-26, 1e-18, 0, 1e-10); }, "momentumTolerance");
}

// In a tank with ten million particles one cell has cut off five per cent of what is in it: that is an error there, and a
// millionth of a thousandth of all volume.
TEST_F(Tolerances, ClippingIsThatOfOneCell)
{
    EXPECT_NO_THROW(conservation_.recordSolidVolume(0, 0, ClippedVolume()));
    conservation_.setInitialSolidVolume(0.04);
    ClippedVolume clipped{1e-11, 0.5e-3, "cell 7"};
    EXPECT_NO_THROW(conservation_.recordSolidVolume(0.04, 0.04, clipped));
    clipped.largestPart = 0.05;
    const std::string error = errorOf([&] { conservation_.recordSolidVolume(0.04, 0.04, clipped); });
    EXPECT_THAT(error, testing::AllOf(testing::HasSubstr("clippedVolumeTolerance"), testing::HasSubstr("cell 7")));
}

// A low-pass filter so slow that the fluid hardly learns of the particles' motion leaves the filtered continuity equation
// solved to its tolerance.
TEST_F(Tolerances, TheFilterHoldsBackNotMoreThanTheVolume)
{
    conservation_.setInitialSolidVolume(1e-6);
    conservation_.recordSolidVolume(1e-6, 1e-6, ClippedVolume());
    EXPECT_NO_THROW(conservation_.recordFilteredVolume(0.9e-6));
    expectFound([&] { conservation_.recordFilteredVolume(1.1e-6); }, "filteredVolumeTolerance");
}

// Each quantity, where it is not a number: an error that names the tolerance. A comparison "error > tolerance" is false.
TEST_F(Tolerances, WhatIsNotANumberIsFound)
{
    expectFound([&] { conservation_.recordSolidVolume(1, notANumber, ClippedVolume()); }, "solidVolumeTolerance");
    expectFound([&] { conservation_.recordSolidVolume(notANumber, 1, ClippedVolume()); }, "solidVolumeTolerance");
    expectFound([&] { exchange(notANumber, 1); }, "momentumTolerance");
    expectFound([&] { exchange(1, notANumber); }, "momentumTolerance");
    expectFound([&] { conservation_.recordImbalance(notANumber); }, "imbalanceTolerance");
}

} // namespace clepsydra::tests
