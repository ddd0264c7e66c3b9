#include "distribution/voidFractionModel.h"

#include "addToRunTimeSelectionTable.H"

#include <algorithm>
#include <optional>
#include <utility>

namespace clepsydra
{

namespace
{

/// A Gaussian exp(-r2/b2) around the particle's centre, integrated over each cell (exactly over bricks) and normalised
/// over the cells within 3 b.
///
///     GaussianProps { bandwidth 2e-3; }    // b [m]
///
/// A wall cell holds what would lie behind its wall. Only the cells at a baffle of zero thickness are affected by it:
/// where 3 b exceeds a particle's radius plus the width of the cell behind the baffle, the kernel leaks into the second
/// cell behind. constDiffSmoothing does not leak. At the rim of a baffle and at edges at which a wall bends away from the
/// fluid, the cells behind the wall's plane receive what comes around the rim (WayAroundWalls), so that nothing jumps
/// from one side to the other where a particle passes over a rim.
class Gaussian : public VoidFractionModel
{
public:
    TypeName("Gaussian");

    Gaussian(const Foam::dictionary& coefficients, const CellSlabs& cells)
        : VoidFractionModel(cells),
          bandwidth_(positiveEntry(coefficients, "bandwidth")),
          aroundWalls_(std::in_place, cells.mesh())
    {
        requireKnownEntries(coefficients, {"bandwidth", "alphaMin"});
    }

    double reach(const GhostParticle& particle) const override
    {
        return std::max(particle.radius, commonReach());
    }

    double commonReach() const override
    {
        // Beyond this distance lie 2e-5 of the kernel along each axis.
        return 3 * bandwidth_;
    }

    double share(Foam::label cell, const GhostParticle& particle) const override
    {
        return cells().gaussianShare(cell, particle.position, bandwidth_, particle.radius, *aroundWalls_);
    }

    void meshMoved() override
    {
        aroundWalls_.emplace(cells().mesh());
    }

    Foam::string description() const override
    {
        return "Gaussian: bandwidth " + Foam::name(bandwidth_) + " m, normalised over the cells within its reach";
    }

private:
    const double bandwidth_;
    std::optional<WayAroundWalls> aroundWalls_;
};

defineTypeNameAndDebug(Gaussian, 0);
addToRunTimeSelectionTable(VoidFractionModel, Gaussian, dictionary);
const ModelLines lines(
    "voidFractionModel", {{Gaussian::typeName_(), "a Gaussian of a given bandwidth around the centre"}});

} // namespace

} // namespace clepsydra
