#pragma once

#include "conservation/conservationCheck.h"
#include "couplingStep/particleMapping.h"
#include "couplingStep/rows.h"

#include "volFields.H"

namespace clepsydra
{

/// The void fraction of the fluid's equations: 1 less the smoothed volume of the particles per volume of each cell, and
/// not less than `alphaMin`. What is clipped is recorded in the conservation check when the totals are reduced.
class ClippedVoidFraction
{
public:
    /// Reads the field that an earlier process of this run has written.
    ClippedVoidFraction(const Foam::fvMesh& mesh, double minimum, ConservationCheck& conservation);

    const Foam::volScalarField& operator()() const
    {
        return voidFraction_;
    }

    /// Volume of particles per volume of the cell, before clipping.
    const Foam::scalarField& solidFraction() const
    {
        return solidFraction_;
    }

    /// Sets the solid fraction alone, where the void fraction is that of a checkpoint, which is clipped.
    void restore(const ConstRow& solidFraction);

    /// Collective.
    /// \param located  the particles of the same view
    void update(const ConstRow& solidFraction, const ParticlesView& particles, const LocatedParticles& located,
        RankTotals& totals);

private:
    Foam::string describeCell(Foam::label cell, const std::vector<GhostParticle>& particles) const;

    const double minimum_;
    ConservationCheck& conservation_;
    Foam::volScalarField voidFraction_;
    Foam::scalarField solidFraction_;
};

} // namespace clepsydra
