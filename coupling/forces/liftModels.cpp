#include "closures/magnusLift.h"
#include "closures/saffmanMeiLift.h"
#include "forces/forceModel.h"

namespace clepsydra
{

namespace
{

/// A lift law of closures/ as a force model: C (U_f - u_p) x w.
template<class Law>
class Lift : public ForceModel
{
public:
    Lift(const Foam::dictionary& coefficients, const FluidProperties& fluid)
        : fluid_(fluid)
    {
        requireKnownEntries(coefficients, {});
    }

    void add(const BeadsView& beads, ForceSum& sum) const override
    {
        const Law law;
        for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
        {
            const FluidAtBead& at = beads.state[bead].fluid;
            const Vector3d slip = at.velocity - beads.velocity.col(bead);
            const Vector3d rotation = Law::rotation == closures::Rotation::ofFluid
                                          ? at.vorticity
                                          : Vector3d(beads.angularVelocity.col(bead) - 0.5 * at.vorticity);
            const double diameter = 2 * beads.radius[bead];
            const double coefficient = law(closures::BeadInRotation{diameter, slip.norm(), rotation.norm(),
                fluid_.density, fluid_.viscosityAt(beads.position.col(bead), diameter)});
            sum.source.col(bead) += coefficient * slip.cross(rotation);
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

// Adding a lift law to the program is one line here.
const Register<closures::RubinowKellerLift> rubinowKeller;
const Register<closures::OesterleBuiDinhLift> oesterleBuiDinh;
const Register<closures::SaffmanMeiLift> saffmanMei;

} // namespace

} // namespace clepsydra
