#include "closures/addedMass.h"
#include "forces/forceModel.h"

#include "addToRunTimeSelectionTable.H"

namespace clepsydra
{

namespace
{

const ModelLines laws(
    "virtualMassForceProps { law }", {{"constant", "Cadd of the bead's volume: 0.5 unless given (the default)"},
                                         {"Zuber", "grows with the solid fraction (Zuber 1964)"}});

/// m_a (DU/Dt - dv/dt), implicit in the bead's inertia: see closures/addedMass.h and ForceSum::addedMass.
///
///     virtualMassForceProps { law constant; Cadd 0.5; }     // the default
///     virtualMassForceProps { law Zuber; }                  // grows with the solid fraction
class VirtualMassForce : public ForceModel
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

    void add(const BeadsView& beads, ForceSum& sum) const override
    {
        for (Eigen::Index bead = 0; bead < beads.size(); ++bead)
        {
            const double coefficient =
                zuber_ ? closures::zuberAddedMassCoefficient(beads.state[bead].fluid.voidFraction) : coefficient_;
            sum.addedMass[bead] += closures::addedMass(coefficient, fluidDensity_, sphereVolume(beads.radius[bead]));
        }
    }

    ForceNeeds needs() const override
    {
        ForceNeeds needs;
        needs.acceleration = true;
        return needs;
    }

    Foam::string description() const override
    {
        return "virtualMassForce: added mass, coefficient "
               + (zuber_ ? Foam::string("after Zuber") : Foam::string(Foam::name(coefficient_)));
    }

private:
    const double fluidDensity_;
    double coefficient_ = closures::loneAddedMassCoefficient;
    bool zuber_ = false;
};

defineTypeNameAndDebug(VirtualMassForce, 0);
addToRunTimeSelectionTable(ForceModel, VirtualMassForce, dictionary);
const ModelLines lines("forceModels", {{VirtualMassForce::typeName_(), "added mass (Auton, Hunt & Prud'homme 1988)"}});

} // namespace

} // namespace clepsydra
