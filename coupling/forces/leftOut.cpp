#include "forces/forceModel.h"

namespace clepsydra
{

namespace
{

/// Leaves a term out of the equations on purpose: an entry of forceModels that stands in the place of a model.
template<ForceFamily Family>
class LeftOut : public ForceOf<Family>
{
public:
    LeftOut(const Foam::dictionary& coefficients, const FluidProperties&)
    {
        requireKnownEntries(coefficients, {});
    }

    void add(const ParticlesView&, ForceSum&) const override
    {}

    bool isLeftOut() const override
    {
        return true;
    }

    bool onlyInModelA() const override
    {
        return Family == ForceFamily::pressureGradient || Family == ForceFamily::viscousStress;
    }

    bool scalesToParcels() const override
    {
        return true;
    }

    Foam::string description() const override
    {
        return Foam::string(textOf(Family).leftOutBy) + ": the " + textOf(Family).name + " is left out";
    }
};

template<ForceFamily Family>
struct Register : ForceModel::adddictionaryConstructorToTable<LeftOut<Family>>
{
    explicit Register(const char* line)
        : ForceModel::adddictionaryConstructorToTable<LeftOut<Family>>(textOf(Family).leftOutBy),
          lines("forceModels", {{textOf(Family).leftOutBy, line}})
    {}

    const ModelLines lines;
};

const Register<ForceFamily::drag> noDrag("leaves out the drag, in the place of a drag law");
const Register<ForceFamily::pressureGradient> noPressureGradient("leaves out gradPForce (model A)");
const Register<ForceFamily::viscousStress> noViscousStress("leaves out viscForce (model A)");
const Register<ForceFamily::buoyancy> noBuoyancy("leaves out Archimedes");

} // namespace

} // namespace clepsydra
