/// \file
/// The history force's kernels as sums of exponentials, against the exact integrals.

#include "closures/historyForce.h"

#include "relative.h"

#include <complex>

namespace
{

using namespace clepsydra::closures;

/// The modes after steps of unit acceleration, as the force model moves them.
class Ramp
{
public:
    explicit Ramp(double timeStep)
        : timeStep_(timeStep),
          step_(timeStep)
    {}

    /// Mean over the next step of int tau^-1/2 dv, with the step's own part.
    double meanOverNextStep() const
    {
        double sum = step_.ownPart;
        for (int mode = 0; mode < historyModes; ++mode)
        {
            const auto i = static_cast<std::size_t>(mode);
            sum += historyWeight(mode) * step_.mean[i] * modes_[i];
        }
        return sum;
    }

    void advance()
    {
        for (std::size_t i = 0; i < modes_.size(); ++i)
        {
            modes_[i] = step_.fades[i] * modes_[i] + step_.mean[i] * timeStep_;
        }
    }

private:
    double timeStep_;
    HistoryStep step_;
    std::array<double, historyModes> modes_{};
};

/// 3/2 d2 sqrt(pi rho mu): 2 mm in water, 6e-6*sqrt(pi) = 1.0634723e-5 kg s^-1/2.
TEST(HistoryForce, HasBassetsCoefficient)
{
    EXPECT_RELATIVE(historyCoefficient(2e-3, 1000.0, 1e-3), 1.0634723e-5, 1e-7);
}

/// Constant acceleration from rest: int_0^t (t - s)^-1/2 ds = 2 t^1/2, its mean over a step 4/3 [(t + h)^3/2 - t^3/2]/h,
/// exact in the first step. Without the modes it would stay at the first step's value; with too few of them, or without
/// the weight of those slower than the slowest, it leaves the root.
TEST(HistoryForce, FollowsARamp)
{
    for (const double timeStep : {2e-7, 2e-5, 1e-3})
    {
        Ramp ramp(timeStep);
        for (int n = 0; n < 20000; ++n)
        {
            const double t = n * timeStep;
            const double exact = 4.0 / 3.0 * (std::pow(t + timeStep, 1.5) - std::pow(t, 1.5)) / timeStep;
            ASSERT_NEAR(ramp.meanOverNextStep() / exact, 1.0, 1e-3) << "step " << n << " of " << timeStep << " s";
            ramp.advance();
        }
    }
}

/// Oscillation e^(i w t): int_0^inf tau^-1/2 e^(-i w tau) d tau = sqrt(pi/w) e^(-i pi/4), the sum of weight/(rate + i w);
/// amplitude and phase over four decades. (What is faster than the fastest mode is in the own part of a step.)
TEST(HistoryForce, FollowsAnOscillation)
{
    for (double frequency = 0.1; frequency < 1e3; frequency *= 3)
    {
        std::complex<double> sum;
        for (int mode = 0; mode < historyModes; ++mode)
        {
            sum += historyWeight(mode) / std::complex<double>(std::exp(historyLogRate(mode)), frequency);
        }
        const std::complex<double> exact = std::sqrt(pi / frequency) * std::polar(1.0, -pi / 4);
        EXPECT_LT(std::abs(sum - exact) / std::abs(exact), 1e-3) << frequency << " rad/s";
    }
}

/// Mei & Adrian's kernel, tau^-1/2 (1 + (tau/tau_M)^3/4)^-2, over eight decades of lag around tau_M: with Basset's shares
/// alone it would be 4 times too large at tau_M, and 1000 times at 100 tau_M.
TEST(HistoryForce, FadesAsMeiAndAdriansKernel)
{
    const MeiAdrianShare share;
    const double logTime = std::log(1e-2);
    for (double lag = 1e-7; lag < 1.0; lag *= 2)
    {
        double sum = 0;
        for (int mode = 0; mode < historyModes; ++mode)
        {
            sum += historyWeight(mode) * share(historyLogRate(mode) + logTime)
                   * std::exp(-std::exp(historyLogRate(mode)) * lag);
        }
        const double exact = 1.0 / std::sqrt(lag) / std::pow(1.0 + std::pow(lag / 1e-2, 0.75), 2);
        EXPECT_RELATIVE(sum, exact, lag < 0.01 ? 2e-3 : 2e-2) << lag << " s";
    }
}

/// tau_M by hand: d 1.5 mm, V .2 m/s, nu 1e-6: R .75 mm, Re 300, f = 32.25; (pi nu/R2)^1/4 = (5.585054)^1/4 = 1.537294;
/// pi/2 V3/(R nu f3) = .01256637/(7.5e-10*33542.3) = 499.528, root 22.3501; ratio .0687824, ^4/3: .0281818 s.
TEST(HistoryForce, HasMeiAndAdriansTime)
{
    EXPECT_RELATIVE(std::exp(meiAdrianLogTime(1.5e-3, 0.2, 1e-6)), 0.0281818, 1e-4);
    EXPECT_GT(meiAdrianLogTime(1.5e-3, 0, 1e-6), 20);
}

} // namespace
