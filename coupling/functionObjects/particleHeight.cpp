#include "functionObjects/particleHeight.h"

#include "functionObjects/observableTable.h"
#include "functionObjects/observedParticles.h"
#include "modelLines.h"
#include "rankTotals.h"
#include "tokens/exactText.h"

#include "Time.H"
#include "addToRunTimeSelectionTable.H"
#include "fvMesh.H"

namespace clepsydra
{

defineTypeNameAndDebug(ParticleHeight, 0);
addToRunTimeSelectionTable(functionObject, ParticleHeight, dictionary);
static const ModelLines lines(
    "functions { type }", {{ParticleHeight::typeName_(), "height and velocity of one particle along an axis"}});

namespace
{

/// As text, because OpenFOAM would write the number with the precision of the fields.
const word lastRowEntry = "lastRow";
const word rowsEntry = "rows";

} // namespace

ParticleHeight::ParticleHeight(const word& name, const Time& time, const dictionary& dict)
    : fvMeshFunctionObject(name, time, dict),
      writeFile(mesh_, name, name)
{
    // The file is created after all checks, because one that is left by a wrong entry would make OpenFOAM write the
    // next run's file under another name.
    ParticleHeight::read(dict);
    const label rowsThatStay = makeRoomFrom(time.value(), time.globalPath() / outputPrefix / name, name + ".dat");
    resetFile(name);

    Ostream& os = file();
    writeHeader(os, "Particle " + Foam::name(particle_));
    writeHeaderValue(os, "Axis", toFoam(axis_));
    writeCommented(os, "time [s]");
    writeTabbed(os, "height [m]");
    writeTabbed(os, "velocity [m/s]");
    os << endl;

    // OpenFOAM executes function objects only after the first step, but the table should begin at the start time.
    if (resume(rowsThatStay) && mesh_.foundObject<ObservedParticles>(ObservedParticles::registryName))
    {
        sample();
    }
}

bool ParticleHeight::resume(label rowsThatStay)
{
    string lastRow;
    if (!getProperty(lastRowEntry, lastRow))
    {
        return true;
    }
    getProperty(rowsEntry, rows_);
    const bool rewritesRow = isRowOfNow(time_, std::stod(lastRow));
    rows_ -= rewritesRow ? 1 : 0;
    warnOfLostRows(rowsThatStay, rows_, name() + ".dat");
    return rewritesRow;
}

bool ParticleHeight::read(const dictionary& dict)
{
    fvMeshFunctionObject::read(dict);
    writeFile::read(dict);
    requireKnownEntries(dict, functionObjectEntries({"particle", "axis", "stopBelow"}));

    const auto axis = dict.getOrDefault<vector>("axis", vector(0, 0, 1));
    if (mag(axis) < SMALL)
    {
        FatalIOErrorInFunction(dict) << "Entry 'axis' is " << axis << "; allowed: a vector that is not zero"
                                     << exit(FatalIOError);
    }
    axis_ = toEigen(axis).normalized();

    stopBelow_ = dict.getOrDefault<scalar>("stopBelow", -GREAT);
    particle_ = dict.getOrDefault<label>("particle", 1);
    hasLeft_ = false;
    // At later times, and in a resumed run, the particle may have left.
    if (time_.timeIndex() == 0 && mesh_.foundObject<ObservedParticles>(ObservedParticles::registryName))
    {
        const ParticlesView particles =
            mesh_.lookupObject<ObservedParticles>(ObservedParticles::registryName).particles();
        if (!returnReduce((particles.id == particle_).any(), orOp<bool>()))
        {
            FatalIOErrorInFunction(dict) << "Entry 'particle' is " << particle_ << "; allowed: the id of one of the "
                                         << returnReduce(label(particles.size()), sumOp<label>()) << " particles"
                                         << exit(FatalIOError);
        }
    }
    return true;
}

bool ParticleHeight::execute()
{
    sample();
    return true;
}

void ParticleHeight::sample()
{
    // Only the owning rank adds values, the others add zero.
    double heightHere = 0;
    double velocityHere = 0;
    double foundHere = 0;
    const auto& observed = mesh_.lookupObject<ObservedParticles>(ObservedParticles::registryName);
    const ParticlesView particles = observed.particles();
    for (Eigen::Index i = 0; i < particles.size(); ++i)
    {
        if (particles.id[i] == particle_)
        {
            heightHere = axis_.dot(observed.unwrappedPosition(i));
            velocityHere = axis_.dot(particles.velocity.col(i));
            foundHere = 1;
        }
    }
    const RankNumbers all = RankTotals::of({{heightHere, velocityHere, foundHere}, {}});
    if (!(all.sums[2] > 0))
    {
        if (!hasLeft_)
        {
            Info << name() << ": particle " << particle_ << " is no longer there, so no more rows are written" << endl;
        }
        hasLeft_ = true;
        return;
    }
    const scalar height = all.sums[0];
    const scalar velocity = all.sums[1];

    Ostream& os = file();
    writeCurrentTime(os);
    os << tab << setw(charWidth()) << height << tab << setw(charWidth()) << velocity << endl;
    requireWritten(os);
    setProperty(lastRowEntry, string(exactText(time_.value())));
    setProperty(rowsEntry, ++rows_);

    if (height < stopBelow_)
    {
        Info << name() << ": particle " << particle_ << " is below " << stopBelow_ << " m: the run ends" << endl;
        time_.stopAt(Time::saWriteNow);
    }
}

} // namespace clepsydra
