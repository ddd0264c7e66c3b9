#include "closures/historyForce.h"
#include "forces/forceModel.h"

#include "addToRunTimeSelectionTable.H"

#include <memory>

namespace clepsydra
{

namespace
{

using closures::historyModes;

const ModelLines laws(
    "historyForceProps { law }", {{"Basset", "creeping flow"}, {"MeiAdrian", "finite Re (the default)"}});

/// State that is stored for each particle; all values are zero before its first step.
struct MotionHistory
{
    /// 1 after the first step.
    double begun;
    /// Velocity of the particle relative to the fluid at the last step [m/s].
    Vector3d velocity;
    /// Changes of that velocity, each decayed with the rate of its mode [m/s].
    Eigen::Matrix<double, 3, historyModes, Eigen::DontAlign> modes;
};
static_assert(std::is_standard_layout_v<MotionHistory>, "an engine stores it as plain doubles beside the particle");

/// History force -C int K(t - s) d(v - U)/ds ds: see closures/historyForce.h. A particle's history begins at its first
/// step in the fluid (one that has just been inserted, or is outside the mesh, is in none); the relative velocity is
/// taken as constant before. The contribution of the last DEM step is implicit in the particle's inertia.
///
///     historyForceProps { law Basset; }         // creeping flow
///     historyForceProps { law MeiAdrian; }      // finite Re; the default
class HistoryForce : public ForceOf<ForceFamily::history>
{
public:
    TypeName("historyForce");

    HistoryForce(const Foam::dictionary& coefficients, const FluidProperties& fluid)
        : fluid_(fluid)
    {
        requireKnownEntries(coefficients, {"law"});
        if (!coefficients.found("law") || selectedModel(coefficients, "law", laws.names()) == "MeiAdrian")
        {
            share_ = std::make_unique<closures::MeiAdrianShare>();
        }
        for (int mode = 0; mode < historyModes; ++mode)
        {
            weight_[mode] = closures::historyWeight(mode);
        }
    }

    void add(const ParticlesView& particles, ForceSum& sum) const override
    {
        const closures::HistoryStep step(sum.timeStep);
        const Eigen::Map<const Modes> fades(step.fades.data());
        const Eigen::Map<const Modes> mean(step.mean.data());
        for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
        {
            auto& history = *reinterpret_cast<MotionHistory*>(particles.memory + particle * particles.memorySize);
            if (particles.advancesMemory && !(particles.state[particle].fluid.submergedFraction > 0))
            {
                history.begun = 0;
                history.modes.setZero();
                continue;
            }
            const Vector3d velocity = particles.velocity.col(particle) - particles.state[particle].fluid.velocity;
            if (particles.advancesMemory)
            {
                const Vector3d change = history.begun * (velocity - history.velocity);
                history.modes = history.modes * fades.matrix().asDiagonal();
                history.modes += change * mean.matrix().transpose();
                history.velocity = velocity;
                history.begun = 1;
            }
            const double diameter = 2 * particles.radius[particle];
            const double viscosity = fluid_.viscosityAt(particles.position.col(particle), diameter);
            const double coefficient = closures::historyCoefficient(diameter, fluid_.density, viscosity);
            sum.addedMass[particle] += coefficient * step.ownPart;
            sum.source.col(particle) -=
                coefficient
                * (history.modes * (mean * weights(diameter, velocity.norm(), viscosity / fluid_.density)).matrix());
        }
    }

    ForceNeeds needs() const override
    {
        ForceNeeds needs;
        needs.acceleration = true;
        needs.memory = sizeof(MotionHistory) / sizeof(double);
        return needs;
    }

    Foam::string description() const override
    {
        return Foam::string("historyForce: ") + (share_ ? "Mei & Adrian's kernel" : "Basset's kernel") + ", "
               + Foam::name(historyModes) + " exponentials";
    }

private:
    using Modes = Eigen::Array<double, historyModes, 1>;

    Modes weights(double diameter, double speed, double kinematicViscosity) const
    {
        Modes weights = weight_;
        if (share_)
        {
            const double logTime = closures::meiAdrianLogTime(diameter, speed, kinematicViscosity);
            for (int mode = 0; mode < historyModes; ++mode)
            {
                weights[mode] *= (*share_)(closures::historyLogRate(mode) + logTime);
            }
        }
        return weights;
    }

    const FluidProperties fluid_;
    Modes weight_;
    std::unique_ptr<closures::MeiAdrianShare> share_; // null for Basset's kernel
};

defineTypeNameAndDebug(HistoryForce, 0);
addToRunTimeSelectionTable(ForceModel, HistoryForce, dictionary);
const ForceLines lines(
    ForceFamily::history, {{HistoryForce::typeName_(), "history force (Basset; Mei & Adrian 1992)"}});

} // namespace

} // namespace clepsydra
