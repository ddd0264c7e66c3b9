#include "insertionAndRemoval/insertionAndRemoval.h"

#include "runTimeSelection.h"
#include "vectors.h"

#include <algorithm>

namespace clepsydra
{

using namespace Foam;

ParticleTransfer& ParticleTransfer::operator+=(const ParticleTransfer& other)
{
    particles += other.particles;
    mass += other.mass;
    momentum += other.momentum;
    volume += other.volume;
    return *this;
}

namespace
{

/// Default duration of the insertion ramp in coupling steps.
constexpr double defaultInsertionSteps = 10;

double readInsertionTime(const dictionary& couplingProperties, double couplingTimeStep)
{
    return couplingProperties.found("insertionTime") ? positiveEntry(couplingProperties, "insertionTime")
                                                     : defaultInsertionSteps * couplingTimeStep;
}

/// Submerged fraction of a particle during insertion. \param insertionRamp  fraction of the insertion time that has
/// passed
double shareAfterRamp(double insertionRamp)
{
    return insertionRamp * insertionRamp * (3 - 2 * insertionRamp);
}

constexpr std::size_t numbersOfTransfer = 6;

void append(RankNumbers& ofRank, const ParticleTransfer& transfer)
{
    ofRank.sums.insert(ofRank.sums.end(), {static_cast<double>(transfer.particles), transfer.mass, transfer.volume});
    ofRank.addVector(transfer.momentum);
}

/// \param index  among those that were appended
ParticleTransfer transferIn(const RankNumbers& totals, std::size_t index)
{
    const std::size_t first = index * numbersOfTransfer;
    return {static_cast<label>(totals.sums[first]), totals.sums[first + 1], totals.vectorAt<vector>(first + 3),
        totals.sums[first + 2]};
}

void addParticle(ParticleTransfer& to, double mass, const Vector3d& velocity)
{
    ++to.particles;
    to.mass += mass;
    to.momentum += mass * toFoam(velocity);
}

} // namespace

InsertionAndRemoval::InsertionAndRemoval(
    const dictionary& couplingProperties, const fvMesh& mesh, double couplingTimeStep, const PeriodicBox& periodic)
    : regIOobject(IOobject(registryName, mesh.time().timeName(), mesh)),
      outlets_(couplingProperties, mesh),
      periodic_(periodic),
      insertionTime_(readInsertionTime(couplingProperties, couplingTimeStep)),
      couplingTimeStep_(couplingTimeStep),
      lastDeparted_(static_cast<std::size_t>(outlets_.names().size()))
{}

label InsertionAndRemoval::findParts(
    const ParticlesView& particles, double couplingTimeStep, const FindOutsideMesh& findOutsideMesh)
{
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        particles.state[particle].part = partOf(particles, particle, couplingTimeStep);
    }
    if (!findOutsideMesh)
    {
        return 0;
    }
    const std::vector<bool> outside = findOutsideMesh();
    label count = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        CouplingState& state = particles.state[particle];
        const Vector3d position = particles.position.col(particle);
        if (outside[static_cast<std::size_t>(particle)])
        {
            ++count;
            // What it still owes to the fluid is given to the cells where it was last.
            state.part = {0, state.lastInMesh - position, -1};
            particles.insertionRamp[particle] = 0;
        }
        else
        {
            state.lastInMesh = position + state.part.shift;
        }
    }
    return count;
}

double InsertionAndRemoval::start(
    const ParticlesView& particles, bool freshStart, const FindOutsideMesh& findOutsideMesh)
{
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        CouplingState& state = particles.state[particle];
        state.isNew = 0;
        state.lastInMesh = particles.position.col(particle);
        state.fluid.submergedFraction = 1;
        if (freshStart)
        {
            particles.insertionRamp[particle] = 1;
        }
    }
    outsideMesh_ = returnReduce(findParts(particles, couplingTimeStep_, findOutsideMesh), sumOp<label>());
    double inFluid = 0;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        CouplingState& state = particles.state[particle];
        state.fluid.submergedFraction = shareAfterRamp(particles.insertionRamp[particle]) * state.part.share;
        inFluid += volumeInFluid(particles, particle);
    }
    return returnReduce(inFluid, sumOp<scalar>());
}

void InsertionAndRemoval::advance(const ParticlesView& particles, int newFrom, double couplingTimeStep,
    const FindOutsideMesh& findOutsideMesh, RankTotals& totals)
{
    couplingTimeStep_ = couplingTimeStep;
    ParticleTransfer inserted;
    std::vector<ParticleTransfer> left(lastDeparted_.size());
    ParticleTransfer outOfMesh;
    departed_.clear();
    std::vector<PartWithin> partsBefore;
    std::vector<double> sharesBefore;
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        CouplingState& state = particles.state[particle];
        if (isNewParticle(particles, particle, newFrom))
        {
            state.isNew = 0;
            state.lastInMesh = particles.position.col(particle);
            state.fluid.submergedFraction = 1;
            particles.insertionRamp[particle] = 0;
            addParticle(inserted, particles.mass[particle], particles.velocity.col(particle));
        }
        partsBefore.push_back(state.part);
        sharesBefore.push_back(shareAfterRamp(particles.insertionRamp[particle]));
    }
    const label outsideHere = findParts(particles, couplingTimeStep, findOutsideMesh);
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        CouplingState& state = particles.state[particle];
        const PartWithin& part = state.part;
        PartWithin partBefore = partsBefore[static_cast<std::size_t>(particle)];
        const double before = sharesBefore[static_cast<std::size_t>(particle)];
        const double volume = sphereVolume(particles.radius[particle]);
        if (isOutsideMesh(state))
        {
            state.fluid.submergedFraction = 0;
            outOfMesh.particles += before * partBefore.share > 0 ? 1 : 0;
            outOfMesh.volume += before * partBefore.share * volume;
            continue;
        }
        if (!(partBefore.share > 0) && partBefore.outlet < 0)
        {
            // It has come back into the mesh.
            partBefore.share = part.share;
        }
        double& insertionRamp = particles.insertionRamp[particle];
        insertionRamp = std::min(1.0, insertionRamp + couplingTimeStep / insertionTime_);
        const double now = shareAfterRamp(insertionRamp);

        // A particle that has turned back is recorded at the outlet where it had begun to leave.
        const auto outlet = static_cast<label>(part.outlet < 0 ? partBefore.outlet : part.outlet);
        inserted.volume += (now - before) * partBefore.share * volume;
        if (outlet >= 0)
        {
            left[outlet].volume += now * (partBefore.share - part.share) * volume;
        }
        state.fluid.submergedFraction = now * part.share;
        if (!(part.share > 0))
        {
            departed_.push_back(
                {particles.id[particle], outlet, particles.mass[particle], particles.velocity.col(particle)});
        }
    }
    RankNumbers ofRank;
    append(ofRank, inserted);
    append(ofRank, outOfMesh);
    for (const ParticleTransfer& throughOutlet : left)
    {
        append(ofRank, throughOutlet);
    }
    ofRank.sums.push_back(outsideHere);
    ofRank.sums.push_back(static_cast<double>(departed_.size()));
    totals.add(ofRank, [this](const RankNumbers& all) { record(all); });
}

void InsertionAndRemoval::record(const RankNumbers& totals)
{
    lastInserted_ = transferIn(totals, 0);
    netVolume_ += lastInserted_.volume;
    std::size_t index = 2;
    for (ParticleTransfer& throughOutlet : lastDeparted_)
    {
        throughOutlet = transferIn(totals, index++);
        netVolume_ -= throughOutlet.volume;
    }
    const ParticleTransfer outOfMesh = transferIn(totals, 1);
    leftMesh_ += outOfMesh.particles;
    netVolume_ -= outOfMesh.volume;
    outsideMesh_ = static_cast<label>(totals.sums[index * numbersOfTransfer]);
    departedCount_ = static_cast<label>(totals.sums[index * numbersOfTransfer + 1]);
}

label InsertionAndRemoval::removeDeparted(DemEngine& engine)
{
    const label count = departedCount_;
    if (count == 0)
    {
        return count;
    }
    std::vector<int> ids;
    std::vector<ParticleTransfer> left(lastDeparted_.size());
    for (const DepartedParticle& particle : departed_)
    {
        ids.push_back(particle.id);
        addParticle(left[particle.outlet], particle.mass, particle.velocity);
    }
    RankNumbers ofRank;
    for (const ParticleTransfer& throughOutlet : left)
    {
        append(ofRank, throughOutlet);
    }
    const RankNumbers totals = RankTotals::of(ofRank);
    for (std::size_t outlet = 0; outlet < left.size(); ++outlet)
    {
        lastDeparted_[outlet] += transferIn(totals, outlet);
    }
    departed_.clear();
    departedCount_ = 0;
    engine.remove(ids);
    return count;
}

PartWithin InsertionAndRemoval::partOf(
    const ParticlesView& particles, Eigen::Index particle, double couplingTimeStep) const
{
    const double radius = particles.radius[particle];
    const double travel = couplingTimeStep * particles.velocity.col(particle).norm();
    PartWithin part;
    periodic_.forEachImage(outlets_.bounds(), particles.position.col(particle), ParticleOutlets::reach(radius, travel),
        [&](const Vector3d& image, const Eigen::Vector3i&) {
            const PartWithin ofImage = outlets_.partWithin(image, radius, travel);
            if (part.outlet < 0 || ofImage.share < part.share)
            {
                part = ofImage;
            }
        });
    return part;
}

} // namespace clepsydra
