#include "engine/liggghts/liggghtsParticles.h"

#include "engine/liggghts/liggghtsProgram.h"
#include "engine/liggghts/rows.h"
#include "engine/liggghts/scriptFacts.h"

#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <force.h>
#include <lammps.h>
#include <modify.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <pair.h>

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

namespace clepsydra
{

namespace lmp = LAMMPS_NS;

void LiggghtsParticles::requestPairs(double reach, std::size_t ofState)
{
    if (program_->force->pair == nullptr)
    {
        throw DemEngineError("'lubricationForce' in couplingProperties acts between near particles, of which LIGGGHTS "
                             "has no list with pair_style none; allowed: pair_style gran");
    }
    indexInState_ = ofState;
    // Widens the neighbour lists in addition to the skin, so that the distance which particles may move between two lists
    // is not reduced.
    program_->neighbor->register_contact_dist_factor(1 + reach);
}

void LiggghtsParticles::requestState(const std::vector<double>& ofNewParticle)
{
    stateOfNewParticle_ = ofNewParticle;
}

void LiggghtsParticles::requestMemory(int numbers)
{
    memorySize_ = numbers;
}

void LiggghtsParticles::addProperties(bool resumed)
{
    using InRestartFiles = ParticleProperty::InRestartFiles;
    if (!stateOfNewParticle_.empty())
    {
        state_.emplace(program_, "clepsydraState", stateOfNewParticle_, InRestartFiles::no);
    }
    if (pairsRequested())
    {
        ofState_.emplace(
            program_, "clepsydraOfState", std::vector<double>{0}, InRestartFiles::no, ParticleProperty::OnCopies::yes);
    }
    // Particles in files that do not have the ramp are in the fluid.
    insertionRamp_.emplace(program_, "clepsydraInsertionRamp", std::vector<double>{1}, InRestartFiles::yes);
    if (memorySize_ > 0)
    {
        addMemory(resumed);
    }
    if (heat_)
    {
        addTemperatures(resumed);
    }
}

void LiggghtsParticles::addMemory(bool resumed)
{
    // With its size in the name, LIGGGHTS does not read the memory of other forces into this one.
    const std::string name = "clepsydraMemory" + std::to_string(memorySize_);
    const std::vector<double> zeros(static_cast<std::size_t>(memorySize_), 0.0);
    memory_.emplace(program_, name, zeros, ParticleProperty::InRestartFiles::yes);
    if (!resumed)
    {
        std::fill_n(memory_->values(), static_cast<std::ptrdiff_t>(memorySize_) * program_->atom->nlocal, 0.0);
    }
    else if (!program_->modify->have_restart_data(program_->modify->find_fix_id(name.c_str())))
    {
        throw DemEngineError("The checkpoint does not hold, for each particle, the memory of the forces of "
                             "couplingProperties: 'historyForce' or 'turbulentDispersion' was added or removed, or an "
                             "earlier version wrote it; allowed: the forces of the stopped run, or a fresh start");
    }
}

void LiggghtsParticles::requestTemperatures(const HeatOfParticles& heat)
{
    heat_ = heat;
}

void LiggghtsParticles::addTemperatures(bool resumed)
{
    temperature_ = heat_->temperature ? ParticleProperty(
                       program_, temperatureName, {*heat_->temperature}, ParticleProperty::InRestartFiles::yes)
                                      : ParticleProperty(program_, temperatureName);
    specificHeats_ = heat_->specificHeat
                         ? std::vector<double>(static_cast<std::size_t>(program_->atom->ntypes), *heat_->specificHeat)
                         : specificHeatsOf(program_);
    if (heat_->temperature && !resumed)
    {
        warnOfStoredTemperatures();
    }
}

void LiggghtsParticles::warnOfStoredTemperatures()
{
    const ConstView<double> here(temperature_->values(), program_->atom->nlocal);
    // The highest one, and the lowest one with the opposite sign.
    std::array<double, 2> extremes{-std::numeric_limits<double>::max(), -std::numeric_limits<double>::max()};
    if (here.size() > 0)
    {
        extremes = {here.maxCoeff(), -here.minCoeff()};
    }
    MPI_Allreduce(MPI_IN_PLACE, extremes.data(), 2, MPI_DOUBLE, MPI_MAX, program_->world);
    const double highest = extremes[0];
    const double lowest = -extremes[1];
    const double asked = *heat_->temperature;
    if (program_->comm->me == 0 && (highest > asked || lowest < asked))
    {
        std::ostringstream text;
        text << "Particles that the DEM script reads keep the temperatures of their file, " << lowest << " to "
             << highest << " K; entry 'particleTemperature' of energy in constant/couplingProperties, " << asked
             << " K, is for all others. Allowed without this warning: an entry equal to theirs, or a file that was "
             << "written without 'energy'";
        program_.warn(text.str());
    }
}

TemperaturesView LiggghtsParticles::temperatures()
{
    const lmp::Atom& atom = *program_->atom;
    heatCapacities_.resize(static_cast<std::size_t>(atom.nlocal));
    for (int particle = 0; particle < atom.nlocal; ++particle)
    {
        heatCapacities_[static_cast<std::size_t>(particle)] =
            atom.rmass[particle] * specificHeats_[static_cast<std::size_t>(atom.type[particle] - 1)];
    }
    return {View<double>(temperature_->values(), atom.nlocal), ConstView<double>(heatCapacities_.data(), atom.nlocal)};
}

ParticlesView LiggghtsParticles::view(
    const ParticlePairs& pairs, bool advancesMemory, const ConstView<bool>& fixed) const
{
    lmp::Atom& atom = *program_->atom;
    const Eigen::Index count = atom.nlocal;
    return ParticlesView{ConstView<int>(atom.tag, count), ConstVectors(firstElement(atom.x), 3, count),
        ConstVectors(firstElement(atom.v), 3, count), ConstVectors(firstElement(atom.omega), 3, count),
        ConstView<double>(atom.radius, count), ConstView<double>(atom.rmass, count),
        state_ ? reinterpret_cast<CouplingState*>(state_->values()) : nullptr,
        ConstVectors(firstElement(atom.f), 3, count), pairs, memory_ ? memory_->values() : nullptr, memorySize_,
        advancesMemory, fixed, insertionRamp_->values(), Vectors(firstElement(atom.torque), 3, count)};
}

Vector3d LiggghtsParticles::unwrappedPosition(Eigen::Index particle) const
{
    const lmp::Atom& atom = *program_->atom;
    Vector3d position;
    program_->domain->unmap(atom.x[particle], atom.image[particle], position.data());
    return position;
}

ParticlePairs LiggghtsParticles::pairs()
{
    pairList_.clear();
    lmp::NeighList* const neighbours = program_->force->pair ? program_->force->pair->list : nullptr;
    for (int i = 0; neighbours && i < neighbours->inum; ++i)
    {
        const int particle = neighbours->ilist[i];
        for (int j = 0; j < neighbours->numneigh[particle]; ++j)
        {
            pairList_.push_back({particle, neighbours->firstneigh[particle][j] & NEIGHMASK});
        }
    }
    lmp::Atom& atom = *program_->atom;
    const Eigen::Index count = atom.nlocal + atom.nghost;
    return ParticlePairs{ConstVectors(firstElement(atom.x), 3, count), ConstVectors(firstElement(atom.v), 3, count),
        ConstView<double>(atom.radius, count), ConstView<double>(nullptr, 0),
        Eigen::Map<const Eigen::Matrix2Xi>(
            pairList_.empty() ? nullptr : pairList_.front().data(), 2, static_cast<Eigen::Index>(pairList_.size()))};
}

ParticlePairs LiggghtsParticles::pairsWithState()
{
    const double* state = state_->values() + *indexInState_;
    double* const ofState = ofState_->values();
    for (int particle = 0; particle < program_->atom->nlocal; ++particle, state += stateOfNewParticle_.size())
    {
        ofState[particle] = *state;
    }
    ofState_->sendToCopies();
    const ParticlePairs found = pairs();
    return {found.position, found.velocity, found.radius, ConstView<double>(ofState, found.radius.size()), found.list};
}

std::vector<bool> LiggghtsParticles::areNew() const
{
    std::vector<bool> isNew;
    const double* state = state_ ? state_->values() : nullptr;
    for (int particle = 0; state && particle < program_->atom->nlocal; ++particle)
    {
        isNew.push_back(std::equal(stateOfNewParticle_.begin(), stateOfNewParticle_.end(), state));
        state += stateOfNewParticle_.size();
    }
    return isNew;
}

} // namespace clepsydra
