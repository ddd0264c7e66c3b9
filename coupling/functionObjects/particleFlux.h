#pragma once

#include "runTimeSelection.h"
#include "insertionAndRemoval/insertionAndRemoval.h"

#include "fvMeshFunctionObject.H"
#include "writeFile.H"

#include <vector>

namespace clepsydra
{

/// Function object: the particles that have been inserted and that have left through each of `particleOutlets`.
///
///     particleFlux
///     {
///         type            particleFlux;
///         sampleInterval  0.01;       // s; rows are that far apart. Default: a row per time step
///     }
///
/// Writes postProcessing/<name>/<startTime>/<name>.dat: time [s], then for the particles inserted and for each outlet
/// their number, mass [kg] and momentum [N s] since the fresh start of the run, and the mean rate [kg/s] since the row
/// before. A restart continues in a folder of its own start time, and goes on counting. It looks at every time step, so it
/// has no executeControl: what leaves between two looks would not be in a checkpoint.
///
/// FatalIOError where an entry is out of range, and where `particleOutlets` is another than before a restart.
class ParticleFlux : public Foam::functionObjects::fvMeshFunctionObject, public Foam::functionObjects::writeFile
{
public:
    TypeName("particleFlux");

    ParticleFlux(const Foam::word& name, const Foam::Time& time, const Foam::dictionary& dict);

    bool read(const Foam::dictionary& dict) override;

    /// Adds a row where one is due.
    bool execute() override;

    /// Nothing: rows are written when they are taken.
    bool write() override
    {
        return true;
    }

    /// Adds the last row.
    bool end() override;

private:
    const InsertionAndRemoval& insertionAndRemoval() const;
    /// Before any table is touched.
    void requireSameOutlets() const;
    /// Adds the last interval's. Interval by interval: the sums of a resumed run are those of one never stopped.
    void count();
    /// Takes up what the checkpoint holds, if there is one.
    /// \param rowsThatStay  in tables of earlier start times
    void resume(Foam::label rowsThatStay);
    void storeState();
    void sample();
    void writeRow();

    Foam::scalar sampleInterval_ = 0;
    /// Inserted first, then outlet by outlet.
    std::vector<ParticleTransfer> transfers_;
    Foam::scalar lastCount_ = -Foam::GREAT;
    Foam::scalar lastSample_ = -Foam::GREAT;
    Foam::string lastRow_;
    /// Masses at that time.
    std::vector<double> lastMasses_;
    /// In all tables, since the fresh start.
    Foam::label rows_ = 0;
};

} // namespace clepsydra
