#include "distribution/voidFractionModel.h"

#include "addToRunTimeSelectionTable.H"

namespace clepsydra
{

defineTypeNameAndDebug(VoidFractionModel, 0);
defineRunTimeSelectionTable(VoidFractionModel, dictionary);

Foam::autoPtr<VoidFractionModel> VoidFractionModel::New(
    const Foam::dictionary& couplingProperties, const CellSlabs& cells)
{
    const Foam::word name =
        selectedModel(couplingProperties, "voidFractionModel", dictionaryConstructorTablePtr_->sortedToc());
    return (*dictionaryConstructorTablePtr_)[name](couplingProperties.subOrEmptyDict(name + "Props"), cells);
}

namespace
{

/// The particle's own sphere cut by the cells.
class Divided : public VoidFractionModel
{
public:
    TypeName("divided");

    Divided(const Foam::dictionary& coefficients, const CellSlabs& cells)
        : VoidFractionModel(cells)
    {
        requireKnownEntries(coefficients, {"alphaMin"});
    }

    double reach(const GhostParticle& particle) const override
    {
        return particle.radius;
    }

    double share(Foam::label cell, const GhostParticle& particle) const override
    {
        return cells().share(cell, particle.position, particle.radius, particle.radius);
    }

    Foam::string description() const override
    {
        return "divided: sphere cut by the cells' faces, continuous derivative in time";
    }
};

/// All of the particle in the cell that holds its centre.
class Centre : public VoidFractionModel
{
public:
    TypeName("centre");

    Centre(const Foam::dictionary& coefficients, const CellSlabs& cells)
        : VoidFractionModel(cells)
    {
        requireKnownEntries(coefficients, {"alphaMin"});
    }

    double reach(const GhostParticle& particle) const override
    {
        return particle.radius;
    }

    double share(Foam::label cell, const GhostParticle& particle) const override
    {
        return cells().share(cell, particle.position, smallPart * particle.radius, particle.radius);
    }

    Foam::string description() const override
    {
        return "centre: whole particle in the cell of its centre; jumps in time, use with smoothing";
    }

private:
    /// A small sphere instead of the point itself: a point can fall between warped faces, into no cell.
    static constexpr double smallPart = 0.01;
};

defineTypeNameAndDebug(Divided, 0);
addToRunTimeSelectionTable(VoidFractionModel, Divided, dictionary);
defineTypeNameAndDebug(Centre, 0);
addToRunTimeSelectionTable(VoidFractionModel, Centre, dictionary);
const ModelLines lines("voidFractionModel",
    {{Divided::typeName_(), "each cell has the part of the sphere in it"},
        {Centre::typeName_(), "the cell of the centre has all of the particle; with smoothing only"}});

} // namespace

} // namespace clepsydra
