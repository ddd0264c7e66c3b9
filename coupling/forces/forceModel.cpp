#include "forces/forceModel.h"

#include "wordList.H"

namespace clepsydra
{

defineTypeNameAndDebug(ForceModel, 0);
defineRunTimeSelectionTable(ForceModel, dictionary);

void ForceSum::setZero(Eigen::Index particleCount)
{
    implicitCoefficient.setZero(particleCount);
    source.setZero(3, particleCount);
    pressure.setZero(3, particleCount);
    shared.setZero(3, particleCount);
    mutual.setZero(3, particleCount);
    addedMass.setZero(particleCount);
}

void ForceSum::multiplyBy(double factor)
{
    implicitCoefficient *= factor;
    source *= factor;
    pressure *= factor;
    shared *= factor;
    addedMass *= factor;
}

Foam::autoPtr<ForceModel> ForceModel::New(
    const Foam::word& name, const Foam::dictionary& couplingProperties, const FluidProperties& fluid)
{
    requireKnownName(couplingProperties, "forceModels", name, dictionaryConstructorTablePtr_->sortedToc());
    return (*dictionaryConstructorTablePtr_)[name](couplingProperties.subOrEmptyDict(name + "Props"), fluid);
}

} // namespace clepsydra
