#include "couplingStep/clippedVoidFraction.h"

#include "couplingState.h"
#include "couplingStep/couplingField.h"
#include "vectors.h"

namespace clepsydra
{

using namespace Foam;

ClippedVoidFraction::ClippedVoidFraction(const fvMesh& mesh, double minimum, ConservationCheck& conservation)
    : minimum_(minimum),
      conservation_(conservation),
      voidFraction_(couplingField<scalar>("voidFraction", mesh, dimless, 1)),
      solidFraction_(1 - voidFraction_.primitiveField())
{
    voidFraction_.oldTime();
}

void ClippedVoidFraction::restore(const ConstRow& solidFraction)
{
    columns(solidFraction_) = solidFraction;
}

void ClippedVoidFraction::update(
    const ConstRow& solidFraction, const ParticlesView& particles, const LocatedParticles& located, RankTotals& totals)
{
    restore(solidFraction);
    double particleVolume = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        particleVolume += volumeInFluid(particles, particle);
    }
    const scalarField& cellVolumes = voidFraction_.mesh().V().field();
    const double cellVolume = sum(solidFraction_ * cellVolumes);

    scalarField& voidFraction = voidFraction_.primitiveFieldRef();
    voidFraction = 1 - solidFraction_;
    double clippedVolume = 0;
    label worstCell = -1;
    forAll (voidFraction, cell)
    {
        if (voidFraction[cell] < minimum_)
        {
            worstCell = worstCell < 0 || solidFraction_[cell] > solidFraction_[worstCell] ? cell : worstCell;
            clippedVolume += (minimum_ - voidFraction[cell]) * cellVolumes[cell];
            voidFraction[cell] = minimum_;
        }
    }
    voidFraction_.correctBoundaryConditions();
    const double worstHere = worstCell < 0 ? 0 : 1 - (1 - minimum_) / solidFraction_[worstCell];
    totals.add({{particleVolume, cellVolume, clippedVolume}, {worstHere}},
        [this, worstCell, worstHere, located](const RankNumbers& all) {
            ClippedVolume clipped;
            clipped.sum = all.sums[2];
            if (clipped.sum > 0)
            {
                clipped.largestPart = all.maxima[0];
                if (worstCell >= 0 && worstHere == clipped.largestPart)
                {
                    clipped.worstCell = describeCell(worstCell, located.ghosts());
                }
            }
            conservation_.recordSolidVolume(all.sums[0], all.sums[1], clipped);
        });
}

string ClippedVoidFraction::describeCell(label cell, const std::vector<GhostParticle>& particles) const
{
    const vector& centre = voidFraction_.mesh().cellCentres()[cell];
    const GhostParticle* nearest = nullptr;
    double nearestDistance = GREAT;
    for (const GhostParticle& particle : particles)
    {
        const double distance = mag(toFoam(particle.position) - centre);
        if (distance < nearestDistance)
        {
            nearest = &particle;
            nearestDistance = distance;
        }
    }
    return "cell " + Foam::name(cell) + " at " + Foam::name(centre) + " m, void fraction "
           + Foam::name(1 - solidFraction_[cell])
           + (nearest ? ", nearest particle " + Foam::name(label(nearest->id)) : string());
}

} // namespace clepsydra
