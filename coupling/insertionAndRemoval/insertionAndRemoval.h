#pragma once

#include "engine/demEngine.h"
#include "engine/periodicBox.h"
#include "insertionAndRemoval/particleOutlets.h"
#include "rankTotals.h"

#include "regIOobject.H"

#include <functional>
#include <vector>

namespace clepsydra
{

/// Particles that were inserted or left through an outlet, as sums over all ranks since this process started or over
/// one coupling step.
struct ParticleTransfer
{
    Foam::label particles = 0;
    double mass = 0;                            // [kg]
    Foam::vector momentum = Foam::vector::zero; // [N s], when they were inserted or left
    /// Volume [m3]. It includes the parts of particles that are still being inserted or are leaving, before these are
    /// counted in `particles`.
    double volume = 0;

    ParticleTransfer& operator+=(const ParticleTransfer& other);
};

/// Whether each particle of this rank is in no cell of the mesh, at the position that its state holds. Collective.
using FindOutsideMesh = std::function<std::vector<bool>()>;

/// Insertion and removal of particles: the submerged fraction of each particle, the particles that have left, and their
/// balances.
///
///     particleOutlets  (floor outlet);    // see ParticleOutlets; default: none
///     insertionTime    0.02;              // [s], duration of the insertion ramp; default: ten coupling steps
///
/// A particle that crosses an outlet leaves the fluid in proportion to the part of its sphere beyond the outlet; it is
/// removed from the engine when all of it is there. The volume of a particle that the engine's script inserts during
/// the run enters the fluid within insertionTime: the fraction is 3 r2 - 2 r3 at the fraction r of that time. In
/// neither case does the rate of the void fraction jump. No fluid force acts on the part of a particle that is not in
/// the fluid.
///
/// Where particles may be in parts of the DEM box without mesh, such a particle is not in the fluid, and nothing else
/// happens to it. Its volume leaves the fluid at once when its centre is farther behind a wall of the mesh than its
/// radius, and enters it again within insertionTime when its centre is back in a cell.
///
/// The object is registered with the mesh's database under the name "insertionAndRemoval", for function objects.
class InsertionAndRemoval : public Foam::regIOobject
{
public:
    static constexpr const char* registryName = "insertionAndRemoval";

    /// FatalIOError where an entry is out of range.
    /// \param periodic  directions in which the particles have images
    InsertionAndRemoval(const Foam::dictionary& couplingProperties, const Foam::fvMesh& mesh, double couplingTimeStep,
        const PeriodicBox& periodic = {});

    /// Determines the submerged fraction of the particles at the start, without recording insertions. Collective.
    /// \param freshStart  true where no particle is being inserted; otherwise the engine's checkpoint holds each
    /// particle's insertion ramp
    /// \param findOutsideMesh  null where no particle may be outside the mesh
    /// \return volume of the particles that is in the fluid, over all ranks [m3]
    double start(const ParticlesView& particles, bool freshStart, const FindOutsideMesh& findOutsideMesh = nullptr);

    /// Moves the outlets with the patches of the mesh. Collective where there are outlets.
    void meshMoved(const Foam::fvMesh& mesh)
    {
        outlets_.meshMoved(mesh);
    }

    /// Updates the submerged fractions after the engine has advanced by one coupling step. The balances over all ranks
    /// are updated when the totals are reduced. Local, but collective with `findOutsideMesh`.
    /// \param newFrom  particles with a higher id have been inserted in this coupling step
    /// \param findOutsideMesh  null where no particle may be outside the mesh
    void advance(const ParticlesView& particles, int newFrom, double couplingTimeStep,
        const FindOutsideMesh& findOutsideMesh, RankTotals& totals);

    /// Removes particles that are entirely beyond an outlet from the engine, and records them. Collective where there are
    /// such particles on any rank, otherwise local. \pre the totals of the last advance() have been reduced
    /// \return number of removed particles on all ranks. If it is not zero, views are invalid and DemEngine::prepare()
    /// must be called.
    Foam::label removeDeparted(DemEngine& engine);

    const Foam::wordList& outlets() const
    {
        return outlets_.names();
    }

    /// Number of particles that are outside the mesh, over all ranks.
    Foam::label outsideMesh() const
    {
        return outsideMesh_;
    }

    /// Number of times that a particle has left the mesh since start(), over all ranks. Particles that have left through
    /// an outlet are not counted.
    Foam::label leftMesh() const
    {
        return leftMesh_;
    }

    /// Particles inserted in the last coupling step.
    const ParticleTransfer& lastInserted() const
    {
        return lastInserted_;
    }

    /// Particles that left in the last coupling step, in the order of outlets().
    const std::vector<ParticleTransfer>& lastDeparted() const
    {
        return lastDeparted_;
    }

    /// Solid volume that was inserted less that which has left, since start() [m3].
    double netVolume() const
    {
        return netVolume_;
    }

    bool writeData(Foam::Ostream&) const override
    {
        return true;
    }

private:
    /// A particle of this rank that is entirely beyond an outlet.
    struct DepartedParticle
    {
        int id;
        Foam::label outlet;
        double mass;
        Vector3d velocity;
    };

    /// Sets the part of each particle on the fluid's side of the outlets and of the mesh. Local, but collective with
    /// `findOutsideMesh`. \return number of this rank's particles that are outside the mesh
    Foam::label findParts(
        const ParticlesView& particles, double couplingTimeStep, const FindOutsideMesh& findOutsideMesh);
    PartWithin partOf(const ParticlesView& particles, Eigen::Index particle, double couplingTimeStep) const;
    /// Updates the balances over all ranks. \param totals  of the numbers that advance() adds
    void record(const RankNumbers& totals);

    ParticleOutlets outlets_;
    const PeriodicBox periodic_;
    const double insertionTime_;
    double couplingTimeStep_;
    ParticleTransfer lastInserted_;
    std::vector<ParticleTransfer> lastDeparted_;
    double netVolume_ = 0;
    Foam::label outsideMesh_ = 0;
    Foam::label leftMesh_ = 0;
    std::vector<DepartedParticle> departed_;
    /// Number of particles in `departed_` on all ranks.
    Foam::label departedCount_ = 0;
};

} // namespace clepsydra
