#pragma once

#include "runTimeSelection.h"
#include "insertionAndRemoval/insertionAndRemoval.h"

#include "fvMeshFunctionObject.H"
#include "writeFile.H"

#include <vector>

namespace clepsydra
{

/// Function object: the particles that have been inserted, and those that have left through each of the
/// `particleOutlets`.
///
///     particleFlux
///     {
///         type            particleFlux;
///         sampleInterval  0.01;       // time between rows [s]; default: a row per time step
///     }
///
/// Writes postProcessing/<name>/<startTime>/<name>.dat: time [s], then for the inserted particles and for each outlet
/// their number, mass [kg] and momentum [N s] since the fresh start of the run, and the mean rate [kg/s] since the
/// previous row. A resumed run continues in a folder of its own start time and continues to count. The function object
/// is executed in every time step and has no executeControl, because particles that leave between two executions would
/// be missing in a checkpoint.
///
/// FatalIOError where an entry is out of range, and where `particleOutlets` has changed since the fresh start.
class ParticleFlux : public Foam::functionObjects::fvMeshFunctionObject, public Foam::functionObjects::writeFile
{
public:
    TypeName("particleFlux");

    ParticleFlux(const Foam::word& name, const Foam::Time& time, const Foam::dictionary& dict);

    bool read(const Foam::dictionary& dict) override;

    /// Adds a row where one is due.
    bool execute() override;

    /// Does nothing, because execute() writes the rows.
    bool write() override
    {
        return true;
    }

    /// Adds the last row.
    bool end() override;

private:
    const InsertionAndRemoval& insertionAndRemoval() const;
    /// FatalIOError where the outlets differ from those in the checkpoint. Called before any table is changed.
    void requireSameOutlets() const;
    /// Adds the transfers of the last coupling step, so that the sums of a resumed run are those of an uninterrupted
    /// one.
    void count();
    /// Restores the state from a checkpoint, if there is one.
    /// \param rowsThatStay  number of rows in tables of earlier start times
    void resume(Foam::label rowsThatStay);
    void storeState();
    void sample();
    void writeRow();

    Foam::scalar sampleInterval_ = 0;
    /// Transfers since the fresh start: the inserted particles first, then one entry per outlet.
    std::vector<ParticleTransfer> transfers_;
    Foam::scalar lastCount_ = -Foam::GREAT;
    Foam::scalar lastSample_ = -Foam::GREAT;
    Foam::string lastRow_;
    /// Masses at the time of the last row [kg].
    std::vector<double> lastMasses_;
    /// Number of rows in all tables since the fresh start.
    Foam::label rows_ = 0;
};

} // namespace clepsydra
