#include "closures/rotationTorque.h"
#include "forces/forceModel.h"

namespace clepsydra
{

namespace
{

/// A torque law of closures/ as a force model, C_t (curl(U)/2 - omega). It exerts no force.
template<class Law>
class Torque : public ForceOf<ForceFamily::torque>
{
public:
    Torque(const Foam::dictionary& coefficients, const FluidProperties& fluid)
        : fluid_(fluid)
    {
        requireKnownEntries(coefficients, {});
    }

    void add(const ParticlesView& particles, ForceSum& sum) const override
    {
        const Law law;
        for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
        {
            const FluidAtParticle& at = particles.state[particle].fluid;
            const Vector3d rotation = 0.5 * at.vorticity - particles.angularVelocity.col(particle);
            const Vector3d slip = at.velocity - particles.velocity.col(particle);
            const double diameter = 2 * particles.radius[particle];
            sum.torqueCoefficient[particle] += law(closures::ParticleInRotation{diameter, slip.norm(), rotation.norm(),
                fluid_.density, fluid_.viscosityAt(particles.position.col(particle), diameter)});
        }
    }

    ForceNeeds needs() const override
    {
        ForceNeeds needs;
        needs.vorticity = true;
        needs.torque = true;
        return needs;
    }

    Foam::string description() const override
    {
        return Foam::string(Law::name) + ": torque, reaction as a couple in the momentum equation";
    }

private:
    const FluidProperties fluid_;
};

template<class Law>
using Register = RegisterLaw<Torque, Law>;

// A torque law is added to the program by one line here.
const Register<closures::StokesTorque> stokes;
const Register<closures::DennisTorque> dennis;

} // namespace

} // namespace clepsydra
