#include "functionObjects/particleFlux.h"

#include "functionObjects/observableTable.h"
#include "modelLines.h"
#include "tokens/exactText.h"

#include "Time.H"
#include "addToRunTimeSelectionTable.H"
#include "fvMesh.H"
#include "OStringStream.H"
#include "stringList.H"

#include <sstream>

namespace clepsydra
{

defineTypeNameAndDebug(ParticleFlux, 0);
addToRunTimeSelectionTable(functionObject, ParticleFlux, dictionary);
static const ModelLines lines("functions { type }",
    {{ParticleFlux::typeName_(), "number, mass, momentum and rate of particles inserted or leaving"}});

namespace
{

/// The state in checkpoints: names of the outlets; one text per transfer; time of the last row with the masses at that
/// time, and the row itself. They are text because OpenFOAM would write numbers with the precision of the fields.
const word outletsEntry = "outlets";
const word transfersEntry = "transfers";
const word lastSampleEntry = "lastSample";
const word lastRowEntry = "lastRow";
const word rowsEntry = "rows";

template<class... Numbers>
std::string textOf(const Numbers&... numbers)
{
    return ((exactText(static_cast<double>(numbers)) + ' ') + ...);
}

} // namespace

ParticleFlux::ParticleFlux(const word& name, const Time& time, const dictionary& dict)
    : fvMeshFunctionObject(name, time, dict),
      writeFile(mesh_, name, name)
{
    // The file is created after all checks, because one that is left by a wrong entry would make OpenFOAM write the
    // next run's file under another name.
    ParticleFlux::read(dict);
    requireSameOutlets();
    const label rowsThatStay = makeRoomFrom(time.value(), time.globalPath() / outputPrefix / name, name + ".dat");
    resetFile(name);

    wordList columns({"inserted"});
    columns.append(insertionAndRemoval().outlets());
    Ostream& os = file();
    writeHeader(
        os, "Inserted particles, and particles that left through " + std::to_string(columns.size() - 1) + " outlets");
    writeCommented(os, "time [s]");
    for (const word& column : columns)
    {
        for (const char* quantity : {" particles [-]", " mass [kg]", " momentum x [N s]", " momentum y [N s]",
                 " momentum z [N s]", " rate [kg/s]"})
        {
            writeTabbed(os, column + quantity);
        }
    }
    os << endl;

    transfers_.resize(static_cast<std::size_t>(columns.size()));
    lastMasses_.resize(transfers_.size());
    resume(rowsThatStay);
    // OpenFOAM executes function objects only after the first step, but the table should begin at the start time.
    if (lastSample_ < 0)
    {
        sample();
    }
    lastCount_ = time_.value();
}

const InsertionAndRemoval& ParticleFlux::insertionAndRemoval() const
{
    return mesh_.lookupObject<InsertionAndRemoval>(InsertionAndRemoval::registryName);
}

void ParticleFlux::requireSameOutlets() const
{
    wordList before;
    if (getProperty(outletsEntry, before) && before != insertionAndRemoval().outlets())
    {
        FatalIOError(FUNCTION_NAME, __FILE__, __LINE__, time_.globalPath() / time_.constant() / "couplingProperties")
            << "Entry 'particleOutlets' is " << flatOutput(insertionAndRemoval().outlets()) << ", but it was "
            << flatOutput(before) << " when " << name()
            << " began to count; allowed: the same as before, because its totals are those since the fresh "
            << "start, or another name for " << name() << " in system/controlDict, under which it begins at 0"
            << exit(FatalIOError);
    }
}

void ParticleFlux::resume(label rowsThatStay)
{
    stringList transfers;
    string lastSample;
    // Checkpoints of earlier versions do not contain the names of the outlets, so only their number can be compared.
    if (!getProperty(transfersEntry, transfers) || !getProperty(lastSampleEntry, lastSample)
        || !getProperty(lastRowEntry, lastRow_) || transfers.size() != static_cast<label>(transfers_.size()))
    {
        return;
    }
    for (std::size_t i = 0; i < transfers_.size(); ++i)
    {
        ParticleTransfer& transfer = transfers_[i];
        std::istringstream text(transfers[static_cast<label>(i)]);
        text >> transfer.particles >> transfer.mass >> transfer.momentum.x() >> transfer.momentum.y()
            >> transfer.momentum.z();
    }
    std::istringstream text(lastSample);
    text >> lastSample_;
    for (double& mass : lastMasses_)
    {
        text >> mass;
    }
    getProperty(rowsEntry, rows_);
    const bool rewritesRow = isRowOfNow(time_, lastSample_);
    warnOfLostRows(rowsThatStay, rewritesRow ? rows_ - 1 : rows_, name() + ".dat");
    if (rewritesRow)
    {
        writeRow();
    }
}

bool ParticleFlux::read(const dictionary& dict)
{
    fvMeshFunctionObject::read(dict);
    writeFile::read(dict);
    requireKnownEntries(
        dict, {"type", "libs", "enabled", "log", "region", "writePrecision", "sampleInterval", "useUserTime"});
    sampleInterval_ = dict.found("sampleInterval") ? positiveEntry(dict, "sampleInterval") : 0;
    return true;
}

bool ParticleFlux::execute()
{
    count();
    if (isRowDue(time_, lastSample_, sampleInterval_))
    {
        sample();
    }
    storeState();
    return true;
}

bool ParticleFlux::end()
{
    count();
    sample();
    storeState();
    return true;
}

void ParticleFlux::count()
{
    if (time_.value() <= lastCount_)
    {
        return;
    }
    lastCount_ = time_.value();
    transfers_.front() += insertionAndRemoval().lastInserted();
    const std::vector<ParticleTransfer>& left = insertionAndRemoval().lastDeparted();
    for (std::size_t outlet = 0; outlet < left.size(); ++outlet)
    {
        transfers_[outlet + 1] += left[outlet];
    }
}

void ParticleFlux::sample()
{
    const scalar now = time_.value();
    if (now <= lastSample_)
    {
        return;
    }
    OStringStream row;
    row.precision(file().precision());
    writeCurrentTime(row);
    for (std::size_t i = 0; i < transfers_.size(); ++i)
    {
        const scalar rate = lastSample_ < 0 ? 0 : (transfers_[i].mass - lastMasses_[i]) / (now - lastSample_);
        const vector& momentum = transfers_[i].momentum;
        row << tab << setw(charWidth()) << transfers_[i].particles;
        for (const scalar value : {transfers_[i].mass, momentum.x(), momentum.y(), momentum.z(), rate})
        {
            row << tab << setw(charWidth()) << value;
        }
        lastMasses_[i] = transfers_[i].mass;
    }
    lastRow_ = row.str();
    lastSample_ = now;
    ++rows_;
    writeRow();
}

void ParticleFlux::writeRow()
{
    Ostream& os = file();
    os << lastRow_.c_str() << endl;
    requireWritten(os);
}

void ParticleFlux::storeState()
{
    stringList texts;
    std::string lastSample = textOf(lastSample_);
    for (const ParticleTransfer& transfer : transfers_)
    {
        const vector& momentum = transfer.momentum;
        texts.append(textOf(transfer.particles, transfer.mass, momentum.x(), momentum.y(), momentum.z()));
    }
    for (const double mass : lastMasses_)
    {
        lastSample += textOf(mass);
    }
    setProperty(outletsEntry, insertionAndRemoval().outlets());
    setProperty(transfersEntry, texts);
    setProperty(lastSampleEntry, string(lastSample));
    setProperty(lastRowEntry, lastRow_);
    setProperty(rowsEntry, rows_);
}

} // namespace clepsydra
