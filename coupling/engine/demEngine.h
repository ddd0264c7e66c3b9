#pragma once

#include "engine/particles.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace clepsydra
{

/// An error that the engine reports; the message names the script, the line and the cause where there is one.
class DemEngineError : public std::runtime_error
{
public:
    using std::runtime_error::runtime_error;
};

/// Gives the force of the fluid on the particles at one DEM step. Implemented by the coupling, called by the engine.
class FluidForces
{
public:
    virtual ~FluidForces() = default;

    /// \param particles  the particles of this rank as they are now; `particles.otherForce` is the sum of all other forces of this
    ///               step, `particles.state` the coupling's own, to read and to write
    /// \param timeStep  DEM step [s]
    /// \param force  3 x particles.size(), overwritten with the force on each particle [N]
    virtual void evaluate(const ParticlesView& particles, double timeStep, Vectors force) = 0;
};

/// What the time scales of the contacts depend on, one entry per material of the engine's script.
struct ContactMaterial
{
    double youngsModulus;
    double poissonRatio;
};

/// A discrete-element program that advances particles and their contacts, in the same process.
///
/// Life: constructed (its script has run) -> initialise() once -> advance() any number of times -> destroyed.
/// All members are collective over the ranks unless marked local. Any may throw DemEngineError; after that only
/// ending the program is safe.
class DemEngine
{
public:
    DemEngine() = default;
    DemEngine(const DemEngine&) = delete;
    DemEngine& operator=(const DemEngine&) = delete;
    virtual ~DemEngine() = default;

    /// Asks for ParticlesView::pairs: at every step at least all pairs of particles whose surfaces are closer than
    /// `reach` times the sum of their radii. \pre not yet initialised, reach > 0.
    virtual void requestPairs(double reach) = 0;

    /// Asks for ParticlesView::state. \pre not yet initialised.
    /// \param ofNewParticle  the numbers of the state of particles that are read, made or inserted
    virtual void requestState(const std::vector<double>& ofNewParticle) = 0;

    /// Asks for ParticlesView::memory: so many numbers per particle, zero for a new particle, that travel with it and are part of
    /// checkpoints. \pre not yet initialised, numbers > 0.
    virtual void requestMemory(int numbers) = 0;

    /// Makes the engine ready to advance.
    /// \pre  not yet initialised. \post particles() is valid; each particle has the state of a new one and, until evaluateFluidForces(), no
    ///       force of the fluid but what a checkpoint holds.
    /// \param forces  called at every DEM step until the engine is destroyed; nullptr: no fluid.
    virtual void initialise(FluidForces* forces) = 0;

    /// Advances by `steps` DEM steps; the particles' states change by FluidForces only.
    /// \pre  initialised, steps > 0. \post earlier views are invalid.
    virtual void advance(int steps) = 0;

    /// Makes neighbour lists again from the particles as they stand, as if this process had just been resumed from a checkpoint
    /// written now. Forces stay those of the last step, with which the next one begins.
    /// \pre initialised. \post views are invalid.
    virtual void prepare() = 0;

    /// As prepare(), but forces are made again, the fluid's from the particles' states as they stand: those with which the first
    /// step of a run begins. \pre initialised with forces. \post views are invalid.
    virtual void evaluateFluidForces() = 0;

    /// Takes particles out, from wherever they are. \pre initialised. \post views are invalid; prepare() must follow.
    /// \param ids  of this rank's particles
    virtual void remove(const std::vector<int>& ids) = 0;

    /// Local: the particles of this rank. \pre initialised.
    virtual ParticlesView particles() = 0;

    /// Local: the DEM step [s].
    virtual double timeStep() const = 0;

    /// Local: gravity as the engine's script states it [m/s2].
    virtual Vector3d gravity() const = 0;

    /// Local: contact materials, empty where the script states none.
    virtual std::vector<ContactMaterial> contactMaterials() const = 0;

    /// Writes everything the engine needs to go on as if never stopped. The files are complete when this returns.
    /// \param name  a file, through which the first rank writes what all send to it; or, with a `%` in it, a file for each
    ///              rank, whose number takes the place of `%`, and one with `base` there: no rank gets the others' particles
    /// \return those that this rank has written
    /// \pre initialised. \throws FileError where one cannot be written, on the rank that writes it.
    virtual std::vector<std::filesystem::path> writeCheckpoint(const std::filesystem::path& name) = 0;

    /// Local: name and version of the engine.
    virtual std::string version() const = 0;
};

} // namespace clepsydra
