#pragma once

#include "distribution/cellSlabs.h"
#include "exchange/particleExchange.h"

#include "runTimeSelection.h"

namespace clepsydra
{

/// Shares of a particle in the cells around it, before smoothing. Selected by `voidFractionModel` in
/// couplingProperties, with coefficients in `<name>Props`.
class VoidFractionModel
{
public:
    TypeName("voidFractionModel");

    declareRunTimeSelectionTable(Foam::autoPtr, VoidFractionModel, dictionary,
        (const Foam::dictionary& coefficients, const CellSlabs& cells), (coefficients, cells))

        /// FatalIOError with the known models where the entry of couplingProperties names none of them.
        static Foam::autoPtr<VoidFractionModel> New(const Foam::dictionary& couplingProperties, const CellSlabs& cells);

    explicit VoidFractionModel(const CellSlabs& cells)
        : cells_(cells)
    {}

    virtual ~VoidFractionModel() = default;

    /// Distance from its centre over which a particle acts [m].
    virtual double reach(const GhostParticle& particle) const = 0;

    /// Reach that is common to all particles, where it is larger than their radius [m]; the particles are sent to ranks
    /// with cells within this distance.
    virtual double commonReach() const
    {
        return 0;
    }

    /// Share of the particle in a cell, not normalised, >= 0.
    virtual double share(Foam::label cell, const GhostParticle& particle) const = 0;

    /// Recomputes what depends on the points of the mesh, after they have moved and the cells are new. Collective.
    virtual void meshMoved()
    {}

    /// One line for the report at the start of the log.
    virtual Foam::string description() const = 0;

protected:
    const CellSlabs& cells() const
    {
        return cells_;
    }

private:
    const CellSlabs& cells_;
};

} // namespace clepsydra
