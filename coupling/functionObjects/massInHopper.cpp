#include "functionObjects/massInHopper.h"

#include "functionObjects/observableTable.h"
#include "functionObjects/observedParticles.h"
#include "modelLines.h"
#include "openfoam/compatibility.h"
#include "rankTotals.h"
#include "vectors.h"
#include "tokens/exactText.h"

#include "Time.H"
#include "addToRunTimeSelectionTable.H"
#include "DynamicList.H"
#include "Pstream.H"
#include "fvMesh.H"

#include <algorithm>
#include <sstream>

namespace clepsydra
{

defineTypeNameAndDebug(MassInHopper, 0);
addToRunTimeSelectionTable(functionObject, MassInHopper, dictionary);
static const ModelLines lines(
    "functions { type }", {{MassInHopper::typeName_(), "mass, number and rate of the particles in a hopper"}});

namespace
{

const word countEntry = "particlesInHopper";
/// As text, like the samples: OpenFOAM would write numbers with the precision of the fields, and a resumed run would
/// stop at another time and have another rate.
const word lastDepartureEntry = "timeOfLastDeparture";
/// Whether a particle has left after the last sample and before the checkpoint.
const word departedEntry = "departedSinceLastSample";
/// Times and masses alternately.
const word samplesEntry = "samplesOfRate";
const word rowsEntry = "rows";
/// Patch, axis, foot and radius: the points of a mesh that moves are elsewhere in a resumed run.
const word cylinderEntry = "cylinder";

std::string textOf(const Vector3d& values)
{
    return exactText(values.x()) + ' ' + exactText(values.y()) + ' ' + exactText(values.z());
}

stringList textOf(const std::deque<TrailingRate::Sample>& samples)
{
    stringList numbers;
    for (const TrailingRate::Sample& sample : samples)
    {
        for (const double number : {sample.time, sample.amount})
        {
            numbers.append(exactText(number));
        }
    }
    return numbers;
}

std::deque<TrailingRate::Sample> samplesIn(const stringList& numbers)
{
    std::deque<TrailingRate::Sample> samples;
    for (label i = 0; i + 1 < numbers.size(); i += 2)
    {
        samples.push_back({std::stod(numbers[i]), std::stod(numbers[i + 1])});
    }
    return samples;
}

} // namespace

MassInHopper::MassInHopper(const word& name, const Time& time, const dictionary& dict)
    : fvMeshFunctionObject(name, time, dict),
      writeFile(mesh_, name, name)
{
    // The file is created after all checks, because one that is left by a wrong entry would make OpenFOAM write the
    // next run's file under another name.
    MassInHopper::read(dict);
    const label rowsThatStay = makeRoomFrom(time.value(), time.globalPath() / outputPrefix / name, name + ".dat");
    resetFile(name);

    Ostream& os = file();
    writeHeader(os, "Particles in the hopper, patch '" + dict.get<word>("patch") + "'");
    writeHeaderValue(os, "Foot of its axis [m]", toFoam(hopper_->foot()));
    writeHeaderValue(os, "Radius [m]", hopper_->radius());
    writeCommented(os, "time [s]");
    writeTabbed(os, "mass [kg]");
    writeTabbed(os, "particles [-]");
    writeTabbed(os, "rate [kg/s]");
    os << endl;

    resume(rowsThatStay);
    // OpenFOAM executes function objects only after the first step, but the table should begin at the start time.
    if (mesh_.foundObject<ObservedParticles>(ObservedParticles::registryName))
    {
        look();
        if (lastSample_ < 0)
        {
            sample();
        }
    }
}

void MassInHopper::resume(label rowsThatStay)
{
    stringList numbers;
    getProperty(samplesEntry, numbers);
    std::deque<TrailingRate::Sample> samples = samplesIn(numbers);
    if (samples.empty())
    {
        return;
    }
    getProperty(rowsEntry, rows_);
    getProperty(countEntry, lastParticles_);
    const scalar lastSample = samples.back().time;
    if (isRowOfNow(time_, lastSample))
    {
        samples.pop_back();
        --rows_;
    }
    else
    {
        lastSample_ = lastSample;
    }
    rate_->resume(std::move(samples));
    warnOfLostRows(rowsThatStay, rows_, name() + ".dat");
}

bool MassInHopper::read(const dictionary& dict)
{
    fvMeshFunctionObject::read(dict);
    writeFile::read(dict);
    requireKnownEntries(
        dict, functionObjectEntries({"patch", "axis", "rateWindow", "stopWhenFlowStops", "sampleInterval"}));

    const word patchName = dict.get<word>("patch");
    const label patch = mesh_.boundaryMesh().findPatchID(patchName);
    if (patch < 0)
    {
        FatalIOErrorInFunction(dict) << "Entry 'patch' is '" << patchName
                                     << "', which is not a patch of the mesh; allowed: "
                                     << flatOutput(mesh_.boundaryMesh().names()) << exit(FatalIOError);
    }
    // A FatalIOError, because OpenFOAM turns a FatalError of a function object into a warning and continues without it.
    if (returnReduce(mesh_.boundaryMesh()[patch].size(), sumOp<label>()) == 0)
    {
        FatalIOErrorInFunction(dict) << "Entry 'patch' is '" << patchName
                                     << "', which has no faces; allowed: the patch of the hopper's wall"
                                     << exit(FatalIOError);
    }
    const auto axis = dict.getOrDefault<vector>("axis", vector(0, 0, 1));
    if (mag(axis) < SMALL)
    {
        FatalIOErrorInFunction(dict) << "Entry 'axis' is " << axis << "; allowed: a vector that is not zero"
                                     << exit(FatalIOError);
    }
    setHopper(mesh_.boundaryMesh()[patch], toEigen(axis));

    rate_ = std::make_unique<TrailingRate>(dict.found("rateWindow") ? positiveEntry(dict, "rateWindow", true) : 0.1);
    stopAfter_ = dict.found("stopWhenFlowStops") ? positiveEntry(dict, "stopWhenFlowStops") : 0;
    sampleInterval_ = dict.found("sampleInterval") ? positiveEntry(dict, "sampleInterval") : 0;
    // deltaT of controlDict, not the length of the last coupling step, which adjustableCouplingTimeStep may have
    // increased: a resumed run must accept what a fresh start accepts.
    const auto timeStep = time_.controlDict().get<scalar>("deltaT");
    if (sampleInterval_ > 0 && sampleInterval_ < timeStep * (1 - roundingOfTime))
    {
        FatalIOErrorInFunction(dict) << "Entry 'sampleInterval' is " << sampleInterval_
                                     << " s; allowed: at least the time step, " << timeStep << " s"
                                     << exit(FatalIOError);
    }
    return true;
}

void MassInHopper::setHopper(const polyPatch& wall, const Vector3d& axis)
{
    const stringList wallAndAxis({string(wall.name()), string(textOf(axis))});
    stringList stored;
    if (getProperty(cylinderEntry, stored) && stored.size() == 3 && stored[0] == wallAndAxis[0]
        && stored[1] == wallAndAxis[1])
    {
        std::istringstream numbers(stored[2]);
        Vector3d foot = Vector3d::Zero();
        double radius = 0;
        numbers >> foot.x() >> foot.y() >> foot.z() >> radius;
        hopper_ = std::make_unique<HopperCylinder>(axis, foot, radius);
        return;
    }
    hopper_ = std::make_unique<HopperCylinder>(wall, axis);
    stored = wallAndAxis;
    stored.append(string(textOf(hopper_->foot()) + ' ' + exactText(hopper_->radius())));
    setProperty(cylinderEntry, stored);
}

bool MassInHopper::execute()
{
    if (isRowDue(time_, lastSample_, sampleInterval_))
    {
        sample();
        stopIfFlowStopped();
    }
    else if (time_.writeTime() && returnReduce(look().anyHasLeft, orOp<bool>()))
    {
        setProperty(departedEntry, true);
    }
    return true;
}

bool MassInHopper::end()
{
    sample();
    return true;
}

void MassInHopper::sample()
{
    const scalar now = time_.value();
    if (now <= lastSample_)
    {
        return;
    }

    const Look here = look();
    const RankNumbers all = RankTotals::of({{here.mass, here.count}, {here.anyHasLeft ? 1.0 : 0.0}});
    const scalar mass = all.sums[0];
    const auto count = static_cast<label>(all.sums[1]);

    Ostream& os = file();
    writeCurrentTime(os);
    os << tab << setw(charWidth()) << mass << tab << setw(charWidth()) << count << tab << setw(charWidth())
       << rate_->add(now, mass) << endl;
    requireWritten(os);

    if (all.maxima[0] > 0 || count < lastParticles_ || getProperty<bool>(departedEntry))
    {
        setProperty(lastDepartureEntry, string(exactText(now)));
        setProperty(departedEntry, false);
    }
    setResult(countEntry, count);
    setProperty(countEntry, count);
    setProperty(samplesEntry, textOf(rate_->samples()));
    setProperty(rowsEntry, ++rows_);
    lastParticles_ = count;
    lastSample_ = now;
}

MassInHopper::Look MassInHopper::look()
{
    Look found;
    const auto& observed = mesh_.lookupObject<ObservedParticles>(ObservedParticles::registryName);
    const ParticlesView particles = observed.particles();
    List<DynamicList<label>> toRanks(Pstream::nProcs());
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        if (hopper_->contains(observed.positionInBox(particle)))
        {
            found.mass += particles.mass[particle];
            ++found.count;
            const label id = particles.id[particle];
            toRanks[id % Pstream::nProcs()].append(id);
        }
    }
    List<DynamicList<label>> fromRanks;
    Pstream::exchange<DynamicList<label>, label>(toRanks, fromRanks);
    std::vector<label> now;
    for (const DynamicList<label>& ids : fromRanks)
    {
        now.insert(now.end(), ids.begin(), ids.end());
    }
    std::sort(now.begin(), now.end());
    ids_.swap(now);
    found.anyHasLeft = !std::includes(ids_.begin(), ids_.end(), now.begin(), now.end());
    return found;
}

void MassInHopper::stopIfFlowStopped()
{
    string lastDeparture;
    if (stopping_ || stopAfter_ <= 0 || !getProperty(lastDepartureEntry, lastDeparture)
        || time_.value() - std::stod(lastDeparture) < stopAfter_ * (1 - roundingOfTime))
    {
        return;
    }
    stopping_ = true;
    Info << type() << ' ' << name() << ": no particle has left since " << lastDeparture.c_str() << " s, and "
         << lastParticles_ << " remain; the run ends" << endl;
    time_.stopAt(Time::saWriteNow);
}

label MassInHopper::lastCount(const Time& time)
{
    for (const entry& object : functionObjectState(time))
    {
        label count = -1;
        if (object.isDict() && object.dict().readIfPresent(countEntry, count))
        {
            return count;
        }
    }
    return -1;
}

} // namespace clepsydra
