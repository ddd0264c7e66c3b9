#include "distribution/voidFractionModel.h"

#include "addToRunTimeSelectionTable.H"

#include <algorithm>

namespace clepsydra
{

namespace
{

/// A Gaussian exp(-r2/b2) about the particle's centre, integrated over each cell (exactly so over bricks) and normalised
/// over the cells that it reaches, up to 3 b.
///
///     GaussianProps { bandwidth 2e-3; }    // b [m]
///
/// A wall cell keeps what would lie behind its wall. A baffle of zero thickness is seen by the cells at it only: where
/// 3 b is more than a particle's radius and a cell's width behind the baffle, the kernel leaks into the second cell behind.
/// constDiffSmoothing does not.
class Gaussian : public VoidFractionModel
{
public:
    TypeName("Gaussian");

    Gaussian(const Foam::dictionary& coefficients, const CellSlabs& cells)
        : VoidFractionModel(cells),
          bandwidth_(positiveEntry(coefficients, "bandwidth"))
    {
        requireKnownEntries(coefficients, {"bandwidth", "alphaMin"});
    }

    double reach(const GhostParticle& particle) const override
    {
        return std::max(particle.radius, commonReach());
    }

    double commonReach() const override
    {
        // Beyond it lie 2e-5 of the kernel along each axis.
        return 3 * bandwidth_;
    }

    double share(Foam::label cell, const GhostParticle& particle) const override
    {
        return cells().gaussianShare(cell, particle.position, bandwidth_, particle.radius);
    }

    Foam::string description() const override
    {
        return "Gaussian: bandwidth " + Foam::name(bandwidth_) + " m, normalised over the cells it reaches";
    }

private:
    const double bandwidth_;
};

defineTypeNameAndDebug(Gaussian, 0);
addToRunTimeSelectionTable(VoidFractionModel, Gaussian, dictionary);
const ModelLines lines(
    "voidFractionModel", {{Gaussian::typeName_(), "a Gaussian round the centre, of a bandwidth in metres"}});

} // namespace

} // namespace clepsydra
