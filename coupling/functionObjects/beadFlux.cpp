#include "functionObjects/beadFlux.h"

#include "functionObjects/observableTable.h"
#include "modelLines.h"
#include "words/exactText.h"

#include "Time.H"
#include "addToRunTimeSelectionTable.H"
#include "fvMesh.H"
#include "OStringStream.H"
#include "stringList.H"

#include <sstream>

namespace clepsydra
{

defineTypeNameAndDebug(BeadFlux, 0);
addToRunTimeSelectionTable(functionObject, BeadFlux, dictionary);
static const ModelLines lines(
    "functions { type }", {{BeadFlux::typeName_(), "beads that come in and that leave through outlets"}});

namespace
{

/// The outlets' names; one text per passage; the time of the last row with the masses then, and the row. As text: OpenFOAM
/// would write numbers with the fields' digits.
const word outletsEntry = "outlets";
const word passagesEntry = "passages";
const word lastSampleEntry = "lastSample";
const word lastRowEntry = "lastRow";
const word rowsEntry = "rows";

template<class... Numbers>
std::string textOf(const Numbers&... numbers)
{
    return ((exactText(static_cast<double>(numbers)) + ' ') + ...);
}

} // namespace

BeadFlux::BeadFlux(const word& name, const Time& time, const dictionary& dict)
    : fvMeshFunctionObject(name, time, dict),
      writeFile(mesh_, name, name)
{
    // Only then the file: one left behind by a wrong entry would make OpenFOAM write the next run's elsewhere.
    BeadFlux::read(dict);
    requireSameOutlets();
    const label rowsThatStay = makeRoomFrom(time.value(), time.globalPath() / outputPrefix / name, name + ".dat");
    resetFile(name);

    wordList columns({"inserted"});
    columns.append(traffic().outlets());
    Ostream& os = file();
    writeHeader(os, "Beads inserted, and those that left through " + std::to_string(columns.size() - 1) + " outlets");
    writeCommented(os, "time [s]");
    for (const word& column : columns)
    {
        for (const char* quantity :
            {" beads [-]", " mass [kg]", " momentum x [N s]", " momentum y [N s]", " momentum z [N s]", " rate [kg/s]"})
        {
            writeTabbed(os, column + quantity);
        }
    }
    os << endl;

    passages_.resize(static_cast<std::size_t>(columns.size()));
    lastMasses_.resize(passages_.size());
    resume(rowsThatStay);
    // OpenFOAM executes function objects after the first step only; the curve should start at the start.
    if (lastSample_ < 0)
    {
        sample();
    }
    lastCount_ = time_.value();
}

const BeadTraffic& BeadFlux::traffic() const
{
    return mesh_.lookupObject<BeadTraffic>(BeadTraffic::registryName);
}

void BeadFlux::requireSameOutlets() const
{
    wordList before;
    if (getProperty(outletsEntry, before) && before != traffic().outlets())
    {
        FatalIOError(FUNCTION_NAME, __FILE__, __LINE__, time_.globalPath() / time_.constant() / "couplingProperties")
            << "Entry 'beadOutlets' is " << flatOutput(traffic().outlets()) << " and was " << flatOutput(before)
            << " when " << name() << " counted what left; allowed: as it was, for its totals are those since the fresh "
            << "start, or another name for " << name() << " in system/controlDict, by which it begins at 0"
            << exit(FatalIOError);
    }
}

void BeadFlux::resume(label rowsThatStay)
{
    stringList passages;
    string lastSample;
    // Checkpoints of earlier versions have no outlets' names: their number is all that can be compared.
    if (!getProperty(passagesEntry, passages) || !getProperty(lastSampleEntry, lastSample)
        || !getProperty(lastRowEntry, lastRow_) || passages.size() != static_cast<label>(passages_.size()))
    {
        return;
    }
    for (std::size_t i = 0; i < passages_.size(); ++i)
    {
        Passage& passage = passages_[i];
        std::istringstream text(passages[static_cast<label>(i)]);
        text >> passage.beads >> passage.mass >> passage.momentum.x() >> passage.momentum.y() >> passage.momentum.z();
    }
    std::istringstream text(lastSample);
    text >> lastSample_;
    for (double& mass : lastMasses_)
    {
        text >> mass;
    }
    getProperty(rowsEntry, rows_);
    const bool again = isRowOfNow(time_, lastSample_);
    warnOfLostRows(rowsThatStay, again ? rows_ - 1 : rows_, name() + ".dat");
    if (again)
    {
        writeRow();
    }
}

bool BeadFlux::read(const dictionary& dict)
{
    fvMeshFunctionObject::read(dict);
    writeFile::read(dict);
    requireKnownEntries(
        dict, {"type", "libs", "enabled", "log", "region", "writePrecision", "sampleInterval", "useUserTime"});
    sampleInterval_ = dict.found("sampleInterval") ? positiveEntry(dict, "sampleInterval") : 0;
    return true;
}

bool BeadFlux::execute()
{
    count();
    if (isRowDue(time_, lastSample_, sampleInterval_))
    {
        sample();
    }
    keepState();
    return true;
}

bool BeadFlux::end()
{
    count();
    sample();
    keepState();
    return true;
}

void BeadFlux::count()
{
    if (time_.value() <= lastCount_)
    {
        return;
    }
    lastCount_ = time_.value();
    passages_.front() += traffic().lastInserted();
    const std::vector<Passage>& left = traffic().lastLeft();
    for (std::size_t outlet = 0; outlet < left.size(); ++outlet)
    {
        passages_[outlet + 1] += left[outlet];
    }
}

void BeadFlux::sample()
{
    const scalar now = time_.value();
    if (now <= lastSample_)
    {
        return;
    }
    OStringStream row;
    row.precision(file().precision());
    writeCurrentTime(row);
    for (std::size_t i = 0; i < passages_.size(); ++i)
    {
        const scalar rate = lastSample_ < 0 ? 0 : (passages_[i].mass - lastMasses_[i]) / (now - lastSample_);
        const vector& momentum = passages_[i].momentum;
        row << tab << setw(charWidth()) << passages_[i].beads;
        for (const scalar value : {passages_[i].mass, momentum.x(), momentum.y(), momentum.z(), rate})
        {
            row << tab << setw(charWidth()) << value;
        }
        lastMasses_[i] = passages_[i].mass;
    }
    lastRow_ = row.str();
    lastSample_ = now;
    ++rows_;
    writeRow();
}

void BeadFlux::writeRow()
{
    Ostream& os = file();
    os << lastRow_.c_str() << endl;
    requireWritten(os);
}

void BeadFlux::keepState()
{
    stringList texts;
    std::string lastSample = textOf(lastSample_);
    for (const Passage& passage : passages_)
    {
        const vector& momentum = passage.momentum;
        texts.append(textOf(passage.beads, passage.mass, momentum.x(), momentum.y(), momentum.z()));
    }
    for (const double mass : lastMasses_)
    {
        lastSample += textOf(mass);
    }
    setProperty(outletsEntry, traffic().outlets());
    setProperty(passagesEntry, texts);
    setProperty(lastSampleEntry, string(lastSample));
    setProperty(lastRowEntry, lastRow_);
    setProperty(rowsEntry, rows_);
}

} // namespace clepsydra
