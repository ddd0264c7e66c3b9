#include "closures/magnusLift.h"
#include "closures/saffmanMeiLift.h"
#include "forces/forceModel.h"

namespace clepsydra
{

namespace
{

/// A lift law of closures/ as a force model, C (U_f - u_p) x w.
template<class Law>
class Lift
    : public ForceOf<Law::rotation == closures::Rotation::ofFluid ? ForceFamily::shearLift : ForceFamily::rotationLift>
{
public:
    Lift(const Foam::dictionary& coefficients, const FluidProperties& fluid)
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
            const Vector3d slip = at.velocity - particles.velocity.col(particle);
            const Vector3d rotation = Law::rotation == closures::Rotation::ofFluid
                                          ? at.vorticity
                                          : Vector3d(particles.angularVelocity.col(particle) - 0.5 * at.vorticity);
            const double diameter = 2 * particles.radius[particle];
            const double coefficient = law(closures::ParticleInRotation{diameter, slip.norm(), rotation.norm(),
                fluid_.density, fluid_.viscosityAt(particles.position.col(particle), diameter)});
            sum.source.col(particle) += coefficient * slip.cross(rotation);
        }
    }

    ForceNeeds needs() const override
    {
        ForceNeeds needs;
        needs.vorticity = true;
        return needs;
    }

    Foam::string description() const override
    {
        return Foam::string(Law::name) + ": lift, no torque";
    }

private:
    const FluidProperties fluid_;
};

template<class Law>
using Register = RegisterLaw<Lift, Law>;

// A lift law is added to the program by one line here.
const Register<closures::RubinowKellerLift> rubinowKeller;
const Register<closures::OesterleBuiDinhLift> oesterleBuiDinh;
const Register<closures::SaffmanMeiLift> saffmanMei;

} // namespace

} // namespace clepsydra
