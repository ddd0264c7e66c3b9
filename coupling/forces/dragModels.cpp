#include "closures/dragLaws.h"
#include "forces/forceModel.h"
#include "forces/wallCorrection.h"

namespace clepsydra
{

namespace
{

/// A drag law of closures/ as a force model, `<law>Props { factor 1; wallCorrection {...} }`: times a number, and for
/// beads beside walls.
template<class Law>
class Drag : public ForceModel
{
public:
    Drag(const Foam::dictionary& coefficients, const FluidProperties& fluid)
        : fluid_(fluid),
          factor_(coefficients.found("factor") ? positiveEntry(coefficients, "factor") : 1),
          walls_(coefficients.subOrEmptyDict("wallCorrection"))
    {}

    void add(const BeadsView& beads, ForceSum& sum) const override
    {
        const Law law;
        for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
        {
            const FluidAtBead& at = beads.state[bead].fluid;
            const Vector3d slip = at.velocity - beads.velocity.col(bead);
            closures::BeadInFluid inFluid{2 * beads.radius[bead], at.voidFraction, at.logVoidFraction, slip.norm(),
                fluid_.density, fluid_.dynamicViscosity};
            const double velocityRatio = walls_.tubeVelocityRatio(inFluid);
            inFluid.slipSpeed /= velocityRatio;
            const double coefficient = factor_ * law(inFluid) / velocityRatio;
            sum.implicitCoefficient[bead] += coefficient;
            if (walls_.hasPlanes())
            {
                sum.source.col(bead) +=
                    coefficient * walls_.addedSlip(slip, beads.position.col(bead), beads.radius[bead]);
            }
        }
    }

    Foam::string description() const override
    {
        return Foam::string(Law::name) + ": fluid density " + Foam::name(fluid_.density) + " kg/m3, viscosity "
               + Foam::name(fluid_.dynamicViscosity) + " Pa s" + (factor_ == 1 ? "" : ", times " + Foam::name(factor_))
               + walls_.description();
    }

private:
    const FluidProperties fluid_;
    const double factor_;
    const WallCorrection walls_;
};

template<class Law>
using Register = ForceModel::adddictionaryConstructorToTable<Drag<Law>>;

/// Makes every law known under its own name.
template<class Laws>
struct RegisterEach;

template<class... Laws>
struct RegisterEach<std::tuple<Laws...>> : Register<Laws>...
{
    RegisterEach()
        : Register<Laws>(Laws::name)...
    {}
};

const RegisterEach<closures::DragLaws> allLaws;

} // namespace

} // namespace clepsydra
