#include "couplingStep/turbulentDispersion.h"

#include "closures/discreteRandomWalk.h"
#include "couplingStep/checkpointedState.h"
#include "couplingState.h"
#include "forces/relaxationTime.h"
#include "runTimeSelection.h"

#include <algorithm>
#include <cmath>

namespace clepsydra
{

namespace
{

const word entryName("turbulentDispersion");
const word propsName("turbulentDispersionProps");

const ModelLines turbulentDispersions(
    "turbulentDispersion", {{"off", "particles see the mean velocity of the fluid (the default)"},
                               {"discreteRandomWalk", "random velocities of eddies (Gosman & Ioannides 1983)"}});

/// What is stored of a particle's walk.
namespace walk
{

constexpr Rows<1> timeLeft{0};                  // in the eddy at the end of the coupling step [s]
constexpr Rows<3> eddyVelocity{timeLeft.end()}; // of that eddy [m/s]
constexpr Rows<1> count{eddyVelocity.end()};    // of eddies so far
constexpr Rows<3> meanVelocity{count.end()};    // over the coupling step [m/s]
constexpr Rows<1> isDone{meanVelocity.end()};   // 1 where these are the values of the next coupling step
constexpr int size = isDone.end();

/// Writable.
Eigen::Map<Eigen::Matrix<double, size, 1>> of(const ParticlesView& particles, Eigen::Index particle)
{
    return Eigen::Map<Eigen::Matrix<double, size, 1>>(
        particles.memory + (particle + 1) * particles.memorySize - checkpointedState::size - size);
}

} // namespace walk

/// Eddies of which more would pass in a coupling step are so small that they move no particle: their diffusion coefficient
/// is proportional to k times their duration.
constexpr int mostEddiesInStep = 1000;

} // namespace

int TurbulentDispersion::memory(const dictionary& couplingProperties)
{
    const bool isSelected = couplingProperties.found(entryName)
                            && selectedModel(couplingProperties, entryName, turbulentDispersions.names()) != "off";
    return isSelected ? walk::size : 0;
}

TurbulentDispersion::TurbulentDispersion(const CouplingSettings& settings, const FluidProperties& fluid)
    : fluid_(fluid),
      coarseGraining_(settings.coarseGraining()),
      active_(memory(settings.dict()) > 0)
{
    const dictionary& dict = settings.dict();
    const dictionary props = dict.subOrEmptyDict(propsName);
    requireKnownEntries(props, {"seed"});
    if (!active_)
    {
        return;
    }
    if (fluid.turbulence.compare(0, 4, "RAS ") != 0 || fluid.turbulence == "RAS SpalartAllmaras")
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entryName << "' is discreteRandomWalk, but the flow is "
                                     << (fluid.turbulence.empty() ? "laminar" : fluid.turbulence.c_str())
                                     << "; allowed: with simulationType RAS in constant/turbulenceProperties, and a "
                                     << "model other than SpalartAllmaras, because the walk needs the energy and the "
                                     << "size of all eddies" << exit(FatalIOError);
    }
    if (dict.getOrDefault<word>("selfInducedVelocityCorrection", "off") != "off")
    {
        FatalIOErrorInFunction(dict) << "Entry '" << entryName << "' is discreteRandomWalk; allowed: with "
                                     << "selfInducedVelocityCorrection off, because that correction replaces the fluid "
                                     << "velocity at a particle in every DEM step" << exit(FatalIOError);
    }
    seed_ = static_cast<std::uint64_t>(props.getOrDefault<label>("seed", 1));
}

void TurbulentDispersion::endStep(const ParticlesView& particles) const
{
    for (Eigen::Index particle = 0; active_ && particle < particles.size(); ++particle)
    {
        walk::isDone.of(walk::of(particles, particle)).setZero();
    }
}

Vector3d TurbulentDispersion::velocity(
    const ParticlesView& particles, Eigen::Index particle, double k, double dissipation, double timeStep) const
{
    auto stored = walk::of(particles, particle);
    auto meanVelocity = walk::meanVelocity.of(stored);
    if (walk::isDone.of(stored)[0] != 0)
    {
        return meanVelocity;
    }
    double& timeLeft = stored[walk::timeLeft.first];
    double& count = stored[walk::count.first];
    auto eddyVelocity = walk::eddyVelocity.of(stored);
    stored[walk::isDone.first] = 1;
    meanVelocity.setZero();
    if (!(k > 0 && dissipation > 0))
    {
        timeLeft = 0;
        return Vector3d::Zero();
    }
    const double slip = (particles.state[particle].fluid.velocityInCells - particles.velocity.col(particle)).norm();
    const double size = closures::eddySize(k, dissipation);
    const double relaxation = isolatedRelaxationTime(particles, particle, slip, fluid_, coarseGraining_);
    double time = timeStep;
    for (int entered = 0; time > 0 && entered < mostEddiesInStep; ++entered)
    {
        if (!(timeLeft > 0))
        {
            count += 1;
            const auto numbers = closures::normalNumbers(seed_, static_cast<std::uint64_t>(particles.id[particle]),
                static_cast<std::uint64_t>(std::llround(count)));
            eddyVelocity = std::sqrt(2.0 / 3.0 * k) * Eigen::Map<const Vector3d>(numbers.data());
            timeLeft = closures::timeInEddy(size, eddyVelocity.norm(), relaxation, slip);
        }
        const double inEddy = std::min(time, timeLeft);
        meanVelocity += inEddy / timeStep * eddyVelocity;
        timeLeft -= inEddy;
        time -= inEddy;
    }
    return meanVelocity;
}

} // namespace clepsydra
