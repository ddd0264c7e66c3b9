#pragma once

#include "runTimeSelection.h"
#include "vectors.h"

#include "fvMeshFunctionObject.H"
#include "writeFile.H"

namespace clepsydra
{

/// Function object: where one particle is along an axis, and how fast it moves there.
///
///     particleHeight
///     {
///         type    particleHeight;
///         particle    1;          // its id; default 1
///         axis    (0 0 1);    // upwards; default (0 0 1)
///         stopBelow 0.06;     // height at which the run writes a checkpoint and ends [m]; default: none
///     }
///
/// Writes postProcessing/<name>/<startTime>/<name>.dat: time [s], height of the centre [m], velocity [m/s], a row per
/// execution (executeControl, executeInterval, and `writeControl none`: OpenFOAM executes before each write) and one at the
/// fresh start, until the particle has left. A restart continues in a folder of its own start time, with the rows that it would
/// have written had it not been stopped.
///
/// FatalIOError where there is no such particle at a fresh start, or the axis is zero.
class ParticleHeight : public Foam::functionObjects::fvMeshFunctionObject, public Foam::functionObjects::writeFile
{
public:
    TypeName("particleHeight");

    ParticleHeight(const Foam::word& name, const Foam::Time& time, const Foam::dictionary& dict);

    bool read(const Foam::dictionary& dict) override;

    /// Adds a row. Collective.
    bool execute() override;

    /// Nothing: rows are written when they are taken.
    bool write() override
    {
        return true;
    }

private:
    /// Takes up the state that the checkpoint holds, if there is one.
    /// \param rowsThatStay  in tables of earlier start times
    /// \return whether a row of the start time is due: at a fresh start, or where there was one and is to be written again
    bool resume(Foam::label rowsThatStay);
    void sample();

    Foam::label particle_ = 1;
    Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();
    Foam::scalar stopBelow_ = -Foam::GREAT;
    bool hasLeft_ = false;
    /// In all tables, since the fresh start.
    Foam::label rows_ = 0;
};

} // namespace clepsydra
