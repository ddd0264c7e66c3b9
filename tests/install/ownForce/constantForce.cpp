#include "forces/forceModel.h"
#include "knownEntries.h"

#include "addToRunTimeSelectionTable.H"
#include "vector.H"

namespace
{

using namespace clepsydra;

/// The same force on every particle, as a magnet far away would give it; no reaction in the fluid. ConstantForceProps { force (x y z); } [N].
class ConstantForce : public ForceOf<ForceFamily::other>
{
public:
    TypeName("ConstantForce");

    ConstantForce(const Foam::dictionary& coefficients, const FluidProperties&)
    {
        requireKnownEntries(coefficients, {"force"});
        const auto force = coefficients.get<Foam::vector>("force");
        force_ = Vector3d(force.x(), force.y(), force.z());
    }

    void add(const ParticlesView& particles, ForceSum& sum) const override
    {
        for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
        {
            sum.mutual.col(particle) += force_;
        }
    }

    Foam::string description() const override
    {
        return "ConstantForce: " + Foam::name(force_.norm()) + " N";
    }

private:
    Vector3d force_;
};

defineTypeNameAndDebug(ConstantForce, 0);
addToRunTimeSelectionTable(ForceModel, ConstantForce, dictionary);

} // namespace
