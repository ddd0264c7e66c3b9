#pragma once

#include "engine/demEngine.h"
#include "insertionAndRemoval/particleOutlets.h"

#include "regIOobject.H"

#include <vector>

namespace clepsydra
{

/// What has come or gone in this process, over all ranks.
struct ParticleTransfer
{
    Foam::label particles = 0;
    double mass = 0;                            // [kg]
    Foam::vector momentum = Foam::vector::zero; // [N s], as they came or went
    /// [m3]; of particles on their way the part that has come or gone, so that it does not wait for them to be counted.
    double volume = 0;

    ParticleTransfer& operator+=(const ParticleTransfer& other);
};

/// Particles that come and go: how much of each is in the fluid, which are gone, and the balances of both.
///
///     particleOutlets     (floor outlet);     // see ParticleOutlets; default: none
///     insertionTime   0.02;               // s, see below; default: ten coupling steps
///
/// A particle that crosses an outlet hands over its volume as the part of its sphere beyond it, and is taken out of the
/// engine when all of it is there. A particle that the engine's script inserts during the run comes in within insertionTime,
/// at a share of 3 r2 - 2 r3 of its volume at a part r of that time: neither way does the void fraction's rate jump.
/// What is not in the fluid feels no fluid.
///
/// Registered with the mesh's database under the name "insertionAndRemoval", for function objects.
class InsertionAndRemoval : public Foam::regIOobject
{
public:
    static constexpr const char* registryName = "insertionAndRemoval";

    /// FatalIOError for entries out of range.
    InsertionAndRemoval(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh, double couplingTimeStep);

    /// Of particles that have been here all along: how they lie to the outlets. Nothing is recorded.
    /// \param freshStart  no particle is on its way in; otherwise the engine's checkpoint says how far it is
    /// \return the volume of what of them is in the fluid, over all ranks [m3]. Collective.
    double start(const ParticlesView& particles, bool freshStart);

    /// After the engine has advanced by `interval`. Collective.
    /// \param newFrom  particles with a higher id have come in
    void advance(const ParticlesView& particles, int newFrom, double couplingTimeStep);

    /// Takes those particles out of the engine that are wholly outside, and balances them. Collective.
    /// \return how many, on all ranks. If any, views are invalid and DemEngine::prepare() must follow.
    Foam::label removeDeparted(DemEngine& engine);

    const Foam::wordList& outlets() const
    {
        return outlets_.names();
    }

    /// In the last interval.
    const ParticleTransfer& lastInserted() const
    {
        return lastInserted_;
    }

    /// In the last couplingTimeStep, in the order of outlets().
    const std::vector<ParticleTransfer>& lastDeparted() const
    {
        return lastDeparted_;
    }

    /// Solid volume that came in less that which left, since start() [m3].
    double netVolume() const
    {
        return netVolume_;
    }

    bool writeData(Foam::Ostream&) const override
    {
        return true;
    }

private:
    /// A particle of this rank that is wholly outside.
    struct DepartedParticle
    {
        int id;
        Foam::label outlet;
        double mass;
        Vector3d velocity;
    };

    PartWithin partOf(const ParticlesView& particles, Eigen::Index particle, double couplingTimeStep) const;

    const ParticleOutlets outlets_;
    const double insertionTime_;
    double couplingTimeStep_;
    ParticleTransfer lastInserted_;
    std::vector<ParticleTransfer> lastDeparted_;
    double netVolume_ = 0;
    std::vector<DepartedParticle> departed_;
};

} // namespace clepsydra
