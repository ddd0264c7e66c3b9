#include "distribution/smoothingModel.h"

#include "addToRunTimeSelectionTable.H"

namespace clepsydra
{

defineTypeNameAndDebug(SmoothingModel, 0);
defineRunTimeSelectionTable(SmoothingModel, dictionary);

Foam::autoPtr<SmoothingModel> SmoothingModel::New(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh)
{
    const Foam::word name =
        selectedModel(couplingProperties, "smoothingModel", dictionaryConstructorTablePtr_->sortedToc());
    return (*dictionaryConstructorTablePtr_)[name](couplingProperties.subOrEmptyDict(name + "Props"), mesh);
}

namespace
{

class NoSmoothing : public SmoothingModel
{
public:
    TypeName("off");

    NoSmoothing(const Foam::dictionary&, const Foam::fvMesh&)
    {}

    void nearTo(const std::vector<Foam::label>&, RankTotals&) override
    {}

    void smooth(Eigen::MatrixXd&) const override
    {}

    double bandwidth() const override
    {
        return 0;
    }

    Foam::string description() const override
    {
        return "off";
    }
};

defineTypeNameAndDebug(NoSmoothing, 0);
addToRunTimeSelectionTable(SmoothingModel, NoSmoothing, dictionary);
const ModelLines smoothingLines("smoothingModel", {{NoSmoothing::typeName_(), "no smoothing"}});

} // namespace

} // namespace clepsydra
