#pragma once

#include "engine/periodicBox.h"

#include <cstdint>
#include <array>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace clepsydra
{

/// An error that the engine reports. The message names the script, the line and the cause, where these are known.
class DemEngineError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// Computes the force of the fluid on the particles at one DEM step. The coupling implements it, and the engine calls
/// it.
class FluidForces
{
public:
    virtual ~FluidForces() = default;

    /// \param particles  the particles of this rank at this step; `particles.otherForce` is the sum of all other forces
    /// of this step, and `particles.state` is the coupling's own state, writable
    /// \param timeStep  DEM step [s]
    /// \param force  3 x particles.size(), overwritten with the force on each particle [N]
    virtual void evaluate(const ParticlesView& particles, double timeStep, Vectors force) = 0;
};

/// Properties of a material on which the time scales of contacts depend, one entry per material of the engine's script.
struct ContactMaterial
{
    double youngsModulus;
    double poissonRatio;
};

/// A triangle of a wall that the engine moves.
struct WallTriangle
{
    std::string wall; ///< name of the wall
    int id;           ///< within the wall
    std::array<Vector3d, 3> corners;
};

/// A file to which the engine appends while it runs.
struct EngineOutput
{
    std::filesystem::path file;
    std::uintmax_t size = 0;
};

/// A discrete-element program that advances particles and their contacts in the same process.
///
/// Life cycle: constructed (its script has run) -> initialise() once -> advance() any number of times -> destroyed. All
/// members are collective over the ranks unless marked local. Any may throw DemEngineError; after that the program can
/// only end.
class DemEngine
{
public:
    DemEngine() = default;
    DemEngine(const DemEngine&) = delete;
    DemEngine& operator=(const DemEngine&) = delete;
    virtual ~DemEngine() = default;

    /// Requests ParticlesView::pairs: at every step at least all pairs of particles whose surfaces are closer than
    /// `reach` times the sum of their radii, and for both the number `ofState` of their states (ParticlePairs::ofState).
    /// \pre not yet initialised, reach > 0, and requestState() is called, too, with more than `ofState` numbers
    virtual void requestPairs(double reach, std::size_t ofState) = 0;

    /// Requests ParticlesView::state. \pre not yet initialised
    /// \param ofNewParticle  the values of the state of a particle that is read, created or inserted
    virtual void requestState(const std::vector<double>& ofNewParticle) = 0;

    /// Requests ParticlesView::memory: this number of values per particle, zero for a new particle. They travel with
    /// the particle and are part of checkpoints. \pre not yet initialised, numbers > 0
    virtual void requestMemory(int numbers) = 0;

    /// Makes the engine ready to advance.
    /// \pre not yet initialised
    /// \post particles() is valid. Each particle has the state of a new one; until evaluateFluidForces() is called, no
    /// force of the fluid acts on it except the one that a checkpoint holds.
    /// \param forces  called at every DEM step until the engine is destroyed; nullptr for no fluid
    virtual void initialise(FluidForces* forces) = 0;

    /// Advances by `steps` DEM steps. The particles' states are only changed by FluidForces.
    /// \pre initialised, steps > 0
    /// \post earlier views are invalid
    virtual void advance(int steps) = 0;

    /// Rebuilds the neighbour lists from the particles' present positions, as a process does that has just been resumed
    /// from a checkpoint written now. The forces remain those of the last step, with which the next one begins.
    /// \pre initialised
    /// \post earlier views are invalid
    virtual void prepare() = 0;

    /// As prepare(), but all forces are recomputed, the fluid's from the particles' present states: these are the
    /// forces with which the first step of a run begins.
    /// \pre initialised with forces
    /// \post earlier views are invalid
    virtual void evaluateFluidForces() = 0;

    /// Removes particles, whatever their positions.
    /// \pre initialised
    /// \post earlier views are invalid, and prepare() must be called
    /// \param ids  of this rank's particles
    virtual void remove(const std::vector<int>& ids) = 0;

    /// The particles of this rank. Local. \pre initialised
    virtual ParticlesView particles() = 0;

    /// The DEM step [s]. Local.
    virtual double timeStep() const = 0;

    /// Gravity as the engine's script states it, the sum where it does so several times [m/s2]. Local.
    virtual Vector3d gravity() const = 0;

    /// The directions in which the particles' space is periodic. Local.
    virtual PeriodicBox periodicBox() const
    {
        return {};
    }

    /// Position of a particle of this rank as if the engine had never moved it by a length of the periodic box [m], so
    /// that it is continuous in time. Local. \pre initialised
    virtual Vector3d unwrappedPosition(Eigen::Index particle)
    {
        return particles().position.col(particle);
    }

    /// The triangles of this rank of all walls that the engine moves, where they are now. Each triangle is on one rank. Local.
    virtual std::vector<WallTriangle> movingWalls() const
    {
        return {};
    }

    /// Contact materials; empty where the script states none. Local.
    virtual std::vector<ContactMaterial> contactMaterials() const = 0;

    /// Writes all state from which a resumed run gives the same results as an uninterrupted one. The files are complete
    /// when this returns.
    /// \param name  one file, which the first rank writes with the data of all ranks; or, with a `%` in it, one file
    /// per rank, whose number replaces `%`, and one file with `base` in its place, so that no rank receives the
    /// particles of others
    /// \return the files that this rank has written
    /// \pre initialised
    /// \throws FileError where a file cannot be written, on the rank that writes it
    virtual std::vector<std::filesystem::path> writeCheckpoint(const std::filesystem::path& name) = 0;

    /// Name and version of the engine. Local.
    virtual std::string version() const = 0;

    /// The files to which this rank's engine appends while it runs, as the script's dumps and tables, with all that was
    /// written so far in them. A resumed engine continues them from this size on, so that nothing is in them twice.
    /// \throws FileError where something that the engine wrote by itself did not get into its file
    virtual std::vector<EngineOutput> outputs()
    {
        return {};
    }
};

} // namespace clepsydra
