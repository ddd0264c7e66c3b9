#include "engine/liggghts/liggghtsEngine.h"

#include "engine/liggghts/particleChecks.h"
#include "engine/liggghts/floatingPointTraps.h"
#include "engine/liggghts/hertzPairStyle.h"
#include "engine/liggghts/liggghtsProgram.h"
#include "engine/liggghts/outputFiles.h"
#include "engine/liggghts/restartFiles.h"
#include "engine/liggghts/rows.h"
#include "engine/liggghts/script.h"

#include <atom.h>
#include <atom_vec.h>
#include <fix_external.h>
#include <fix_gravity.h>
#include <fix_property_atom.h>
#include <fix_property_global.h>
#include <force.h>
#include <lammps.h>
#include <modify.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <pair.h>
#include <universe.h>
#include <update.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <sstream>
#include <unordered_set>
#include <vector>

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;

constexpr const char* stateFixId = "clepsydraState";
constexpr const char* forceFixId = "clepsydraForce";
constexpr const char* lastForceFixId = "clepsydraLastForces";
constexpr const char* memoryFixId = "clepsydraMemory";
constexpr const char* insertionRampFixId = "clepsydraInsertionRamp";

/// Whether LIGGGHTS reads the text as a number. std::stod would also take INF, NAN and 0x10, which are words of the
/// script.
bool isNumber(const std::string& text)
{
    if (text.find_first_not_of("0123456789.+-eE") != std::string::npos)
    {
        return false;
    }
    std::size_t used = 0;
    try
    {
        std::stod(text, &used);
    }
    catch (const std::exception&)
    {
        return false;
    }
    return used == text.size();
}

/// A value of several words as one token of a command.
std::string asToken(const std::string& value)
{
    return value.find_first_of(" \t") == std::string::npos ? value : '"' + value + '"';
}

/// Whether the fix moves its particles by the forces on them, and not as the script prescribes or not at all.
bool movesByForces(const lmp::Fix& fix)
{
    const std::string style = fix.style;
    const bool isMultisphere = style.rfind("multisphere", 0) == 0; // does not declare that it integrates
    return (fix.time_integrate == 1 && style != "move" && style.find("noforce") == std::string::npos) || isMultisphere;
}

} // namespace

class LiggghtsEngine::Implementation
{
public:
    explicit Implementation(const LiggghtsSetup& setup)
        : outputFiles_(setup.logFile, setup.outputs),
          program_(setup.logFile, setup.communicator, setup.onWarning)
    {
        registerHertzPairStyle();
        for (const auto& [name, value] : setup.variables)
        {
            const std::string style = isNumber(value) ? "equal" : "string";
            program_.execute("variable " + name + ' ' + style + ' ' + asToken(value), "DEM variables");
        }
        runScript(setup);
        requireSpheres();
        freshStart_ = setup.resumeFrom.empty();
        for (const GroupChange& change : setup.groupChanges)
        {
            groupChangers_.emplace_back(*program_, change);
        }
    }

    /// Executes a command of the script. LIGGGHTS gives no message where create_atoms creates no particle because its
    /// positions are outside the box.
    void executeOfScript(const ScriptCommand& command)
    {
        const auto before = program_->atom->natoms;
        program_.execute(command.text, command.where);
        commands_.push_back({program_.withVariables(command.text), command.where});
        if (isCommand(command.text, "create_atoms") && program_->atom->natoms == before)
        {
            throw DemEngineError(command.where + ": '" + command.text + "'" + program_.valuesIn(command.text)
                                 + " made no particle; allowed: positions in " + boxText(*program_));
        }
    }

    void checkStart()
    {
        if (freshStart_)
        {
            requireNoDeepOverlap(*program_, pairs());
        }
        particleCount_ = program_->atom->natoms;
    }

    /// Examines the particles that have been inserted since the last call.
    void checkInsertion()
    {
        const lmp::Atom& atom = *program_->atom;
        const bool inserted = atom.natoms > particleCount_;
        particleCount_ = atom.natoms;
        if (!inserted || !stateFix_)
        {
            return;
        }
        std::vector<bool> isNew;
        for (int particle = 0; particle < atom.nlocal; ++particle)
        {
            const double* const state = stateFix_->array_atom[particle];
            isNew.push_back(std::equal(stateOfNewParticle_.begin(), stateOfNewParticle_.end(), state));
        }
        if (std::find(isNew.begin(), isNew.end(), true) != isNew.end())
        {
            requireNoDeepOverlap(*program_, pairs(), isNew);
        }
    }

    void run(int steps)
    {
        const int before = program_->atom->nlocal;
        const double timeStep = program_->update->dt;
        try
        {
            program_.execute("run " + std::to_string(steps) + " pre no post no", "DEM steps of a coupling step");
            requireFiniteForces(*program_);
            if (!forces_)
            {
                checkInsertion();
            }
            outputFiles_.requireWritten();
        }
        catch (const DemEngineError& error)
        {
            // LIGGGHTS' own message would be about atom types. Where some particles are left it continues, and
            // ParticleCensus names the missing ones.
            if (before > 0 && program_->atom->nlocal == 0)
            {
                throw DemEngineError("No particle is left of the " + std::to_string(before)
                                     + " that were on a rank: " + lastParticleText(*program_)
                                     + ". The cause is a missing wall where it moves as a free particle does, and an "
                                       "unstable force where it is much faster; allowed: a wall in the DEM script "
                                       "wherever the fluid has one, and a DEM step and a coupling step that are short "
                                       "enough");
            }
            throw;
        }
        if (program_->update->dt != timeStep)
        {
            std::ostringstream message;
            message << "The script changes the DEM step during the run, from " << timeStep << " s to "
                    << program_->update->dt << " s; allowed: a DEM step that remains the same, because a coupling step "
                    << "is a number of DEM steps";
            throw DemEngineError(message.str());
        }
    }

    const std::vector<ScriptCommand>& commands() const
    {
        return commands_;
    }

    void requestState(const std::vector<double>& ofNewParticle)
    {
        stateOfNewParticle_ = ofNewParticle;
    }

    void addState()
    {
        if (stateOfNewParticle_.empty())
        {
            return;
        }
        // property/atom <name> <style> <restart> <ghost> <reverse> <defaults ...>
        std::string command =
            std::string("fix ") + stateFixId + " all property/atom " + stateFixId + " vector no no no";
        for (const double value : stateOfNewParticle_)
        {
            command += ' ' + std::to_string(value);
        }
        // LIGGGHTS warns of so many values per particle.
        program_.execute(command, "coupling state", LiggghtsProgram::Warnings::dropped);
        stateFix_ = program_->modify->find_fix_property(
            stateFixId, "property/atom", "vector", static_cast<int>(stateOfNewParticle_.size()), 0, "coupling");
    }

    /// The property is part of LIGGGHTS' restart files. Particles in files that do not have it get the value 1.
    void addInsertionRamp()
    {
        program_.execute(std::string("fix ") + insertionRampFixId + " all property/atom " + insertionRampFixId
                             + " scalar yes no no 1.",
            "particles that come in");
        insertionRampFix_ =
            program_->modify->find_fix_property(insertionRampFixId, "property/atom", "scalar", 0, 0, "coupling");
    }

    void addGroupChanges()
    {
        for (const GroupChanger& changer : groupChangers_)
        {
            const std::string command = changer.propertyCommand();
            if (!command.empty())
            {
                program_.execute(command, "group changes");
            }
        }
    }

    void changeGroups(double elapsed)
    {
        for (GroupChanger& changer : groupChangers_)
        {
            changer.apply(elapsed);
        }
    }

    void addFluidForce(FluidForces* forces)
    {
        forces_ = forces;
        program_.execute(std::string("fix ") + forceFixId + " all external pf/callback 1 1", "fluid force");
        lmp::Modify& modify = *program_->modify;
        auto* external = static_cast<lmp::FixExternal*>(modify.fix[modify.find_fix(forceFixId)]);
        external->set_callback(&Implementation::fluidForceCallback, this);
        std::for_each(modify.fix, modify.fix + modify.nfix, [this](const lmp::Fix* fix) {
            movingGroups_ |= movesByForces(*fix) ? fix->groupbit : 0;
            frozenGroups_ |= std::string(fix->style) == "freeze" ? fix->groupbit : 0;
        });
    }

    /// The property is part of LIGGGHTS' restart files.
    void addLastForces()
    {
        program_.execute(std::string("fix ") + lastForceFixId + " all property/atom " + lastForceFixId
                             + " vector yes no no 0. 0. 0. 0. 0. 0.",
            "forces of the last step");
        lastForceFix_ =
            program_->modify->find_fix_property(lastForceFixId, "property/atom", "vector", 6, 0, "coupling");
        lastForcesKnown_ = !freshStart_;
    }

    /// Forces on particles in rows 0 to 2, torques in rows 3 to 5.
    Eigen::Map<Eigen::Matrix<double, 6, Eigen::Dynamic>> lastForces()
    {
        return {firstElement(lastForceFix_->array_atom), 6, program_->atom->nlocal};
    }

    /// Stores the forces with which the next step begins. At a new `run`, and in a resumed process, LIGGGHTS would
    /// compute others: from the velocities at the end of a step, whereas damping and drag of the last step used those
    /// in its middle.
    void storeForces()
    {
        const lmp::Atom& atom = *program_->atom;
        lastForces().topRows<3>() = ConstVectors(firstElement(atom.f), 3, atom.nlocal);
        lastForces().bottomRows<3>() = ConstVectors(firstElement(atom.torque), 3, atom.nlocal);
        lastForcesKnown_ = true;
    }

    void prepare()
    {
        program_.execute("run 0 post no", "preparing");
        requireFiniteForces(*program_);
        if (lastForcesKnown_)
        {
            const lmp::Atom& atom = *program_->atom;
            Vectors(firstElement(atom.f), 3, atom.nlocal) = lastForces().topRows<3>();
            Vectors(firstElement(atom.torque), 3, atom.nlocal) = lastForces().bottomRows<3>();
        }
    }

    void evaluateFluidForces()
    {
        lastForcesKnown_ = false;
        reevaluatesFluidForces_ = true;
        prepare();
        reevaluatesFluidForces_ = false;
        storeForces();
    }

    /// Particles that `groupChanges` has put to rest are in no group that moves.
    void findFixedParticles()
    {
        const lmp::Atom& atom = *program_->atom;
        fixed_.resize(atom.nlocal);
        std::transform(atom.mask, atom.mask + atom.nlocal, fixed_.begin(),
            [this](int groups) { return (groups & movingGroups_) == 0 || (groups & frozenGroups_) != 0; });
    }

    /// `fix freeze` has cleared all forces except the fluid's, which are added after it.
    void clearForceOnFixedParticles(Vectors force) const
    {
        for (Eigen::Index particle = 0; frozenGroups_ != 0 && particle < force.cols(); ++particle)
        {
            if (fixed_[particle])
            {
                force.col(particle).setZero();
            }
        }
    }

    void requestPairs(double reach)
    {
        needsPairs_ = true;
        // Widens the neighbour lists in addition to the skin, so that the distance which particles may move between two
        // lists is not reduced.
        program_->neighbor->register_contact_dist_factor(1 + reach);
    }

    /// LIGGGHTS searches particles and fixes for the first material, and stops where it finds none, as when all
    /// particles have left. A particle template provides the material; its radius has no effect because there are no
    /// particles.
    void allowNoParticles()
    {
        const lmp::Modify& modify = *program_->modify;
        const bool found =
            std::any_of(modify.fix, modify.fix + modify.nfix, [](lmp::Fix* fix) { return fix->min_type() == 1; });
        if (program_->atom->natoms > 0 || found)
        {
            return;
        }
        program_.execute(
            "fix clepsydraTemplate all particletemplate/sphere 10007 atom_type 1 density constant 1. radius constant "
                + std::to_string(program_->neighbor->skin),
            "no particles");
        program_.execute(
            "fix clepsydraTemplates all particledistribution/discrete 10009 1 clepsydraTemplate 1.", "no particles");
    }

    /// Deletes atoms in the same way as LIGGGHTS' own fixes.
    void remove(const std::vector<int>& ids)
    {
        const FloatingPointTraps none(0);
        lmp::Atom& atom = *program_->atom;
        // The contact histories are copied from the neighbour lists to the particles, while the lists still correspond
        // to the particles.
        program_->modify->setup_pre_exchange();
        const std::unordered_set<int> leaving(ids.begin(), ids.end());
        for (int particle = 0; particle < atom.nlocal;)
        {
            if (leaving.count(atom.tag[particle]) == 0)
            {
                ++particle;
                continue;
            }
            constexpr int deleting = 1;
            atom.avec->copy(--atom.nlocal, particle, deleting);
        }
        const lmp::bigint here = atom.nlocal;
        MPI_Allreduce(&here, &atom.natoms, 1, MPI_LMP_BIGINT, MPI_SUM, program_->world);
        particleCount_ = atom.natoms;
        // Copies of removed particles must not be found.
        atom.nghost = 0;
        if (atom.map_style != 0)
        {
            atom.map_init();
            atom.map_set();
        }
        allowNoParticles();
    }

    void requestMemory(int numbers)
    {
        memorySize_ = numbers;
    }

    /// Unlike the state, the property is part of LIGGGHTS' restart files.
    void addMemory()
    {
        if (memorySize_ == 0)
        {
            return;
        }
        std::string command =
            std::string("fix ") + memoryFixId + " all property/atom " + memoryFixId + " vector yes no no";
        for (int number = 0; number < memorySize_; ++number)
        {
            command += " 0.";
        }
        program_.execute(command, "memory of forces", LiggghtsProgram::Warnings::dropped);
        memoryFix_ =
            program_->modify->find_fix_property(memoryFixId, "property/atom", "vector", memorySize_, 0, "coupling");
    }

    ParticlesView particles()
    {
        lmp::Atom& atom = *program_->atom;
        const Eigen::Index count = atom.nlocal;
        return ParticlesView{ConstView<int>(atom.tag, count), ConstVectors(firstElement(atom.x), 3, count),
            ConstVectors(firstElement(atom.v), 3, count), ConstVectors(firstElement(atom.omega), 3, count),
            ConstView<double>(atom.radius, count), ConstView<double>(atom.rmass, count),
            stateFix_ ? reinterpret_cast<CouplingState*>(firstElement(stateFix_->array_atom)) : nullptr,
            ConstVectors(firstElement(atom.f), 3, count), ParticlePairs{},
            memoryFix_ ? firstElement(memoryFix_->array_atom) : nullptr, memorySize_, true, ConstView<bool>(nullptr, 0),
            insertionRampFix_->vector_atom};
    }

    /// LIGGGHTS' own list. It is a half list; with `newton off`, pairs across ranks are on both ranks.
    ParticlePairs pairs()
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
            ConstView<double>(atom.radius, count),
            Eigen::Map<const Eigen::Matrix2Xi>(pairList_.empty() ? nullptr : pairList_.front().data(), 2,
                static_cast<Eigen::Index>(pairList_.size()))};
    }

    /// LIGGGHTS writes again, in a resumed run, what it had written at the step of the checkpoint.
    void continueOutputs()
    {
        outputFiles_.cutToCheckpoint();
    }

    std::vector<EngineOutput> outputs()
    {
        return outputFiles_.outputs();
    }

    LiggghtsProgram& program()
    {
        return program_;
    }

    /// Particles with a radius and a mass each, which the coupling reads from LIGGGHTS' arrays.
    void requireSpheres() const
    {
        const lmp::Atom& atom = *program_->atom;
        if (atom.radius_flag == 0 || atom.rmass_flag == 0)
        {
            throw DemEngineError(
                std::string("The script's particles have the atom_style '") + atom.atom_style
                + "', which gives them no radius or no mass of their own; allowed: atom_style granular");
        }
    }

private:
    void runScript(const LiggghtsSetup& setup)
    {
        const std::filesystem::path& resumeFrom = setup.resumeFrom;
        bool boxMade = false;
        for (ScriptCommand& command : readScript(setup.script, setup.variables))
        {
            if (setup.writesNothing && writesFiles(command.text))
            {
                continue;
            }
            if (setup.writesNothing)
            {
                command.text = withoutFiles(command.text);
            }
            if (!resumeFrom.empty() && hasArgument(command.text, "overwrite"))
            {
                // Such a file is replaced as a whole each time.
                outputFiles_.beginAgain(argumentAfter(program_.withVariables(command.text), "file"));
            }
            const OnResume onResume = whatOnResume(command.text);
            if (resumeFrom.empty() || onResume == OnResume::repeat || onResume == OnResume::unknown)
            {
                requireUndamagedInput(program_, command);
                executeOfScript(command);
            }
            else if (onResume == OnResume::takeFromCheckpoint && !boxMade)
            {
                program_.execute("read_restart " + resumeFrom.string(), command.where + ", resumed");
                boxMade = true;
            }
            if (onResume == OnResume::unknown)
            {
                // After LIGGGHTS, which has its own message for a command that does not exist.
                throw DemEngineError(command.where + ": '" + command.text
                                     + "'; allowed: commands of which this program knows whether a resumed run must "
                                       "repeat them");
            }
        }
    }

    /// The values of variables are looked up only where they are needed, because that may draw random numbers.
    OnResume whatOnResume(const std::string& command) const
    {
        return onResume(!command.empty() && command.front() == '$' ? program_.withVariables(command) : command);
    }

    static void fluidForceCallback(void* self, lmp::bigint, int, int*, double**, double** force)
    {
        auto& engine = *static_cast<Implementation*>(self);
        requireFiniteForces(*engine.program_);
        const FloatingPointTraps asOutside(engine.program_.trapsOutside());
        const ParticlesView own = engine.particles();
        Vectors ofFluid(firstElement(force), 3, own.size());
        const bool preparing = engine.program_->update->setupflag != 0;
        if (preparing && !engine.reevaluatesFluidForces_)
        {
            ofFluid.setZero();
            return;
        }
        if (!preparing)
        {
            engine.checkInsertion();
        }
        engine.findFixedParticles();
        const ParticlesView particles{own.id, own.position, own.velocity, own.angularVelocity, own.radius, own.mass,
            own.state, own.otherForce, engine.needsPairs_ ? engine.pairs() : ParticlePairs{},
            engine.memoryFix_ ? firstElement(engine.memoryFix_->array_atom) : nullptr, engine.memorySize_, !preparing,
            ConstView<bool>(engine.fixed_.data(), own.size()), nullptr,
            Vectors(firstElement(engine.program_->atom->torque), 3, own.size())};
        engine.forces_->evaluate(particles, engine.program_->update->dt, ofFluid);
        engine.clearForceOnFixedParticles(ofFluid);
    }

    OutputFiles outputFiles_;
    LiggghtsProgram program_;
    std::vector<ScriptCommand> commands_;
    lmp::Fix* stateFix_ = nullptr;
    std::vector<double> stateOfNewParticle_;
    FluidForces* forces_ = nullptr;
    lmp::Fix* lastForceFix_ = nullptr;
    bool lastForcesKnown_ = false;
    bool reevaluatesFluidForces_ = false;
    /// Groups whose particles are moved by forces, and groups whose particles are frozen by a fix.
    int movingGroups_ = 0;
    int frozenGroups_ = 0;
    Eigen::Array<bool, Eigen::Dynamic, 1> fixed_;
    bool needsPairs_ = false;
    lmp::Fix* memoryFix_ = nullptr;
    int memorySize_ = 0;
    lmp::Fix* insertionRampFix_ = nullptr;
    std::vector<std::array<int, 2>> pairList_;
    std::vector<GroupChanger> groupChangers_;
    bool freshStart_ = true;
    /// Of all ranks when overlaps were last examined.
    lmp::bigint particleCount_ = 0;
};

LiggghtsEngine::LiggghtsEngine(const LiggghtsSetup& setup)
    : implementation_(std::make_unique<Implementation>(setup))
{}

LiggghtsEngine::~LiggghtsEngine() = default;

ScriptFacts LiggghtsEngine::scriptFacts() const
{
    return factsOf(implementation_->program(), implementation_->commands());
}

std::vector<ScriptCommand> LiggghtsEngine::unreadProperties() const
{
    return clepsydra::unreadProperties(implementation_->program(), implementation_->commands());
}

void LiggghtsEngine::requestPairs(double reach)
{
    implementation_->requestPairs(reach);
}

void LiggghtsEngine::requestState(const std::vector<double>& ofNewParticle)
{
    implementation_->requestState(ofNewParticle);
}

void LiggghtsEngine::requestMemory(int numbers)
{
    implementation_->requestMemory(numbers);
}

void LiggghtsEngine::initialise(FluidForces* forces)
{
    implementation_->addState();
    implementation_->addInsertionRamp();
    implementation_->addMemory();
    implementation_->addLastForces();
    implementation_->addGroupChanges();
    if (forces)
    {
        implementation_->addFluidForce(forces);
    }
    requireNoNegativeFriction(*implementation_->program());
    // ParticleCensus finds and reports lost particles with their ids; LIGGGHTS would end the process.
    implementation_->program().execute("thermo_modify lost ignore flush yes", "initialise");
    requireParticlesInBox(*implementation_->program());
    implementation_->allowNoParticles();
    prepare();
    implementation_->continueOutputs();
    implementation_->checkStart();
}

void LiggghtsEngine::prepare()
{
    implementation_->prepare();
}

void LiggghtsEngine::evaluateFluidForces()
{
    implementation_->evaluateFluidForces();
}

void LiggghtsEngine::advance(int steps)
{
    implementation_->run(steps);
    implementation_->storeForces();
    implementation_->changeGroups(steps * timeStep());
}

void LiggghtsEngine::remove(const std::vector<int>& ids)
{
    implementation_->remove(ids);
}

ParticlesView LiggghtsEngine::particles()
{
    return implementation_->particles();
}

double LiggghtsEngine::timeStep() const
{
    return implementation_->program()->update->dt;
}

Vector3d LiggghtsEngine::gravity() const
{
    Vector3d acceleration = Vector3d::Zero();
    const lmp::Modify& modify = *implementation_->program()->modify;
    std::for_each(modify.fix, modify.fix + modify.nfix, [&](lmp::Fix* fix) {
        if (std::string(fix->style) == "gravity")
        {
            // The fix computes its components in init(), which LIGGGHTS itself calls only before the first step.
            fix->init();
            Vector3d ofFix = Vector3d::Zero();
            static_cast<lmp::FixGravity*>(fix)->get_gravity(ofFix.data());
            acceleration += ofFix;
        }
    });
    return acceleration;
}

std::vector<ContactMaterial> LiggghtsEngine::contactMaterials() const
{
    lmp::Modify& modify = *implementation_->program()->modify;
    const int materialCount = implementation_->program()->atom->ntypes;
    const auto property = [&](const char* name) {
        return static_cast<lmp::FixPropertyGlobal*>(
            modify.find_fix_property(name, "property/global", "peratomtype", materialCount, 0, "coupling", false));
    };
    auto* const youngsModulus = property("youngsModulus");
    auto* const poissonRatio = property("poissonsRatio");
    std::vector<ContactMaterial> materials;
    if (youngsModulus && poissonRatio)
    {
        for (int material = 0; material < materialCount; ++material)
        {
            materials.push_back({youngsModulus->compute_vector(material), poissonRatio->compute_vector(material)});
        }
    }
    return materials;
}

std::vector<std::filesystem::path> LiggghtsEngine::writeCheckpoint(const std::filesystem::path& name)
{
    return writeRestart(implementation_->program(), name);
}

std::vector<EngineOutput> LiggghtsEngine::outputs()
{
    return implementation_->outputs();
}

std::string LiggghtsEngine::version() const
{
    return std::string("LIGGGHTS ") + implementation_->program()->universe->version;
}

} // namespace clepsydra
