#include "couplingStep/dragTimeChecks.h"

#include <algorithm>

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Length of an explicit step in the time in which the drag of the particles stops the fluid, from which on errors grow.
constexpr double longest = 2;

/// By tests/conservation/pressureFeedback.cpp errors grow from 2.2 relaxation times on, at solid fractions above 0.5 and
/// with a filter over 10 coupling steps or more.
constexpr double longestWithFilter = 2.2;
constexpr double couplingStepsOfFilter = 10;
constexpr double looseBed = 0.5;

/// Mass, with the added mass, times the length of the DEM steps [kg s].
double inertiaTime(const ParticlesView& particles, Eigen::Index particle, const DemResult& result)
{
    return particles.mass[particle] * result.timeStep
           + result.received[static_cast<std::size_t>(particle)].addedMassTime;
}

} // namespace

void DragTimeChecks::addTo(const ParticlesView& particles, const DemResult& result, RankTotals& totals)
{
    const bool checksExplicitCoupling = !settings_.implicitCoupling() && !warnedOfExplicitCoupling_;
    const bool checksFilter =
        settings_.ddtSmoothingTime() >= couplingStepsOfFilter * result.timeStep && !warnedOfFilter_;
    const bool checksAddedMass = !settings_.implicitCoupling() && !warnedOfAddedMass_;
    double fastestHere = 0;
    double mostHere = 0;
    double largestHere = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const double drag = result.received[static_cast<std::size_t>(particle)].implicitCoefficientTime;
        const FluidAtParticle& fluid = particles.state[particle].fluid;
        const auto moves = [&] { return !result.changeOfVelocity.col(particle).isZero(0); };
        const auto perMassOfFluid = [&](double value) {
            return (1 - fluid.voidFraction) * value
                   / (sphereVolume(particles.radius[particle]) * fluidDensity_ * fluid.voidFraction);
        };
        if (checksExplicitCoupling)
        {
            fastestHere = std::max(fastestHere, perMassOfFluid(drag / result.timeStep));
        }
        if (checksAddedMass)
        {
            const double addedMass =
                result.received[static_cast<std::size_t>(particle)].addedMassTime / result.timeStep;
            const double mass = particles.mass[particle];
            const double reacting = moves() ? addedMass * mass / (mass + addedMass) : addedMass;
            largestHere = std::max(largestHere, perMassOfFluid(reacting));
        }
        if (checksFilter && fluid.voidFraction < looseBed && moves())
        {
            mostHere = std::max(mostHere, result.timeStep * drag / inertiaTime(particles, particle, result));
        }
    }
    totals.add(
        {{}, {fastestHere, mostHere, largestHere}}, [this, couplingTimeStep = result.timeStep](const RankNumbers& all) {
            checkExplicitCoupling(all.maxima[0], couplingTimeStep);
            checkFilter(all.maxima[1], couplingTimeStep);
            checkAddedMass(all.maxima[2]);
        });
}

void DragTimeChecks::checkExplicitCoupling(double fastest, double couplingTimeStep)
{
    if (couplingTimeStep * fastest <= longest)
    {
        return;
    }
    warnedOfExplicitCoupling_ = true;
    if (Pstream::master())
    {
        WarningInFunction
            << "With momCoupleModels (explicitCouple) the fluid receives drag after the coupling step, and "
            << "the drag of the particles stops it in " << 1 / fastest
            << " s. Where the coupling step is longer than twice that time, errors grow from step to "
            << "step, and it is " << couplingTimeStep
            << " s. Use implicitCouple, or a couplingTimeStep (and deltaT) of at most " << longest / fastest
            << " s. This warning is printed once" << endl;
    }
}

void DragTimeChecks::checkFilter(double most, double couplingTimeStep)
{
    if (most <= longestWithFilter)
    {
        return;
    }
    warnedOfFilter_ = true;
    if (Pstream::master())
    {
        WarningInFunction
            << "The coupling step of " << couplingTimeStep << " s is " << most
            << " relaxation times of a particle in a dense bed, and the low-pass filter of d(eps)/dt has a "
            << "smoothingTime of " << settings_.ddtSmoothingTime()
            << " s. Where such a bed falls or rises as a whole, errors then grow from step to step. Leave "
            << "the filter out (useDDTvoidfractionProps), or use a couplingTimeStep (and deltaT) of at most "
            << longestWithFilter * couplingTimeStep / most << " s. This warning is printed once" << endl;
    }
}

void DragTimeChecks::checkAddedMass(double largest)
{
    if (largest <= 1)
    {
        return;
    }
    warnedOfAddedMass_ = true;
    if (Pstream::master())
    {
        WarningInFunction
            << "With momCoupleModels (explicitCouple) the fluid receives the reaction to the particles' added mass "
            << "after the coupling step. Where the added mass is more than the mass of the fluid between the "
               "particles, here "
            << largest
            << " times as much, errors grow from step to step, whatever the coupling step. Use implicitCouple. "
            << "This warning is printed once" << endl;
    }
}

} // namespace clepsydra
