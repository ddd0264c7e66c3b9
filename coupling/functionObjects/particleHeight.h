#pragma once

#include "runTimeSelection.h"
#include "vectors.h"

#include "fvMeshFunctionObject.H"
#include "writeFile.H"

namespace clepsydra
{

/// Function object: the position of one particle along an axis, and its velocity in that direction.
///
///     particleHeight
///     {
///         type        particleHeight;
///         particle    1;          // its id; default 1
///         axis        (0 0 1);    // upwards; default (0 0 1)
///         stopBelow   0.06;       // height below which the run writes a checkpoint and ends [m]; default: none
///     }
///
/// Where space is periodic along the axis, the height goes on beyond the ends of the box.
///
/// Writes postProcessing/<name>/<startTime>/<name>.dat: time [s], height of the centre [m], velocity [m/s]. There is
/// one row at the fresh start and one per execution until the particle has left. Set executeControl, executeInterval
/// and `writeControl none`, because OpenFOAM executes function objects before each write, too. A resumed run continues
/// in a folder of its own start time, with the same rows as an uninterrupted run.
///
/// FatalIOError where the particle does not exist at a fresh start, and where the axis is zero.
class ParticleHeight : public Foam::functionObjects::fvMeshFunctionObject, public Foam::functionObjects::writeFile
{
public:
    TypeName("particleHeight");

    ParticleHeight(const Foam::word& name, const Foam::Time& time, const Foam::dictionary& dict);

    bool read(const Foam::dictionary& dict) override;

    /// Adds a row. Collective.
    bool execute() override;

    /// Does nothing, because execute() writes the rows.
    bool write() override
    {
        return true;
    }

private:
    /// Restores the state from a checkpoint, if there is one.
    /// \param rowsThatStay  number of rows in tables of earlier start times
    /// \return whether a row of the start time is due: at a fresh start, and where that row has been removed and must
    /// be written again
    bool resume(Foam::label rowsThatStay);
    void sample();

    Foam::label particle_ = 1;
    Eigen::Vector3d axis_ = Eigen::Vector3d::UnitZ();
    Foam::scalar stopBelow_ = -Foam::GREAT;
    bool hasLeft_ = false;
    /// Number of rows in all tables since the fresh start.
    Foam::label rows_ = 0;
};

} // namespace clepsydra
