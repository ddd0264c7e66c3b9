#include "functionObjects/beadHeight.h"

#include "functionObjects/observableTable.h"
#include "functionObjects/observedBeads.h"
#include "modelLines.h"
#include "words/exactText.h"

#include "Time.H"
#include "addToRunTimeSelectionTable.H"
#include "fvMesh.H"

namespace clepsydra
{

defineTypeNameAndDebug(BeadHeight, 0);
addToRunTimeSelectionTable(functionObject, BeadHeight, dictionary);
static const ModelLines lines("functions { type }", {{BeadHeight::typeName_(), "height and velocity of one bead"}});

namespace
{

/// As text: OpenFOAM would write the number with the fields' digits.
const word lastRowEntry = "lastRow";
const word rowsEntry = "rows";

} // namespace

BeadHeight::BeadHeight(const word& name, const Time& time, const dictionary& dict)
    : fvMeshFunctionObject(name, time, dict),
      writeFile(mesh_, name, name)
{
    // Only then the file: one left behind by a wrong entry would make OpenFOAM write the next run's elsewhere.
    BeadHeight::read(dict);
    const label rowsThatStay = makeRoomFrom(time.value(), time.globalPath() / outputPrefix / name, name + ".dat");
    resetFile(name);

    Ostream& os = file();
    writeHeader(os, "Bead " + Foam::name(bead_));
    writeHeaderValue(os, "Axis", toFoam(axis_));
    writeCommented(os, "time [s]");
    writeTabbed(os, "height [m]");
    writeTabbed(os, "velocity [m/s]");
    os << endl;

    // OpenFOAM executes function objects after the first step only; the curve should start at the start.
    if (resume(rowsThatStay) && mesh_.foundObject<ObservedBeads>(ObservedBeads::registryName))
    {
        sample();
    }
}

bool BeadHeight::resume(label rowsThatStay)
{
    string lastRow;
    if (!getProperty(lastRowEntry, lastRow))
    {
        return true;
    }
    getProperty(rowsEntry, rows_);
    const bool again = isRowOfNow(time_, std::stod(lastRow));
    rows_ -= again ? 1 : 0;
    warnOfLostRows(rowsThatStay, rows_, name() + ".dat");
    return again;
}

bool BeadHeight::read(const dictionary& dict)
{
    fvMeshFunctionObject::read(dict);
    writeFile::read(dict);
    requireKnownEntries(dict, functionObjectEntries({"bead", "axis", "stopBelow"}));

    const auto axis = dict.getOrDefault<vector>("axis", vector(0, 0, 1));
    if (mag(axis) < SMALL)
    {
        FatalIOErrorInFunction(dict) << "Entry 'axis' is " << axis << "; allowed: a vector that is not zero"
                                     << exit(FatalIOError);
    }
    axis_ = toEigen(axis).normalized();

    stopBelow_ = dict.getOrDefault<scalar>("stopBelow", -GREAT);
    bead_ = dict.getOrDefault<label>("bead", 1);
    gone_ = false;
    // Later, and in a resumed run, it may have left.
    if (time_.timeIndex() == 0 && mesh_.foundObject<ObservedBeads>(ObservedBeads::registryName))
    {
        const BeadsView beads = mesh_.lookupObject<ObservedBeads>(ObservedBeads::registryName).beads();
        if (!returnReduce((beads.id == bead_).any(), orOp<bool>()))
        {
            FatalIOErrorInFunction(dict) << "Entry 'bead' is " << bead_ << "; allowed: the id of one of the "
                                         << returnReduce(label(beads.size()), sumOp<label>()) << " beads"
                                         << exit(FatalIOError);
        }
    }
    return true;
}

bool BeadHeight::execute()
{
    sample();
    return true;
}

void BeadHeight::sample()
{
    // One rank has the bead, the others add nothing.
    scalar height = 0;
    scalar velocity = 0;
    bool found = false;
    const BeadsView beads = mesh_.lookupObject<ObservedBeads>(ObservedBeads::registryName).beads();
    for (Eigen::Index i = 0; i < beads.size(); ++i)
    {
        if (beads.id[i] == bead_)
        {
            height = axis_.dot(beads.position.col(i));
            velocity = axis_.dot(beads.velocity.col(i));
            found = true;
        }
    }
    reduce(found, orOp<bool>());
    if (!found)
    {
        if (!gone_)
        {
            Info << name() << ": bead " << bead_ << " is no longer there, no more rows" << endl;
        }
        gone_ = true;
        return;
    }
    reduce(height, sumOp<scalar>());
    reduce(velocity, sumOp<scalar>());

    Ostream& os = file();
    writeCurrentTime(os);
    os << tab << setw(charWidth()) << height << tab << setw(charWidth()) << velocity << endl;
    requireWritten(os);
    setProperty(lastRowEntry, string(exactText(time_.value())));
    setProperty(rowsEntry, ++rows_);

    if (height < stopBelow_)
    {
        Info << name() << ": bead " << bead_ << " is below " << stopBelow_ << " m: the run ends" << endl;
        time_.stopAt(Time::saWriteNow);
    }
}

} // namespace clepsydra
