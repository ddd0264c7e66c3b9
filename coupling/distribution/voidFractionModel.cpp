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

/// The particle's sphere, divided by the cells' faces.
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
        return "divided: each cell holds the part of the sphere in it; the derivative in time is continuous";
    }
};

/// The whole particle in the cell that holds its centre.
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
        return "centre: the cell that holds the centre holds the whole particle; it jumps in time, use it with "
               "smoothing";
    }

private:
    /// Radius of a small sphere in place of the centre, in radii of the particle: a point can lie between warped faces,
    /// in no cell.
    static constexpr double smallPart = 0.01;
};

defineTypeNameAndDebug(Divided, 0);
addToRunTimeSelectionTable(VoidFractionModel, Divided, dictionary);
defineTypeNameAndDebug(Centre, 0);
addToRunTimeSelectionTable(VoidFractionModel, Centre, dictionary);
const ModelLines voidFractionLines(
    "voidFractionModel", {{Divided::typeName_(), "each cell holds the part of the sphere in it"},
                             {Centre::typeName_(), "the cell of the centre holds all of it; use with smoothing only"}});

} // namespace

} // namespace clepsydra
