#pragma once

#include "functionObjects/hopperCylinder.h"
#include "functionObjects/trailingRate.h"
#include "runTimeSelection.h"

#include "fvMeshFunctionObject.H"
#include "writeFile.H"

#include <memory>

namespace clepsydra
{

/// Function object: the particles in the hopper over time.
///
///     massInHopper
///     {
///         type                massInHopper;
///         patch               hopper;     // the hopper's wall
///         axis                (0 0 1);    // upwards; default (0 0 1)
///         sampleInterval      0.01;       // s; rows are at most that far apart. Default: a row per execution
///         rateWindow          0.1;        // s; the rate is the mean over that time. Default 0.1
///         stopWhenFlowStops   1;          // s; optional: ends the run, with its fields written, when particles have left
///                                         // and then none has for so long
///     }
///
/// Writes postProcessing/<name>/<startTime>/<name>.dat: time [s], mass [kg], particles [-], rate [kg/s] (positive when
/// the hopper empties). Which particles are in the hopper: see HopperCylinder. A restart continues in a folder of its
/// own start time, with the rows that it would have written had it not been stopped.
///
/// FatalIOError where the mesh has no such patch (its patches are listed) or an entry is out of range.
class MassInHopper : public Foam::functionObjects::fvMeshFunctionObject, public Foam::functionObjects::writeFile
{
public:
    TypeName("massInHopper");

    MassInHopper(const Foam::word& name, const Foam::Time& time, const Foam::dictionary& dict);

    bool read(const Foam::dictionary& dict) override;

    /// Adds a row where one is due. Collective.
    bool execute() override;

    /// Nothing: rows are written when they are taken.
    bool write() override
    {
        return true;
    }

    /// Adds the last row. Collective.
    bool end() override;

    /// Particles in the hopper as last counted by the function object of this type in `functions`, over all ranks;
    /// -1 where there is none or it has not counted yet. Local.
    static Foam::label lastCount(const Foam::Time& time);

private:
    /// Takes up the state that the checkpoint holds, if there is one.
    /// \param rowsThatStay  in tables of earlier start times
    void resume(Foam::label rowsThatStay);
    void sample();
    void stopIfFlowStopped();

    std::unique_ptr<HopperCylinder> hopper_;
    std::unique_ptr<TrailingRate> rate_;
    Foam::scalar sampleInterval_ = 0;
    Foam::scalar stopAfter_ = 0;
    Foam::scalar lastSample_ = -Foam::GREAT;
    Foam::label lastParticles_ = -1;
    /// In all tables, since the fresh start.
    Foam::label rows_ = 0;
    bool stopping_ = false;
};

} // namespace clepsydra
