#include "closures/beetstraDrag.h"
#include "closures/diFeliceDrag.h"
#include "closures/gidaspowDrag.h"
#include "closures/kochHillDrag.h"
#include "closures/rongDrag.h"
#include "closures/schillerNaumannDrag.h"
#include "closures/stokesDrag.h"
#include "forces/forceModel.h"

namespace clepsydra
{

namespace
{

/// A drag law of closures/ as a force model.
template<class Law>
class Drag : public ForceModel
{
public:
    Drag(const Foam::dictionary&, const FluidProperties& fluid)
    :
        fluid_(fluid)
    {}

    void add(const BeadsView& beads, ForceSum& sum) const override
    {
        const Law law;
        for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
        {
            const FluidAtBead& at = beads.state[bead].fluid;
            const double slipSpeed = (at.velocity - beads.velocity.col(bead)).norm();
            sum.implicitCoefficient[bead] += law(closures::BeadInFluid{2*beads.radius[bead], at.voidFraction,
                at.logVoidFraction, slipSpeed, fluid_.density, fluid_.dynamicViscosity});
        }
    }

    Foam::string description() const override
    {
        return Foam::string(Law::name) + ": fluid density " + Foam::name(fluid_.density) + " kg/m3, viscosity "
            + Foam::name(fluid_.dynamicViscosity) + " Pa s";
    }

private:
    const FluidProperties fluid_;
};

/// Makes a law known under its own name.
template<class Law>
using Register = ForceModel::adddictionaryConstructorToTable<Drag<Law>>;

// Adding a drag law to the program is one line here.
const Register<closures::BeetstraDrag> beetstra(closures::BeetstraDrag::name);
const Register<closures::DiFeliceDrag> diFelice(closures::DiFeliceDrag::name);
const Register<closures::GidaspowDrag> gidaspow(closures::GidaspowDrag::name);
const Register<closures::KochHillDrag> kochHill(closures::KochHillDrag::name);
const Register<closures::RongDrag> rong(closures::RongDrag::name);
const Register<closures::SchillerNaumannDrag> schillerNaumann(closures::SchillerNaumannDrag::name);
const Register<closures::StokesDrag> stokes(closures::StokesDrag::name);

} // namespace

} // namespace clepsydra
