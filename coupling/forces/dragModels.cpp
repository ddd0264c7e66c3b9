#include "closures/dragLaws.h"
#include "forces/dragOfMany.h"
#include "forces/forceModel.h"
#include "forces/polydispersity.h"
#include "forces/wallCorrection.h"

namespace clepsydra
{

namespace
{

/// Whether a drag law depends on the void fraction. A law of isolated particles does not.
template<class Law>
bool isOfBeds()
{
    const auto dragAt = [](double voidFraction) {
        return Law{}(closures::makeParticleInFluid(1e-3, voidFraction, 0.1, 1000, 1e-3));
    };
    return dragAt(0.5) != dragAt(1);
}

/// A drag law of closures/ as a force model, `<law>Props { factor 1; polydispersity none; wallCorrection {...} }`:
/// multiplied by a factor, and corrected for the sizes of the other particles and for walls.
template<class Law>
class Drag : public ForceOf<ForceFamily::drag>
{
public:
    Drag(const Foam::dictionary& coefficients, const FluidProperties& fluid)
        : fluid_(fluid),
          factor_(coefficients.found("factor") ? positiveEntry(coefficients, "factor") : 1),
          polydispersity_(coefficients),
          walls_(coefficients.subOrEmptyDict("wallCorrection")),
          law_(dragOfMany(Law::name))
    {
        requireKnownEntries(coefficients, {"factor", "polydispersity"}, {"wallCorrection"});
        if (polydispersity_.isOn() && !isOfBeds<Law>())
        {
            FatalIOErrorInFunction(coefficients)
                << "Entry 'polydispersity' is " << polydispersity_.name() << ", but " << Law::name
                << " is a law of isolated particles, which does not depend on the particles around; allowed: none"
                << Foam::exit(Foam::FatalIOError);
        }
    }

    void add(const ParticlesView& particles, ForceSum& sum) const override
    {
        ManyParticlesInFluid many;
        many.density = fluid_.density;
        // Particles that are evaluated together have the same viscosity, so in a stratified liquid it is one at a time.
        const Eigen::Index atATime = fluid_.stratification.isThere() ? 1 : most;
        for (Eigen::Index first = 0; first < particles.size(); first += atATime)
        {
            many.dynamicViscosity = fluid_.viscosityAt(particles.position.col(first), 2 * particles.radius[first]);
            addTo(particles, first, std::min(atATime, particles.size() - first), many, sum);
        }
    }

    ForceNeeds needs() const override
    {
        ForceNeeds needs;
        needs.sauterMeanDiameter = polydispersity_.isOn();
        return needs;
    }

    std::vector<WallPlane> resistingWalls() const override
    {
        return walls_.planes();
    }

    bool scalesToParcels() const override
    {
        return !walls_.isOn();
    }

    Foam::string term() const override
    {
        return walls_.hasPlanes() ? Foam::string("+ S_p (U - v + the slip that plane walls add)") : ForceModel::term();
    }

    Foam::string description() const override
    {
        return Foam::string(Law::name) + ": fluid density " + Foam::name(fluid_.density) + " kg/m3, viscosity "
               + Foam::name(fluid_.dynamicViscosity) + " Pa s"
               + (factor_ == 1 ? "" : ", multiplied by " + Foam::name(factor_))
               + (polydispersity_.isOn() ? ", for mixtures by " + polydispersity_.name() : "") + walls_.description();
    }

private:
    static constexpr Eigen::Index most = ManyParticlesInFluid::most;

    void addTo(const ParticlesView& particles, Eigen::Index first, Eigen::Index count, ManyParticlesInFluid& many,
        ForceSum& sum) const
    {
        std::array<double, most> velocityRatio;
        std::array<double, most> ownDiameter;
        many.count = static_cast<std::size_t>(count);
        for (Eigen::Index i = 0; i < count; ++i)
        {
            const FluidAtParticle& at = particles.state[first + i].fluid;
            closures::ParticleInFluid inFluid{2 * particles.radius[first + i], at.voidFraction, at.logVoidFraction,
                slip(particles, first + i).norm(), many.density, many.dynamicViscosity};
            velocityRatio[i] = walls_.tubeVelocityRatio(inFluid);
            ownDiameter[i] = inFluid.diameter;
            many.diameter[i] = polydispersity_.diameterForLaw(inFluid.diameter, at.sauterMeanDiameter);
            many.voidFraction[i] = inFluid.voidFraction;
            many.logVoidFraction[i] = inFluid.logVoidFraction;
            many.slipSpeed[i] = inFluid.slipSpeed / velocityRatio[i];
        }
        ManyCoefficients coefficients;
        law_(many, coefficients);
        for (Eigen::Index i = 0; i < count; ++i)
        {
            const Eigen::Index particle = first + i;
            const double ofParticle = polydispersity_.coefficient(coefficients[i], many.diameter[i],
                {ownDiameter[i], many.voidFraction[i], many.logVoidFraction[i], many.slipSpeed[i], many.density,
                    many.dynamicViscosity});
            const double coefficient = factor_ * ofParticle / velocityRatio[i];
            sum.implicitCoefficient[particle] += coefficient;
            if (walls_.hasPlanes())
            {
                sum.source.col(particle) += coefficient
                                            * walls_.addedSlip(slip(particles, particle),
                                                particles.position.col(particle), particles.radius[particle]);
            }
        }
    }

    static Vector3d slip(const ParticlesView& particles, Eigen::Index particle)
    {
        return particles.state[particle].fluid.velocity - particles.velocity.col(particle);
    }

    const FluidProperties fluid_;
    const double factor_;
    const Polydispersity polydispersity_;
    const WallCorrection walls_;
    const DragOfMany law_;
};

/// Registers every law under its own name.
template<class Laws>
struct RegisterEach;

template<class... Laws>
struct RegisterEach<std::tuple<Laws...>> : RegisterLaw<Drag, Laws>...
{};

const RegisterEach<closures::DragLaws> allLaws;

} // namespace

} // namespace clepsydra
