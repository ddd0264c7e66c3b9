#pragma once

#include "closures/particleInFluid.h"
#include "closures/wallCorrection.h"
#include "engine/particles.h"
#include "forces/wallPlanes.h"

#include <algorithm>

namespace clepsydra
{

inline const ModelLines wallCorrections("<drag law>Props { wallCorrection { law } }",
    {{"none", "none (the default)"}, {"DiFelice1996", "on the axis of a tube, any Re (Di Felice 1996)"},
        {"Faxen", "beside plane walls, Re << 1 (Faxen 1923)"}});

/// Corrects the drag of any drag law for walls; see closures/wallCorrection.h. With planes, the drag of a particle is
/// F = Sp (slip + addedSlip).
///
///     wallCorrection { law none; }                                        // the default
///     wallCorrection { law DiFelice1996; tubeDiameter 0.094; }            // [m], any Re
///     wallCorrection { law Faxen; walls ( ((0 0 0) (0 0 1)) ); }          // point and normal of each plane, Re << 1
///
/// For motion towards a plane the factor is Brenner's. It is constant for gaps below a fifth of a radius, where
/// lubricationForce begins by default and adds the rest. Contributions of several planes are added (Oseen).
class WallCorrection
{
public:
    /// FatalIOError for an unknown law, for other entries without a law, and for a law without its tube or walls.
    explicit WallCorrection(const Foam::dictionary& dict)
    {
        requireKnownEntries(dict, {"law", "tubeDiameter", "walls"});
        const Foam::word law = dict.empty() ? Foam::word("none") : selectedModel(dict, "law", wallCorrections.names());
        if (law == "DiFelice1996")
        {
            tubeDiameter_ = positiveEntry(dict, "tubeDiameter");
        }
        if (law == "Faxen")
        {
            planes_ = readWallPlanes(dict);
            if (planes_.empty())
            {
                FatalIOErrorInFunction(dict) << "Entry 'walls' is missing or empty; allowed: at least one pair of a "
                                             << "point and a normal" << Foam::exit(Foam::FatalIOError);
            }
        }
    }

    /// Speed of the particle divided by that of a free particle with the same drag [-]; 1 without a tube. FatalError
    /// for a particle as wide as the tube.
    double tubeVelocityRatio(const closures::ParticleInFluid& particle) const
    {
        if (tubeDiameter_ == 0)
        {
            return 1;
        }
        const double lambda = particle.diameter / tubeDiameter_;
        if (lambda >= 1)
        {
            FatalErrorInFunction << "A particle has a diameter of " << particle.diameter
                                 << " m, but wallCorrection's tube has " << tubeDiameter_
                                 << " m; allowed: particles narrower than tubeDiameter" << Foam::exit(Foam::FatalError);
        }
        return closures::diFeliceWallVelocityRatioAtSpeed(lambda, closures::isolatedReynolds(particle));
    }

    const std::vector<WallPlane>& planes() const
    {
        return planes_;
    }

    bool isOn() const
    {
        return tubeDiameter_ > 0 || hasPlanes();
    }

    bool hasPlanes() const
    {
        return !planes_.empty();
    }

    /// Additional slip with which a free particle would have the same drag [m/s]. FatalError for a particle behind a
    /// plane.
    Vector3d addedSlip(const Vector3d& slip, const Vector3d& position, double radius) const
    {
        Vector3d added = Vector3d::Zero();
        for (const WallPlane& plane : planes_)
        {
            const double distance = plane.distance(position);
            if (distance < 0)
            {
                FatalErrorInFunction << "The centre of a particle at " << toFoam(position) << " m is " << -distance
                                     << " m behind wallCorrection's plane through " << toFoam(plane.point)
                                     << " with the normal " << toFoam(plane.normal)
                                     << "; allowed: planes whose normal points to the particles"
                                     << Foam::exit(Foam::FatalError);
            }
            const double lambda = radius / std::max(radius, distance);
            const double gap = std::max(distance / radius - 1, lubricatedGap);
            const Vector3d across = plane.normal.dot(slip) * plane.normal;
            added += (closures::faxenParallelFactor(lambda) - 1) * (slip - across)
                     + (closures::brennerPerpendicularFactor(gap) - 1) * across;
        }
        return added;
    }

    /// Text that follows the drag law's description; empty without a correction.
    Foam::string description() const
    {
        if (tubeDiameter_ > 0)
        {
            return ", walls after Di Felice 1996, tube of " + Foam::name(tubeDiameter_) + " m";
        }
        return hasPlanes() ? ", walls after Faxen, " + Foam::name(static_cast<Foam::label>(planes_.size())) + " planes"
                           : "";
    }

private:
    /// Gap divided by the radius below which the factor is constant: lubricationForce's default reach, 0.1, in
    /// diameters.
    static constexpr double lubricatedGap = 0.2;

    double tubeDiameter_ = 0;
    std::vector<WallPlane> planes_;
};

} // namespace clepsydra
