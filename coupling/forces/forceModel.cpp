#include "forces/forceModel.h"

#include "wordList.H"

namespace clepsydra
{

defineTypeNameAndDebug(ForceModel, 0);
defineRunTimeSelectionTable(ForceModel, dictionary);

void ForceSum::setZero(Eigen::Index beadCount)
{
    implicitCoefficient.setZero(beadCount);
    source.setZero(3, beadCount);
    shared.setZero(3, beadCount);
    mutual.setZero(3, beadCount);
    addedMass.setZero(beadCount);
}

Foam::autoPtr<ForceModel> ForceModel::New(
    const Foam::word& name, const Foam::dictionary& couplingProperties, const FluidProperties& fluid)
{
    requireKnownName(couplingProperties, "forceModels", name, dictionaryConstructorTablePtr_->sortedToc());
    return (*dictionaryConstructorTablePtr_)[name](couplingProperties.subOrEmptyDict(name + "Props"), fluid);
}

} // namespace clepsydra
