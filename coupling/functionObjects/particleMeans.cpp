#include "functionObjects/particleMeans.h"

#include "functionObjects/observableTable.h"
#include "functionObjects/observedParticles.h"
#include "modelLines.h"
#include "openfoam/objectFile.h"
#include "rankTotals.h"
#include "tokens/exactText.h"
#include "vectors.h"

#include "IOdictionary.H"
#include "Time.H"
#include "addToRunTimeSelectionTable.H"
#include "fvMesh.H"
#include "stringList.H"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace clepsydra
{

defineTypeNameAndDebug(ParticleMeans, 0);
addToRunTimeSelectionTable(functionObject, ParticleMeans, dictionary);
static const ModelLines lines("functions { type }",
    {{ParticleMeans::typeName_(), "means over time of the particles' speed and velocity in bins of space"}});

namespace
{

/// The state in checkpoints. Numbers are text, because OpenFOAM would write them with the precision of the fields.
const word binsEntry = "bins";
/// Whether the bins divide the box around the mesh.
const word aroundMeshEntry = "aroundMesh";
const word sampledTimesEntry = "sampledTimes";
const word timeOfLastRowsEntry = "timeOfLastRows";
const word lastRowsEntry = "lastRows";
const word rowsEntry = "rows";
const word sumsEntry = "sums";

template<class Numbers>
std::string textOf(const Numbers& numbers)
{
    std::string text;
    for (const double number : numbers)
    {
        text += exactText(number) + ' ';
    }
    return text;
}

std::string textOf(const ParticleBins& bins)
{
    return textOf(bins.lowest()) + textOf(bins.highest()) + textOf(bins.size());
}

ParticleBins binsFrom(const std::string& text)
{
    std::istringstream numbers(text);
    Eigen::Matrix3d columns = Eigen::Matrix3d::Zero();
    for (double& number : columns.reshaped())
    {
        numbers >> number;
    }
    return {boundBox(toFoam(columns.col(0)), toFoam(columns.col(1))), columns.col(2)};
}

boundBox boxOf(const ParticleBins& bins)
{
    return {toFoam(bins.lowest()), toFoam(bins.highest())};
}

/// The bins that a dictionary states. \param aroundMesh  where it states no box
ParticleBins binsOf(const dictionary& dict, const boundBox& aroundMesh)
{
    const Vector3d size = toEigen(dict.get<vector>("binSize"));
    if (!(size.array() > 0).all() || !size.allFinite())
    {
        FatalIOErrorInFunction(dict) << "Entry 'binSize' is " << toFoam(size) << "; allowed: three sizes > 0 [m]"
                                     << exit(FatalIOError);
    }
    boundBox box = aroundMesh;
    if (dict.readIfPresent("box", box) && !(toEigen(box.span()).array() > 0).all())
    {
        FatalIOErrorInFunction(dict) << "Entry 'box' is " << box.min() << ' ' << box.max()
                                     << "; allowed: its lowest and its highest corner, the second above the first "
                                     << "along each axis" << exit(FatalIOError);
    }
    if (const double asked = ParticleBins::numberOf(box, size); asked > ParticleBins::most)
    {
        FatalIOErrorInFunction(dict) << "Entry 'binSize' is " << toFoam(size) << ", which gives " << asked
                                     << " bins in the box " << box.min() << ' ' << box.max() << "; allowed: at most "
                                     << ParticleBins::most << " bins" << exit(FatalIOError);
    }
    return {box, size};
}

} // namespace

/// Writes the sums with each checkpoint, also at times at which the function object is not executed.
class ParticleMeans::StoredSums : public IOdictionary
{
public:
    StoredSums(const IOobject& file, const ParticleMeans& means)
        : IOdictionary(file),
          means_(means)
    {}

    bool writeData(Ostream& os) const override
    {
        means_.state().dictionary::write(os, false);
        return os.good();
    }

private:
    const ParticleMeans& means_;
};

ParticleMeans::ParticleMeans(const word& name, const Time& time, const dictionary& dict)
    : fvMeshFunctionObject(name, time, dict),
      writeFile(mesh_, name, name)
{
    // The file is created after all checks, because one that is left by a wrong entry would make OpenFOAM write the
    // next run's file under another name.
    ParticleMeans::read(dict);
    resume(dict);
    const label rowsThatStay = makeRoomFrom(time.value(), time.globalPath() / outputPrefix / name, name + ".dat");
    resetFile(name);

    Ostream& os = file();
    writeHeader(os, "Means since the first sample, in bins");
    writeHeaderValue(os, "Size of a bin [m]", toFoam(bins_->size()));
    writeHeaderValue(os, "Box [m]", boundBox(toFoam(bins_->lowest()), toFoam(bins_->highest())));
    writeCommented(os, "time [s]");
    for (const char* column : {"centre x [m]", "centre y [m]", "centre z [m]", "sampled times [-]", "particles [-]",
             "speed [m/s]", "deviation of the speed [m/s]", "velocity x [m/s]", "velocity y [m/s]", "velocity z [m/s]",
             "solid fraction [-]"})
    {
        writeTabbed(os, column);
    }
    os << endl;

    const bool rewritesRows = isRowOfNow(time_, timeOfLastRows_);
    rows_ -= rewritesRows ? lastRows_ : 0;
    warnOfLostRows(rowsThatStay, rows_, name + ".dat");
    if (rewritesRows)
    {
        writeRows();
    }
}

ParticleMeans::~ParticleMeans() = default;

bool ParticleMeans::read(const dictionary& dict)
{
    fvMeshFunctionObject::read(dict);
    writeFile::read(dict);
    requireKnownEntries(dict, functionObjectEntries({"binSize", "box"}));

    const std::unique_ptr<ParticleBins> before = std::move(bins_);
    // The mesh may have moved since.
    bins_ = std::make_unique<ParticleBins>(
        binsOf(dict, before && aroundMesh_ ? boxOf(*before) : boundBox(mesh_.points(), true)));
    aroundMesh_ = !dict.found("box");
    if (before)
    {
        requireSameBins(dict, *before);
    }

    // OpenFOAM counts the other controls from the time at which a run was resumed.
    const auto control = dict.getOrDefault<word>("executeControl", "timeStep");
    if (control != "timeStep")
    {
        FatalIOErrorInFunction(dict) << "Entry 'executeControl' is " << control << "; allowed: timeStep"
                                     << exit(FatalIOError);
    }
    executeInterval_ = dict.getOrDefault<label>("executeInterval", 1);
    if (executeInterval_ < 1)
    {
        FatalIOErrorInFunction(dict) << "Entry 'executeInterval' is " << executeInterval_
                                     << "; allowed: a number of time steps, at least 1" << exit(FatalIOError);
    }
    return true;
}

void ParticleMeans::requireSameBins(const dictionary& dict, const ParticleBins& before) const
{
    if (!bins_->areLike(before))
    {
        FatalIOErrorInFunction(dict) << "Entries 'binSize' and 'box' give bins of " << toFoam(bins_->size()) << " from "
                                     << toFoam(bins_->lowest()) << " to " << toFoam(bins_->highest())
                                     << ", but they were " << toFoam(before.size()) << " from "
                                     << toFoam(before.lowest()) << " to " << toFoam(before.highest()) << " when "
                                     << name() << " took its first sample; allowed: the same as then, or another name "
                                     << "for " << name() << ", under which it begins again" << exit(FatalIOError);
    }
}

void ParticleMeans::resume(const dictionary& dict)
{
    IOobject file(name(), time_.timeName(), "uniform/functionObjects", time_, IOobject::NO_READ, IOobject::AUTO_WRITE);
    const bool isStored = hasFile<IOdictionary>(file);
    file.readOpt() = isStored ? IOobject::MUST_READ : IOobject::NO_READ;
    stored_ = std::make_unique<StoredSums>(file, *this);
    if (isStored)
    {
        const ParticleBins before = binsFrom(stored_->get<string>(binsEntry));
        if (stored_->getOrDefault<bool>(aroundMeshEntry, false))
        {
            *bins_ = binsOf(dict, boxOf(before));
        }
        requireSameBins(dict, before);
        *bins_ = before;
    }
    sums_ = Eigen::ArrayXXd::Zero(sumCount, bins_->count());
    if (!isStored)
    {
        return;
    }
    stored_->readEntry(sampledTimesEntry, sampledTimes_);
    stored_->readEntry(lastRowsEntry, lastRows_);
    stored_->readEntry(rowsEntry, rows_);
    timeOfLastRows_ = std::stod(stored_->get<string>(timeOfLastRowsEntry));
    for (const std::string& text : stored_->get<stringList>(sumsEntry))
    {
        std::istringstream numbers(text);
        label bin = 0;
        numbers >> bin;
        for (double& sum : sums_.col(bin))
        {
            numbers >> sum;
        }
    }
}

dictionary ParticleMeans::state() const
{
    stringList sums;
    for (label bin = 0; bin < bins_->count(); ++bin)
    {
        if (sums_(particleCount, bin) > 0)
        {
            sums.append(string(std::to_string(bin) + ' ' + textOf(sums_.col(bin))));
        }
    }
    dictionary state;
    state.set(binsEntry, string(textOf(*bins_)));
    state.set(aroundMeshEntry, aroundMesh_);
    state.set(sampledTimesEntry, sampledTimes_);
    state.set(timeOfLastRowsEntry, string(exactText(timeOfLastRows_)));
    state.set(lastRowsEntry, lastRows_);
    state.set(rowsEntry, rows_);
    state.set(sumsEntry, sums);
    return state;
}

bool ParticleMeans::execute()
{
    // OpenFOAM also executes before it writes, at whatever time step that is.
    const label step = time_.timeIndex();
    if (step % executeInterval_ == 0 && step != lastSampledStep_)
    {
        sample();
        lastSampledStep_ = step;
    }
    return true;
}

void ParticleMeans::sample()
{
    RankNumbers here;
    here.sums.resize(static_cast<std::size_t>(sumCount * bins_->count()));
    Eigen::Map<Eigen::ArrayXXd> sumsHere(here.sums.data(), sumCount, bins_->count());
    const auto& observed = mesh_.lookupObject<ObservedParticles>(ObservedParticles::registryName);
    const ParticlesView particles = observed.particles();
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        const label bin = bins_->binOf(observed.positionInBox(particle));
        if (bin < 0)
        {
            continue;
        }
        const Vector3d v = particles.velocity.col(particle);
        auto sums = sumsHere.col(bin);
        sums[particleCount] += 1;
        sums[speed] += v.norm();
        sums[squaredSpeed] += v.squaredNorm();
        sums.segment<3>(velocity) += v.array();
        sums[solidVolume] += sphereVolume(particles.radius[particle]);
    }
    // In each sample, so that the order of the sums does not depend on the times of checkpoints.
    const RankNumbers all = RankTotals::of(here);
    sums_ += Eigen::Map<const Eigen::ArrayXXd>(all.sums.data(), sumCount, bins_->count());
    ++sampledTimes_;
}

bool ParticleMeans::write()
{
    if (time_.writeTime() && time_.value() > timeOfLastRows_)
    {
        writeRows();
    }
    return true;
}

void ParticleMeans::writeRows()
{
    lastRows_ = 0;
    Ostream& os = file();
    for (label bin = 0; bin < bins_->count(); ++bin)
    {
        const auto sums = sums_.col(bin);
        const double count = sums[particleCount];
        if (count == 0)
        {
            continue;
        }
        const double meanSpeed = sums[speed] / count;
        const double variance = std::max(0.0, sums[squaredSpeed] / count - meanSpeed * meanSpeed);
        const Vector3d centre = bins_->centre(bin);
        writeCurrentTime(os);
        for (const double value : {centre.x(), centre.y(), centre.z(), double(sampledTimes_), count, meanSpeed,
                 std::sqrt(variance), sums[velocity] / count, sums[velocity + 1] / count, sums[velocity + 2] / count,
                 sums[solidVolume] / (sampledTimes_ * bins_->volume(bin))})
        {
            os << tab << setw(charWidth()) << value;
        }
        os << endl;
        ++lastRows_;
    }
    requireWritten(os);
    timeOfLastRows_ = time_.value();
    rows_ += lastRows_;
}

} // namespace clepsydra
