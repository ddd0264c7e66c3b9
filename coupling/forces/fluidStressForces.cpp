#include "forces/forceModel.h"

#include "addToRunTimeSelectionTable.H"

namespace clepsydra
{

namespace
{

/// -V_p grad p, where p is the pressure without its hydrostatic part. In model A the fluid has eps grad p, so the
/// reaction (1 - eps) grad p is already in its equation. Anderson & Jackson, I&EC Fundamentals 6, 527 (1967).
class PressureGradientForce : public ForceOf<ForceFamily::pressureGradient>
{
public:
    TypeName("gradPForce");

    PressureGradientForce(const Foam::dictionary& coefficients, const FluidProperties&)
    {
        requireKnownEntries(coefficients, {});
    }

    void add(const ParticlesView& particles, ForceSum& sum) const override
    {
        for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
        {
            sum.pressure.col(particle) -=
                sphereVolume(particles.radius[particle]) * particles.state[particle].fluid.pressureGradient;
        }
    }

    ForceNeeds needs() const override
    {
        ForceNeeds needs;
        needs.pressureGradient = true;
        return needs;
    }

    bool onlyInModelA() const override
    {
        return true;
    }

    bool scalesToParcels() const override
    {
        return true;
    }

    Foam::string description() const override
    {
        return "gradPForce: -V_p grad(p), p without its hydrostatic part";
    }
};

/// V_p div(tau): the force of the undisturbed flow's viscous stress on the particle.
class ViscousForce : public ForceOf<ForceFamily::viscousStress>
{
public:
    TypeName("viscForce");

    ViscousForce(const Foam::dictionary& coefficients, const FluidProperties&)
    {
        requireKnownEntries(coefficients, {});
    }

    void add(const ParticlesView& particles, ForceSum& sum) const override
    {
        for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
        {
            sum.source.col(particle) +=
                sphereVolume(particles.radius[particle]) * particles.state[particle].fluid.viscousStressDivergence;
        }
    }

    ForceNeeds needs() const override
    {
        ForceNeeds needs;
        needs.viscousStress = true;
        return needs;
    }

    bool onlyInModelA() const override
    {
        return true;
    }

    bool scalesToParcels() const override
    {
        return true;
    }

    Foam::string description() const override
    {
        return "viscForce: V_p div(tau)";
    }
};

/// -rho_f V_p g: the force of the hydrostatic part of the pressure gradient. Its reaction acts on the tank's floor.
class Archimedes : public ForceOf<ForceFamily::buoyancy>
{
public:
    TypeName("Archimedes");

    Archimedes(const Foam::dictionary& coefficients, const FluidProperties& fluid)
        : weightDensity_(fluid.density * fluid.gravity)
    {
        requireKnownEntries(coefficients, {});
    }

    void add(const ParticlesView& particles, ForceSum& sum) const override
    {
        for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
        {
            sum.shared.col(particle) -= sphereVolume(particles.radius[particle]) * weightDensity_;
        }
    }

    bool scalesToParcels() const override
    {
        return true;
    }

    Foam::string description() const override
    {
        return "Archimedes: " + Foam::name(weightDensity_.norm()) + " N/m3 against gravity";
    }

private:
    const Vector3d weightDensity_;
};

defineTypeNameAndDebug(PressureGradientForce, 0);
addToRunTimeSelectionTable(ForceModel, PressureGradientForce, dictionary);
defineTypeNameAndDebug(ViscousForce, 0);
addToRunTimeSelectionTable(ForceModel, ViscousForce, dictionary);
defineTypeNameAndDebug(Archimedes, 0);
addToRunTimeSelectionTable(ForceModel, Archimedes, dictionary);
const ForceLines pressureGradient(ForceFamily::pressureGradient,
    {{PressureGradientForce::typeName_(), "-V grad p, p without its hydrostatic part (model A)"}});
const ForceLines viscousStress(
    ForceFamily::viscousStress, {{ViscousForce::typeName_(), "viscous force V div(tau) (model A)"}});
const ForceLines buoyancy(
    ForceFamily::buoyancy, {{Archimedes::typeName_(), "buoyancy; necessary with either modelType"}});

} // namespace

} // namespace clepsydra
