#include "checkpoint/runTime.h"

#include "openfoam/compatibility.h"

#include "IFstream.H"
#include "IOdictionary.H"

#include <algorithm>

namespace clepsydra
{

using namespace Foam;

namespace
{

dictionary controlsFrom(const argList& args, const word& start)
{
    IFstream file(args.globalPath() / "system" / Time::controlDictName);
    dictionary controls(file);
    controls.set("startFrom", word("startTime"));
    controls.set("startTime", readScalar(start));
    return controls;
}

} // namespace

RunTime::RunTime(const argList& args)
    : Time(Time::controlDictName, args),
      beginning_(startTime_)
{}

RunTime::RunTime(const argList& args, const word& start)
    : Time(controlsFrom(args, start), args.rootPath(), args.caseName(), "system", "constant",
        !args.found("noFunctionObjects")),
      beginning_(startTime_)
{}

void RunTime::resume(double beginning)
{
    const IOdictionary written(
        IOobject("time", timeName(), "uniform", *this, IOobject::MUST_READ, IOobject::NO_WRITE, false));
    if (timeIndex() != written.get<label>("index"))
    {
        // Time itself continues without the index where it could not read the file.
        FatalIOErrorInFunction(written) << "The index of the time step could not be read" << exit(FatalIOError);
    }
    requireWholeState();
    value() = written.get<scalar>("value");
    beginning_ = beginning;
    // With adjustableCouplingTimeStep, the deltaT of controlDict is only that of the first step and may reach beyond
    // the next write time or the end.
    setDeltaT(written.get<scalar>("deltaT"), false);
    // The step before the next one, which schemes of second order in time need.
    deltaTSave_ = deltaT_;
    if (writesByTime())
    {
        writeTimeIndex_ = static_cast<label>((value() - beginning_ + 0.5 * deltaT_) / writeInterval_);
    }
}

void RunTime::requireWholeState() const
{
    const IOobject properties("functionObjectProperties", timeName(), "uniform/functionObjects", *this,
        IOobject::MUST_READ, IOobject::NO_WRITE, false);
    // Where there is no file, the message names its place.
    const fileName found = clepsydra::typeFilePath<IOdictionary>(properties);
    IFstream file(found.empty() ? properties.objectPath() : found);
    dictionary state(file);
    state.remove("FoamFile");
    if (state.digest() != functionObjectState(*this).digest())
    {
        // OpenFOAM takes a file that it could not read completely for one that ends there.
        FatalIOErrorInFunction(file) << "The state of the function objects could not be read completely"
                                     << exit(FatalIOError);
    }
}

void RunTime::readDict()
{
    const label purgeBefore = purgeWrite_;
    Time::readDict();
    bool corrected = false;
    const auto keep = [&](const word& entry, const auto& kept, const char* allowed) {
        // The registry's own copy of controlDict, which is not constant. Readers of the entry then see what is done.
        auto& controls = const_cast<dictionary&>(controlDict());
        Info << "WARNING: entry '" << entry << "' of system/controlDict was changed to " << controls.lookup(entry)[0]
             << "; allowed: " << allowed << ". The run keeps " << kept << nl << endl;
        controls.set(entry, kept);
        corrected = true;
    };
    if (purgeWrite_ == 1)
    {
        keep("purgeWrite", purgeBefore, "0 for all times, or at least 2");
    }
    if (writeCompression() == IOstream::COMPRESSED)
    {
        keep("writeCompression", word("off"), "off");
    }
    if (corrected)
    {
        Time::readDict();
    }
}

bool RunTime::loop()
{
    if (atEnd())
    {
        return false;
    }
    readModifiedObjects();
    operator++();
    return true;
}

bool RunTime::loop(double step)
{
    if (atEnd())
    {
        return false;
    }
    setDeltaT(step, false);
    return loop();
}

bool RunTime::writesByTime() const
{
    return writeControl_ == wcRunTime || writeControl_ == wcAdjustableRunTime;
}

double RunTime::timeLeft() const
{
    const double toWrite = writesByTime() ? beginning_ + (writeTimeIndex_ + 1) * writeInterval_ - value() : VGREAT;
    return atEnd() ? toWrite : std::min(toWrite, endTime_ - value());
}

Time& RunTime::operator++()
{
    // Time counts write times from startTime_; elsewhere startTime_ gives the names of the folders of observables.
    const scalar resumedAt = startTime_;
    startTime_ = beginning_;
    Time::operator++();
    startTime_ = resumedAt;
    return *this;
}

bool RunTime::stopAt(const stopAtControls control) const
{
    return !atEnd() && Time::stopAt(control);
}

void RunTime::endHere()
{
    stopAt_ = saWriteNow;
    endTime_ = value();
    writeTime_ = true;
}

void RunTime::writeHere()
{
    writeTime_ = true;
}

bool RunTime::atEnd() const
{
    return value() >= endTime_ - 0.5 * deltaT_;
}

} // namespace clepsydra
