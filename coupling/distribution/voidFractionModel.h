#pragma once

#include "distribution/cellSlabs.h"
#include "exchange/particleExchange.h"

#include "runTimeSelection.h"

namespace clepsydra
{

/// How a particle is shared among the cells around it, before any smoothing. Selected by `voidFractionModel` in
/// couplingProperties, coefficients in `<name>Props`.
class VoidFractionModel
{
public:
    TypeName("voidFractionModel");

    declareRunTimeSelectionTable(Foam::autoPtr, VoidFractionModel, dictionary,
        (const Foam::dictionary& coefficients, const CellSlabs& cells), (coefficients, cells))

        /// \param couplingProperties  FatalIOError listing the known models where its entry names none of them.
        static Foam::autoPtr<VoidFractionModel> New(const Foam::dictionary& couplingProperties, const CellSlabs& cells);

    explicit VoidFractionModel(const CellSlabs& cells)
        : cells_(cells)
    {}

    virtual ~VoidFractionModel() = default;

    /// How far from its centre a particle acts [m].
    virtual double reach(const GhostParticle& particle) const = 0;

    /// A reach that all particles have, if farther than their radius: they visit the ranks with cells that near [m].
    virtual double commonReach() const
    {
        return 0;
    }

    /// Share of the particle in a cell, not normalised, >= 0.
    virtual double share(Foam::label cell, const GhostParticle& particle) const = 0;

    /// One line for the start of the log.
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
