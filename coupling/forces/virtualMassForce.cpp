#include "closures/addedMass.h"
#include "forces/forceModel.h"

#include "addToRunTimeSelectionTable.H"

namespace clepsydra
{

namespace
{

const ModelLines laws(
    "virtualMassForceProps { law }", {{"constant", "coefficient Cadd, 0.5 unless given (the default)"},
                                         {"Zuber", "coefficient that increases with the solid fraction (Zuber 1964)"}});

/// Added mass force m_a (DU/Dt - dv/dt), implicit in the particle's inertia: see closures/addedMass.h and
/// ForceSum::addedMass.
///
///     virtualMassForceProps { law constant; Cadd 0.5; }     // the default
///     virtualMassForceProps { law Zuber; }                  // increases with the solid fraction
class VirtualMassForce : public ForceOf<ForceFamily::addedMass>
{
public:
    TypeName("virtualMassForce");

    VirtualMassForce(const Foam::dictionary& coefficients, const FluidProperties& fluid)
        : fluidDensity_(fluid.density)
    {
        if (coefficients.found("law"))
        {
            zuber_ = selectedModel(coefficients, "law", laws.names()) == "Zuber";
        }
        requireKnownEntries(coefficients, zuber_ ? wordList({"law"}) : wordList({"law", "Cadd"}));
        if (coefficients.found("Cadd"))
        {
            coefficient_ = positiveEntry(coefficients, "Cadd", true);
        }
    }

    void add(const ParticlesView& particles, ForceSum& sum) const override
    {
        for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
        {
            const double coefficient =
                zuber_ ? closures::zuberAddedMassCoefficient(particles.state[particle].fluid.voidFraction)
                       : coefficient_;
            sum.addedMass[particle] +=
                closures::addedMass(coefficient, fluidDensity_, sphereVolume(particles.radius[particle]));
        }
    }

    ForceNeeds needs() const override
    {
        ForceNeeds needs;
        needs.acceleration = true;
        return needs;
    }

    bool scalesToParcels() const override
    {
        return true;
    }

    Foam::string description() const override
    {
        return "virtualMassForce: added mass, coefficient "
               + (zuber_ ? Foam::string("after Zuber 1964") : Foam::string(Foam::name(coefficient_)));
    }

private:
    const double fluidDensity_;
    double coefficient_ = closures::isolatedAddedMassCoefficient;
    bool zuber_ = false;
};

defineTypeNameAndDebug(VirtualMassForce, 0);
addToRunTimeSelectionTable(ForceModel, VirtualMassForce, dictionary);
const ForceLines lines(
    ForceFamily::addedMass, {{VirtualMassForce::typeName_(), "added mass force (Auton, Hunt & Prud'homme 1988)"}});

} // namespace

} // namespace clepsydra
