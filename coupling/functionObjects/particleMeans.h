#pragma once

#include "functionObjects/particleBins.h"
#include "runTimeSelection.h"

#include "fvMeshFunctionObject.H"
#include "writeFile.H"

#include <memory>

namespace clepsydra
{

/// Function object: means over time and over the particles in bins of space.
///
///     particleMeans
///     {
///         type                particleMeans;
///         binSize             (8e-3 1 8e-3);              // [m]; a size that exceeds the box gives one bin
///         box                 (-0.1 0 0) (0.1 0.04 0.3);  // default: the box around the mesh at the start
///         timeStart           2;                          // OpenFOAM's; default: from the first time step on
///         executeInterval     10;                         // time steps from one sample to the next; default 1
///     }
///
/// Writes postProcessing/<name>/<startTime>/<name>.dat at the write times of the fields. One row per bin that has held
/// particles: time [s], centre of the bin [m], number of sampled times, number of particles counted at them, their mean
/// speed and its standard deviation [m/s], their mean velocity [m/s], and the mean solid volume over the bin's volume.
/// All numbers are those since the first sample. A particle is in the bin in which its centre is. The sums are part of
/// checkpoints (uniform/functionObjects/<name>), so a resumed run writes the same rows as an uninterrupted one.
///
/// FatalIOError where an entry is out of range, and where the bins differ from those of the checkpoint.
class ParticleMeans : public Foam::functionObjects::fvMeshFunctionObject, public Foam::functionObjects::writeFile
{
public:
    TypeName("particleMeans");

    ParticleMeans(const Foam::word& name, const Foam::Time& time, const Foam::dictionary& dict);
    ~ParticleMeans() override;

    bool read(const Foam::dictionary& dict) override;

    /// Adds a sample where one is due. Collective.
    bool execute() override;

    /// Writes the rows at write times of the fields.
    bool write() override;

private:
    class StoredSums;

    /// Quantities that are summed in each bin.
    enum Sum : Eigen::Index
    {
        particleCount,
        speed,
        squaredSpeed,
        velocity,
        solidVolume = velocity + 3,
        sumCount
    };

    /// Restores the sums from a checkpoint, if there are any. Called before any table is changed.
    void resume(const Foam::dictionary& dict);
    /// FatalIOError where the bins of the dictionary are not those of the samples that have been taken.
    void requireSameBins(const Foam::dictionary& dict, const ParticleBins& before) const;
    void sample();
    void writeRows();
    /// The state that checkpoints hold.
    Foam::dictionary state() const;

    std::unique_ptr<ParticleBins> bins_;
    /// Whether they divide the box around the mesh, as it was at the start of the run.
    bool aroundMesh_ = false;
    Foam::label executeInterval_ = 1;
    /// One column per bin, over all ranks, the same on each.
    Eigen::ArrayXXd sums_;
    Foam::label sampledTimes_ = 0;
    Foam::label lastSampledStep_ = -1;
    Foam::scalar timeOfLastRows_ = -Foam::GREAT;
    /// Numbers of rows: of the last time, and in all tables since the fresh start.
    Foam::label lastRows_ = 0;
    Foam::label rows_ = 0;
    std::unique_ptr<StoredSums> stored_;
};

} // namespace clepsydra
