#include "couplingStep/heatTransferModel.h"

#include "closures/nusselt.h"

#include "addToRunTimeSelectionTable.H"

namespace clepsydra
{

defineTypeNameAndDebug(HeatTransferModel, 0);
defineRunTimeSelectionTable(HeatTransferModel, dictionary);

autoPtr<HeatTransferModel> HeatTransferModel::New(const dictionary& energy)
{
    const word name = selectedModel(energy, "heatTransferModel", dictionaryConstructorTablePtr_->sortedToc());
    return (*dictionaryConstructorTablePtr_)[name](energy);
}

namespace
{

class Gunn final : public HeatTransferModel
{
public:
    TypeName("Gunn");

    explicit Gunn(const dictionary&)
    {}

    double nusselt(double reynolds, double prandtl, double voidFraction) const override
    {
        return closures::gunnNusselt(voidFraction * reynolds, prandtl, voidFraction);
    }

    std::string description() const override
    {
        return "Nusselt number by Gunn (1978): void fraction 0.35 to 1, Reynolds number to 1e5";
    }
};

class RanzMarshall final : public HeatTransferModel
{
public:
    TypeName("RanzMarshall");

    explicit RanzMarshall(const dictionary&)
    {}

    double nusselt(double reynolds, double prandtl, double) const override
    {
        return closures::ranzMarshallNusselt(reynolds, prandtl);
    }

    std::string description() const override
    {
        return "Nusselt number by Ranz & Marshall (1952): isolated particles, Reynolds number to 200";
    }
};

defineTypeNameAndDebug(Gunn, 0);
addToRunTimeSelectionTable(HeatTransferModel, Gunn, dictionary);
defineTypeNameAndDebug(RanzMarshall, 0);
addToRunTimeSelectionTable(HeatTransferModel, RanzMarshall, dictionary);
const ModelLines lines("energy/heatTransferModel",
    {{Gunn::typeName_(), "Nusselt number in beds and suspensions, Gunn (1978)"},
        {RanzMarshall::typeName_(), "Nusselt number of isolated particles, Ranz & Marshall (1952)"}});

} // namespace

} // namespace clepsydra
