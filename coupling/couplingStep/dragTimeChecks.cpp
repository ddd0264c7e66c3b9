#include "couplingStep/dragTimeChecks.h"

namespace clepsydra
{

using namespace Foam;

namespace
{

/// Length of a step in the time scale of dv/dt = -v/time, at which an explicit step turns v into -v.
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

void DragTimeChecks::check(const ParticlesView& particles, const DemResult& result)
{
    checkDemStep(particles, result);
    if (!settings_.implicitCoupling() && !warnedOfExplicitCoupling_)
    {
        checkExplicitCoupling(particles, result);
    }
    if (settings_.ddtSmoothingTime() >= couplingStepsOfFilter * result.timeStep && !warnedOfFilter_)
    {
        checkFilter(particles, result);
    }
}

void DragTimeChecks::checkDemStep(const ParticlesView& particles, const DemResult& result) const
{
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const ReceivedImpulse& received = result.received[static_cast<std::size_t>(particle)];
        const double inertia = inertiaTime(particles, particle, result);
        if (demTimeStep_ * received.implicitCoefficientTime > longest * inertia
            && !result.changeOfVelocity.col(particle).isZero(0))
        {
            const double relaxationTime = inertia / received.implicitCoefficientTime;
            FatalErrorInFunction << "Drag brings particle " << particles.id[particle] << " with a diameter of "
                                 << 2 * particles.radius[particle] << " m to the fluid's velocity in " << relaxationTime
                                 << " s, but the DEM step is " << demTimeStep_ << " s; allowed: a timestep in "
                                 << settings_.demDict().get<fileName>("script").c_str() << " of at most "
                                 << longest * relaxationTime << " s, and better a fifth of that" << exit(FatalError);
        }
    }
}

void DragTimeChecks::checkExplicitCoupling(const ParticlesView& particles, const DemResult& result)
{
    double fastestHere = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const FluidAtParticle& fluid = particles.state[particle].fluid;
        const double coefficient =
            result.received[static_cast<std::size_t>(particle)].implicitCoefficientTime / result.timeStep;
        const double solid = 1 - fluid.voidFraction;
        fastestHere = std::max(fastestHere,
            solid * coefficient / (sphereVolume(particles.radius[particle]) * fluidDensity_ * fluid.voidFraction));
    }
    const double fastest = returnReduce(fastestHere, maxOp<double>());
    if (result.timeStep * fastest <= longest)
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
            << "step, and it is " << result.timeStep
            << " s. Use implicitCouple, or a couplingTimeStep (and deltaT) of at most " << longest / fastest
            << " s. This warning is printed once" << endl;
    }
}

void DragTimeChecks::checkFilter(const ParticlesView& particles, const DemResult& result)
{
    double mostHere = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const double drag = result.received[static_cast<std::size_t>(particle)].implicitCoefficientTime;
        if (particles.state[particle].fluid.voidFraction < looseBed && !result.changeOfVelocity.col(particle).isZero(0))
        {
            mostHere = std::max(mostHere, result.timeStep * drag / inertiaTime(particles, particle, result));
        }
    }
    const double most = returnReduce(mostHere, maxOp<double>());
    if (most <= longestWithFilter)
    {
        return;
    }
    warnedOfFilter_ = true;
    if (Pstream::master())
    {
        WarningInFunction
            << "The coupling step of " << result.timeStep << " s is " << most
            << " relaxation times of a particle in a dense bed, and the low-pass filter of d(eps)/dt has a "
            << "smoothingTime of " << settings_.ddtSmoothingTime()
            << " s. Where such a bed falls or rises as a whole, errors then grow from step to step. Leave "
            << "the filter out (useDDTvoidfractionProps), or use a couplingTimeStep (and deltaT) of at most "
            << longestWithFilter * result.timeStep / most << " s. This warning is printed once" << endl;
    }
}

} // namespace clepsydra
