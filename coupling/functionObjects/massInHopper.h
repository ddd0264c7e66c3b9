#pragma once

#include "functionObjects/hopperCylinder.h"
#include "functionObjects/trailingRate.h"
#include "runTimeSelection.h"

#include "fvMeshFunctionObject.H"
#include "writeFile.H"

#include <memory>
#include <vector>

namespace clepsydra
{

/// Function object: mass, number and rate of the particles in a hopper.
///
///     massInHopper
///     {
///         type                massInHopper;
///         patch               hopper;     // the hopper's wall
///         axis                (0 0 1);    // upwards; default (0 0 1)
///         sampleInterval      0.01;       // largest time between rows [s]; default: a row per execution
///         rateWindow          0.1;        // time over which the rate is averaged [s]; default 0.1
///         stopWhenFlowStops   1;          // optional: ends the run with a checkpoint when particles have left and
///                                         // then none has left for this time [s]
///     }
///
/// Writes postProcessing/<name>/<startTime>/<name>.dat: time [s], mass [kg], particles [-], rate [kg/s] (positive while
/// the hopper empties). HopperCylinder defines which particles are in the hopper. A resumed run continues in a folder
/// of its own start time, with the same rows as an uninterrupted run.
///
/// FatalIOError where the mesh has no such patch (the message lists its patches) and where an entry is out of range.
class MassInHopper : public Foam::functionObjects::fvMeshFunctionObject, public Foam::functionObjects::writeFile
{
public:
    TypeName("massInHopper");

    MassInHopper(const Foam::word& name, const Foam::Time& time, const Foam::dictionary& dict);

    bool read(const Foam::dictionary& dict) override;

    /// Adds a row where one is due. At write times it looks for departures in any case, because a resumed run knows of
    /// the particles in the hopper at that time only. Collective.
    bool execute() override;

    /// Does nothing, because execute() writes the rows.
    bool write() override
    {
        return true;
    }

    /// Adds the last row. Collective.
    bool end() override;

    /// Number of particles in the hopper, over all ranks, that the function object of this type in `functions` has
    /// counted last; -1 where there is none or where it has not counted yet. Local.
    static Foam::label lastCount(const Foam::Time& time);

private:
    /// Restores the state from a checkpoint, if there is one.
    /// \param rowsThatStay  number of rows in tables of earlier start times
    void resume(Foam::label rowsThatStay);
    /// The cylinder around a wall, which stays where it was when this wall and axis were first stated. Collective.
    void setHopper(const Foam::polyPatch& wall, const Vector3d& axis);
    void sample();
    void stopIfFlowStopped();
    /// The particles in the hopper: mass [kg] and number of those on this rank, and whether an id of this rank's share is no
    /// longer among them.
    struct Look
    {
        double mass = 0;
        double count = 0;
        bool anyHasLeft = false;
    };
    /// Sets `ids_` to those of the particles that are in the hopper now. Collective.
    Look look();

    std::unique_ptr<HopperCylinder> hopper_;
    std::unique_ptr<TrailingRate> rate_;
    Foam::scalar sampleInterval_ = 0;
    Foam::scalar stopAfter_ = 0;
    Foam::scalar lastSample_ = -Foam::GREAT;
    Foam::label lastParticles_ = -1;
    /// Of the particles in the hopper at the last look, in order. Each rank keeps those whose remainder, divided by the number
    /// of ranks, is its number, wherever the particles are.
    std::vector<Foam::label> ids_;
    /// Number of rows in all tables since the fresh start.
    Foam::label rows_ = 0;
    bool stopping_ = false;
};

} // namespace clepsydra
