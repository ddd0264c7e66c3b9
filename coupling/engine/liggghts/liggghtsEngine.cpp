#include "engine/liggghts/liggghtsEngine.h"

#include "engine/liggghts/floatingPointTraps.h"
#include "engine/liggghts/hertzPairStyle.h"
#include "engine/liggghts/liggghtsErrors.h"
#include "engine/liggghts/script.h"
#include "files/wholeFile.h"

#include <atom.h>
#include <atom_vec.h>
#include <comm.h>
#include <domain.h>
#include <error.h>
#include <fix_external.h>
#include <fix_gravity.h>
#include <fix_insert_pack.h>
#include <fix_property_atom.h>
#include <fix_property_global.h>
#include <force.h>
#include <input.h>
#include <lammps.h>
#include <modify.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <output.h>
#include <pair.h>
#include <universe.h>
#include <update.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <list>
#include <sstream>
#include <unordered_set>

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;

constexpr const char* stateFixId = "clepsydraState";
constexpr const char* forceFixId = "clepsydraForce";
constexpr const char* lastForceFixId = "clepsydraLastForces";
constexpr const char* memoryFixId = "clepsydraMemory";
constexpr const char* introducedFixId = "clepsydraIntroduced";

std::string placeText(const double* place)
{
    std::ostringstream text;
    text << '(' << place[0] << ' ' << place[1] << ' ' << place[2] << ") m";
    return text.str();
}

/// First element of a LIGGGHTS array of rows, which its memory manager allocates in one piece.
template<class T>
T* firstElement(T** rows)
{
    return rows ? rows[0] : nullptr;
}

bool isNumber(const std::string& text)
{
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

/// A restart file begins with two numbers of four bytes and the text "Version LIGGGHTS-...". False for one that cannot be
/// read: LIGGGHTS says that.
bool isOtherThanRestart(const std::string& file)
{
    const std::string begin = "Version LIGGGHTS";
    constexpr std::size_t numbers = 8;
    std::ifstream stream(file, std::ios::binary);
    std::string found(numbers + begin.size(), ' ');
    return stream
           && (!stream.read(found.data(), static_cast<std::streamsize>(found.size()))
               || found.substr(numbers) != begin);
}

/// A restart's name with something in place of its `%`.
std::filesystem::path restartFile(std::string name, const std::string& part)
{
    return name.replace(name.find('%'), 1, part);
}

bool isInParts(const std::filesystem::path& restart)
{
    return restart.string().find('%') != std::string::npos;
}

/// What LIGGGHTS' write_restart writes on one rank.
std::vector<std::filesystem::path> filesWritten(const std::filesystem::path& restart, int rank)
{
    std::vector<std::filesystem::path> files;
    if (rank == 0)
    {
        files.push_back(isInParts(restart) ? restartFile(restart, "base") : restart);
    }
    if (isInParts(restart))
    {
        files.push_back(restartFile(restart, std::to_string(rank)));
    }
    return files;
}

/// What LIGGGHTS' read_restart reads on one of so many ranks. Before that it reads the base, for all.
std::vector<std::filesystem::path> filesRead(const std::filesystem::path& restart, int rank, int ranks)
{
    std::vector<std::filesystem::path> files{isInParts(restart) ? restartFile(restart, "base") : restart};
    const auto part = [&] { return restartFile(restart, std::to_string(rank)); };
    for (; isInParts(restart) && std::filesystem::exists(part()); rank += ranks)
    {
        files.push_back(part());
    }
    return files;
}

/// By the forces on its beads, not as the script states or not at all.
bool movesByForces(const lmp::Fix& fix)
{
    const std::string style = fix.style;
    const bool isMultisphere = style.rfind("multisphere", 0) == 0; // does not say that it integrates
    return (fix.time_integrate == 1 && style != "move" && style.find("noforce") == std::string::npos) || isMultisphere;
}

/// Measures an insertion's region by random numbers, the same ones that then place the beads: what LIGGGHTS does once in each
/// process.
struct InsertionRegion : lmp::FixInsertPack
{
    static void measure(lmp::FixInsertPack& fix)
    {
        (fix.*&InsertionRegion::calc_region_volume_local)();
    }
};

lmp::Fix* findFixOfStyle(const lmp::Modify& modify, const std::string& style)
{
    lmp::Fix** const end = modify.fix + modify.nfix;
    lmp::Fix** const found = std::find_if(modify.fix, end, [&](const lmp::Fix* fix) { return fix->style == style; });
    return found == end ? nullptr : *found;
}

} // namespace

class LiggghtsEngine::Implementation
{
public:
    explicit Implementation(const LiggghtsSetup& setup)
        : communicator_(setup.communicator)
    {
        requireLiggghtsErrorReplacements();
        start(setup.logFile);
        registerHertzPairStyle();
        for (const auto& [name, value] : setup.variables)
        {
            const std::string style = isNumber(value) ? "equal" : "string";
            execute("variable " + name + ' ' + style + ' ' + value, "DEM variables");
        }
        runScript(setup);
        fresh_ = setup.resumeFrom.empty();
        for (const GroupChange& change : setup.groupChanges)
        {
            groupChangers_.emplace_back(*program_, change);
        }
    }

    ~Implementation()
    {
        // After an error LIGGGHTS is in the middle of a command: its destructors may wait for other ranks.
        if (failed_)
        {
            static_cast<void>(program_.release());
        }
    }

    /// One LIGGGHTS command; \param where  named in the error.
    void execute(const std::string& command, const std::string& where)
    {
        const FloatingPointTraps none(0);
        trapsOutside_ = none.before();
        try
        {
            program_->input->one(command.c_str());
        }
        catch (const DemEngineError&)
        {
            failed_ = true;
            throw;
        }
        catch (const LiggghtsStopped& stopped)
        {
            failed_ = true;
            std::string message =
                where + ": LIGGGHTS stopped at '" + command + "'" + valuesIn(command) + ": " + stopped.what();
            if (stopped.onOneRankOnly())
            {
                message += " (reported by one rank)";
            }
            throw DemEngineError(message);
        }
    }

    /// A command of the script. LIGGGHTS makes no bead that is outside the box, and says nothing.
    void executeOfScript(const ScriptCommand& command)
    {
        const auto before = program_->atom->natoms;
        execute(command.text, command.where);
        if (isCommand(command.text, "create_atoms") && program_->atom->natoms == before)
        {
            throw DemEngineError(command.where + ": '" + command.text + "'" + valuesIn(command.text)
                                 + " made no bead; allowed: places in " + boxText());
        }
    }

    /// LIGGGHTS forgets beads outside the box without a word.
    void checkBeadsAreInBox() const
    {
        const lmp::Domain& domain = *program_->domain;
        const lmp::Atom& atom = *program_->atom;
        for (int bead = 0; bead < atom.nlocal; ++bead)
        {
            for (int axis = 0; axis < 3; ++axis)
            {
                const double x = atom.x[bead][axis];
                if (domain.periodicity[axis] == 0 && !(x >= domain.boxlo[axis] && x <= domain.boxhi[axis]))
                {
                    throw DemEngineError("Bead " + std::to_string(atom.tag[bead]) + " at " + placeText(atom.x[bead])
                                         + " lies outside the DEM box; allowed: places in " + boxText());
                }
            }
        }
    }

    /// Beads that start deep in each other fly apart as from an explosion.
    void checkOverlaps()
    {
        constexpr double largestPart = 0.1;
        const BeadPairs near = pairs();
        for (Eigen::Index pair = 0; fresh_ && pair < near.list.cols(); ++pair)
        {
            const int i = near.list(0, pair);
            const int j = near.list(1, pair);
            const double smaller = 2 * std::min(near.radius[i], near.radius[j]);
            const double overlap =
                near.radius[i] + near.radius[j] - (near.position.col(i) - near.position.col(j)).norm();
            if (overlap > largestPart * smaller)
            {
                const lmp::Atom& atom = *program_->atom;
                std::ostringstream message;
                message << "Beads " << atom.tag[i] << " and " << atom.tag[j] << " at " << placeText(atom.x[i])
                        << " and " << placeText(atom.x[j]) << " overlap by " << overlap << " m, " << overlap / smaller
                        << " of the smaller one's diameter; allowed at the start: at most " << largestPart;
                throw DemEngineError(message.str());
            }
        }
    }

    /// Where all else but the fluid has given a bead a force (or a place) that is no number.
    void checkFinite() const
    {
        const lmp::Atom& atom = *program_->atom;
        const FloatingPointTraps none(0);
        const Eigen::Index count = 3L * atom.nlocal;
        if (atom.nlocal == 0
            || std::isfinite(ConstView<double>(firstElement(atom.f), count).sum()
                             + ConstView<double>(firstElement(atom.x), count).sum()))
        {
            return;
        }
        for (int bead = 0; bead < atom.nlocal; ++bead)
        {
            const double* const x = atom.x[bead];
            const double* const f = atom.f[bead];
            if (!std::isfinite(f[0] + f[1] + f[2] + x[0] + x[1] + x[2]))
            {
                throw DemEngineError("The force on bead " + std::to_string(atom.tag[bead]) + " at " + placeText(x)
                                     + " is not a finite number" + causeOf(bead));
            }
        }
    }

    void run(int steps)
    {
        const int before = program_->atom->nlocal;
        try
        {
            execute("run " + std::to_string(steps) + " pre no post no", "DEM interval");
            checkFinite();
        }
        catch (const DemEngineError& error)
        {
            // What LIGGGHTS says then is about atom types. Where some are left it goes on, and the census names the others.
            if (before > 0 && program_->atom->nlocal == 0)
            {
                throw DemEngineError(
                    std::string(error.what()) + "; no bead is left of the " + std::to_string(before)
                    + " that were here: a force has thrown them out of the box within these steps, as one "
                      "does that is unstable with this DEM step or coupling interval");
            }
            throw;
        }
    }

    void keepState(const std::vector<double>& ofNewBead)
    {
        stateOfNewBead_ = ofNewBead;
    }

    void addState()
    {
        if (stateOfNewBead_.empty())
        {
            return;
        }
        // property/atom <name> <style> <restart> <ghost> <reverse> <defaults ...>
        std::string command =
            std::string("fix ") + stateFixId + " all property/atom " + stateFixId + " vector no no no";
        for (const double value : stateOfNewBead_)
        {
            command += ' ' + std::to_string(value);
        }
        execute(command, "coupling state");
        stateFix_ = program_->modify->find_fix_property(
            stateFixId, "property/atom", "vector", static_cast<int>(stateOfNewBead_.size()), 0, "coupling");
    }

    /// Part of LIGGGHTS' restart files. 1 of beads in files that do not have it.
    void addIntroduced()
    {
        execute(
            std::string("fix ") + introducedFixId + " all property/atom " + introducedFixId + " scalar yes no no 1.",
            "beads that come in");
        introducedFix_ =
            program_->modify->find_fix_property(introducedFixId, "property/atom", "scalar", 0, 0, "coupling");
    }

    /// LIGGGHTS takes a negative friction without complaint.
    void checkMaterials() const
    {
        auto* const friction = static_cast<lmp::FixPropertyGlobal*>(program_->modify->find_fix_property(
            "coefficientFriction", "property/global", "peratomtypepair", 0, 0, "coupling", false));
        const int materialCount = program_->atom->ntypes;
        for (int pair = 0; friction && pair < materialCount * materialCount; ++pair)
        {
            const double value = friction->compute_array(pair / materialCount, pair % materialCount);
            if (value < 0)
            {
                throw DemEngineError("coefficientFriction of the materials " + std::to_string(pair / materialCount + 1)
                                     + " and " + std::to_string(pair % materialCount + 1) + " is "
                                     + std::to_string(value) + "; allowed: a number >= 0");
            }
        }
    }

    void addGroupChanges()
    {
        for (const GroupChanger& changer : groupChangers_)
        {
            const std::string command = changer.propertyCommand();
            if (!command.empty())
            {
                execute(command, "group changes");
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
        execute(std::string("fix ") + forceFixId + " all external pf/callback 1 1", "fluid force");
        lmp::Modify& modify = *program_->modify;
        auto* external = static_cast<lmp::FixExternal*>(modify.fix[modify.find_fix(forceFixId)]);
        external->set_callback(&Implementation::fluidForceCallback, this);
        std::for_each(modify.fix, modify.fix + modify.nfix, [this](const lmp::Fix* fix) {
            movingGroups_ |= movesByForces(*fix) ? fix->groupbit : 0;
            frozenGroups_ |= std::string(fix->style) == "freeze" ? fix->groupbit : 0;
        });
    }

    /// Part of LIGGGHTS' restart files.
    void addLastForces()
    {
        execute(std::string("fix ") + lastForceFixId + " all property/atom " + lastForceFixId
                    + " vector yes no no 0. 0. 0. 0. 0. 0.",
            "forces of the last step");
        lastForceFix_ =
            program_->modify->find_fix_property(lastForceFixId, "property/atom", "vector", 6, 0, "coupling");
        lastForcesKnown_ = !fresh_;
    }

    /// Forces and torques on beads, rows 0 to 3 and 3 to 6.
    Eigen::Map<Eigen::Matrix<double, 6, Eigen::Dynamic>> lastForces()
    {
        return {firstElement(lastForceFix_->array_atom), 6, program_->atom->nlocal};
    }

    /// With which the next step begins. LIGGGHTS makes others at a `run` that begins anew, and in a resumed process: from
    /// the velocities at the end of a step, where damping and drag had those in its middle.
    void keepForces()
    {
        const lmp::Atom& atom = *program_->atom;
        lastForces().topRows<3>() = ConstVectors(firstElement(atom.f), 3, atom.nlocal);
        lastForces().bottomRows<3>() = ConstVectors(firstElement(atom.torque), 3, atom.nlocal);
        lastForcesKnown_ = true;
    }

    void prepare()
    {
        execute("run 0 post no", "preparing");
        checkFinite();
        if (lastForcesKnown_)
        {
            const lmp::Atom& atom = *program_->atom;
            Vectors(firstElement(atom.f), 3, atom.nlocal) = lastForces().topRows<3>();
            Vectors(firstElement(atom.torque), 3, atom.nlocal) = lastForces().bottomRows<3>();
        }
    }

    void feelFluid()
    {
        lastForcesKnown_ = false;
        feelsAnew_ = true;
        prepare();
        feelsAnew_ = false;
        keepForces();
    }

    /// Those at rest by `groupChanges` are in no group that moves.
    void findHeldBeads()
    {
        const lmp::Atom& atom = *program_->atom;
        held_.resize(atom.nlocal);
        std::transform(atom.mask, atom.mask + atom.nlocal, held_.begin(),
            [this](int groups) { return (groups & movingGroups_) == 0 || (groups & frozenGroups_) != 0; });
    }

    /// `fix freeze` has cleared all forces but the fluid's, which come after it.
    void clearForceOnHeldBeads(Vectors force) const
    {
        for (Eigen::Index bead = 0; frozenGroups_ != 0 && bead < force.cols(); ++bead)
        {
            if (held_[bead])
            {
                force.col(bead).setZero();
            }
        }
    }

    void seePairs(double reach)
    {
        seesPairs_ = true;
        // Widens the lists beyond the skin, so that what the skin allows the beads to move costs none of it.
        program_->neighbor->register_contact_dist_factor(1 + reach);
    }

    /// A fix that has inserted all its beads has no next insertion, which LIGGGHTS writes as step 0. When it is read
    /// again, 0 is taken for "not known", and the fix tries at once and then stands in the way of every `run`.
    void keepFinishedInsertionsFinished()
    {
        constexpr lmp::bigint never = lmp::bigint(1) << 52;
        lmp::Modify& modify = *program_->modify;
        std::for_each(modify.fix, modify.fix + modify.nfix, [](lmp::Fix* fix) {
            if (std::string(fix->style).rfind("insert/", 0) == 0 && fix->next_reneighbor == 0)
            {
                fix->next_reneighbor = never;
            }
        });
    }

    /// LIGGGHTS looks among beads and fixes for the first material, and stops where it finds none, as when all beads have
    /// left. A template has it; its radius matters to no bead, for there is none.
    void allowNoBeads()
    {
        const lmp::Modify& modify = *program_->modify;
        const bool found =
            std::any_of(modify.fix, modify.fix + modify.nfix, [](lmp::Fix* fix) { return fix->min_type() == 1; });
        if (program_->atom->natoms > 0 || found)
        {
            return;
        }
        execute(
            "fix clepsydraTemplate all particletemplate/sphere 10007 atom_type 1 density constant 1. radius constant "
                + std::to_string(program_->neighbor->skin),
            "no beads");
        execute("fix clepsydraTemplates all particledistribution/discrete 10009 1 clepsydraTemplate 1.", "no beads");
    }

    /// As LIGGGHTS' own fixes delete atoms.
    void remove(const std::vector<int>& ids)
    {
        const FloatingPointTraps none(0);
        lmp::Atom& atom = *program_->atom;
        // While the neighbour lists that hold the contacts' history still fit the beads: it goes to the beads.
        program_->modify->setup_pre_exchange();
        const std::unordered_set<int> leaving(ids.begin(), ids.end());
        for (int bead = 0; bead < atom.nlocal;)
        {
            if (leaving.count(atom.tag[bead]) == 0)
            {
                ++bead;
                continue;
            }
            constexpr int deleting = 1;
            atom.avec->copy(--atom.nlocal, bead, deleting);
        }
        const lmp::bigint here = atom.nlocal;
        MPI_Allreduce(&here, &atom.natoms, 1, MPI_LMP_BIGINT, MPI_SUM, program_->world);
        // Copies of beads that are no longer there must not be found.
        atom.nghost = 0;
        if (atom.map_style != 0)
        {
            atom.map_init();
            atom.map_set();
        }
        allowNoBeads();
    }

    /// A resumed process gets other random numbers from these fixes and their regions than one that goes on: what is
    /// written is less than the state. So they read it here, too.
    void restartInsertions()
    {
        lmp::Modify& modify = *program_->modify;
        std::for_each(modify.fix, modify.fix + modify.nfix, [&](lmp::Fix* fix) {
            const std::string style = fix->style;
            const bool inserts = style.rfind("insert/", 0) == 0 || style.rfind("particle", 0) == 0;
            if (inserts && fix->restart_global)
            {
                restartFix(*fix);
            }
            if (auto* const inRegion = dynamic_cast<lmp::FixInsertPack*>(fix))
            {
                InsertionRegion::measure(*inRegion);
            }
        });
    }

    void keepMemory(int numbers)
    {
        memorySize_ = numbers;
    }

    /// Unlike the state it is part of LIGGGHTS' restart files.
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
        execute(command, "memory of forces");
        memoryFix_ =
            program_->modify->find_fix_property(memoryFixId, "property/atom", "vector", memorySize_, 0, "coupling");
    }

    BeadsView beads()
    {
        lmp::Atom& atom = *program_->atom;
        const Eigen::Index count = atom.nlocal;
        return BeadsView{ConstView<int>(atom.tag, count), ConstVectors(firstElement(atom.x), 3, count),
            ConstVectors(firstElement(atom.v), 3, count), ConstVectors(firstElement(atom.omega), 3, count),
            ConstView<double>(atom.radius, count), ConstView<double>(atom.rmass, count),
            stateFix_ ? reinterpret_cast<CouplingState*>(firstElement(stateFix_->array_atom)) : nullptr,
            ConstVectors(firstElement(atom.f), 3, count), BeadPairs{},
            memoryFix_ ? firstElement(memoryFix_->array_atom) : nullptr, memorySize_, true, ConstView<bool>(nullptr, 0),
            introducedFix_->vector_atom};
    }

    /// LIGGGHTS' own list: half, with `newton off` pairs across ranks on both.
    BeadPairs pairs()
    {
        pairList_.clear();
        lmp::NeighList* const neighbours = program_->force->pair ? program_->force->pair->list : nullptr;
        for (int i = 0; neighbours && i < neighbours->inum; ++i)
        {
            const int bead = neighbours->ilist[i];
            for (int j = 0; j < neighbours->numneigh[bead]; ++j)
            {
                pairList_.push_back({bead, neighbours->firstneigh[bead][j] & NEIGHMASK});
            }
        }
        lmp::Atom& atom = *program_->atom;
        const Eigen::Index count = atom.nlocal + atom.nghost;
        return BeadPairs{ConstVectors(firstElement(atom.x), 3, count), ConstVectors(firstElement(atom.v), 3, count),
            ConstView<double>(atom.radius, count),
            Eigen::Map<const Eigen::Matrix2Xi>(pairList_.empty() ? nullptr : pairList_.front().data(), 2,
                static_cast<Eigen::Index>(pairList_.size()))};
    }

    lmp::LAMMPS& program()
    {
        return *program_;
    }

    const lmp::LAMMPS& program() const
    {
        return *program_;
    }

private:
    void start(const std::filesystem::path& logFile)
    {
        // The screen must go to a file: `-screen none` crashes fix mesh/surface of LIGGGHTS 3.8.
        std::vector<std::string> words{"liggghts", "-log", logFile.string(), "-screen", "/dev/null"};
        std::vector<char*> arguments;
        arguments.reserve(words.size());
        for (std::string& word : words)
        {
            arguments.push_back(word.data());
        }
        try
        {
            program_ =
                std::make_unique<lmp::LAMMPS>(static_cast<int>(arguments.size()), arguments.data(), communicator_);
        }
        catch (const LiggghtsStopped& stopped)
        {
            throw DemEngineError(std::string("LIGGGHTS did not start: ") + stopped.what());
        }
    }

    /// The same command with its variables' values, for its error; nothing where it has none.
    std::string valuesIn(const std::string& command) const
    {
        const std::string text = withVariables(command);
        return text == command ? std::string() : " (" + text + ')';
    }

    std::string boxText() const
    {
        return "the box, " + placeText(program_->domain->boxlo) + " to " + placeText(program_->domain->boxhi);
    }

    /// Why a bead may have a force that is no number.
    std::string causeOf(int bead) const
    {
        const lmp::Atom& atom = *program_->atom;
        for (int other = 0; other < atom.nlocal + atom.nghost; ++other)
        {
            if (other != bead && std::equal(atom.x[bead], atom.x[bead] + 3, atom.x[other]))
            {
                return ": bead " + std::to_string(atom.tag[other]) + " is at the same place; allowed: beads apart";
            }
        }
        return ": as where a bead's centre lies exactly on a wall, on an edge or a corner of one, or where the DEM "
               "step is too long; allowed: beads beside walls, at most touching them";
    }

    void runScript(const LiggghtsSetup& setup)
    {
        const std::filesystem::path& resumeFrom = setup.resumeFrom;
        for (const ScriptCommand& command : readScript(setup.script, setup.variables))
        {
            if (setup.writesNothing && writesFiles(command.text))
            {
                continue;
            }
            if (resumeFrom.empty() || !makesBeads(command.text))
            {
                requireUndamagedInput(command);
                executeOfScript(command);
            }
            else if (!boxMade_)
            {
                execute("read_restart " + resumeFrom.string(), command.where + ", resumed");
                boxMade_ = true;
            }
        }
    }

    /// LIGGGHTS goes round for ever in a restart file that has been cut, or is none.
    void requireUndamagedInput(const ScriptCommand& command)
    {
        if (!isCommand(command.text, "read_restart"))
        {
            return;
        }
        std::istringstream words(withVariables(command.text));
        std::string name;
        std::string file;
        if (!(words >> name >> file) || name != "read_restart" || file.find('*') != std::string::npos)
        {
            return;
        }
        const std::vector<std::filesystem::path> files = filesRead(file, program_->comm->me, program_->comm->nprocs);
        try
        {
            std::for_each(files.begin(), files.end(), requireUndamaged);
        }
        catch (const FileError& error)
        {
            throw DemEngineError(command.where + ": " + error.what());
        }
        if (isOtherThanRestart(files.front()))
        {
            throw DemEngineError(command.where + ": '" + command.text + "': " + files.front().string()
                                 + " is no restart file; allowed: what LIGGGHTS' write_restart has written");
        }
    }

    /// A command as LIGGGHTS reads it, the values of its variables put in.
    std::string withVariables(const std::string& command) const
    {
        constexpr int flagOfScripts = 0;
        int size = static_cast<int>(command.size()) + 1;
        int workSize = size;
        auto* text = static_cast<char*>(std::malloc(command.size() + 1));
        auto* work = static_cast<char*>(std::malloc(command.size() + 1));
        std::copy_n(command.c_str(), command.size() + 1, text);
        try
        {
            program_->input->substitute(text, work, size, workSize, flagOfScripts);
        }
        catch (const LiggghtsStopped&)
        {
            // A variable that is not there: LIGGGHTS says so when it executes the command.
        }
        std::string result = text;
        std::free(text);
        std::free(work);
        return result;
    }

    /// By the very bytes that the first rank writes to LIGGGHTS' restart files: their number and the state.
    void restartFix(lmp::Fix& fix) const
    {
        char* text = nullptr;
        std::size_t size = 0;
        FILE* const stream = open_memstream(&text, &size);
        fix.write_restart(stream);
        std::fclose(stream);
        std::vector<char> state(text, text + size);
        std::free(text);
        auto count = static_cast<int>(size);
        MPI_Bcast(&count, 1, MPI_INT, 0, program_->world);
        state.resize(static_cast<std::size_t>(count));
        MPI_Bcast(state.data(), count, MPI_CHAR, 0, program_->world);
        if (state.size() > sizeof(int))
        {
            fix.restart(state.data() + sizeof(int));
        }
    }

    static void fluidForceCallback(void* self, lmp::bigint, int, int*, double**, double** force)
    {
        auto& engine = *static_cast<Implementation*>(self);
        engine.checkFinite();
        const FloatingPointTraps asOutside(engine.trapsOutside_);
        const BeadsView own = engine.beads();
        Vectors ofFluid(firstElement(force), 3, own.size());
        const bool preparing = engine.program_->update->setupflag != 0;
        if (preparing && !engine.feelsAnew_)
        {
            ofFluid.setZero();
            return;
        }
        engine.findHeldBeads();
        const BeadsView beads{own.id, own.position, own.velocity, own.angularVelocity, own.radius, own.mass, own.state,
            own.otherForce, engine.seesPairs_ ? engine.pairs() : BeadPairs{},
            engine.memoryFix_ ? firstElement(engine.memoryFix_->array_atom) : nullptr, engine.memorySize_, !preparing,
            ConstView<bool>(engine.held_.data(), own.size())};
        engine.forces_->evaluate(beads, engine.program_->update->dt, ofFluid);
        engine.clearForceOnHeldBeads(ofFluid);
    }

    MPI_Comm communicator_;
    std::unique_ptr<lmp::LAMMPS> program_;
    lmp::Fix* stateFix_ = nullptr;
    std::vector<double> stateOfNewBead_;
    FluidForces* forces_ = nullptr;
    lmp::Fix* lastForceFix_ = nullptr;
    bool lastForcesKnown_ = false;
    bool feelsAnew_ = false;
    /// Of which groups forces move the beads, and of which a fix forbids it.
    int movingGroups_ = 0;
    int frozenGroups_ = 0;
    Eigen::Array<bool, Eigen::Dynamic, 1> held_;
    bool seesPairs_ = false;
    lmp::Fix* memoryFix_ = nullptr;
    int memorySize_ = 0;
    lmp::Fix* introducedFix_ = nullptr;
    std::vector<std::array<int, 2>> pairList_;
    std::vector<GroupChanger> groupChangers_;
    int trapsOutside_ = 0;
    bool fresh_ = true;
    bool boxMade_ = false;
    bool failed_ = false;
};

LiggghtsEngine::LiggghtsEngine(const LiggghtsSetup& setup)
    : implementation_(std::make_unique<Implementation>(setup))
{}

LiggghtsEngine::~LiggghtsEngine() = default;

void LiggghtsEngine::seePairs(double reach)
{
    implementation_->seePairs(reach);
}

void LiggghtsEngine::keepState(const std::vector<double>& ofNewBead)
{
    implementation_->keepState(ofNewBead);
}

void LiggghtsEngine::keepMemory(int numbers)
{
    implementation_->keepMemory(numbers);
}

void LiggghtsEngine::initialise(FluidForces* forces)
{
    implementation_->addState();
    implementation_->addIntroduced();
    implementation_->addMemory();
    implementation_->addLastForces();
    implementation_->addGroupChanges();
    if (forces)
    {
        implementation_->addFluidForce(forces);
    }
    implementation_->checkMaterials();
    // Lost beads are found, named and reported by the coupling's census; LIGGGHTS would end the process.
    implementation_->execute("thermo_modify lost ignore flush yes", "initialise");
    implementation_->checkBeadsAreInBox();
    implementation_->allowNoBeads();
    prepare();
    implementation_->checkOverlaps();
}

void LiggghtsEngine::prepare()
{
    implementation_->prepare();
}

void LiggghtsEngine::feelFluid()
{
    implementation_->feelFluid();
}

void LiggghtsEngine::advance(int steps)
{
    implementation_->run(steps);
    implementation_->keepForces();
    implementation_->changeGroups(steps * timeStep());
}

void LiggghtsEngine::remove(const std::vector<int>& ids)
{
    implementation_->remove(ids);
}

BeadsView LiggghtsEngine::beads()
{
    return implementation_->beads();
}

double LiggghtsEngine::timeStep() const
{
    return implementation_->program().update->dt;
}

Vector3d LiggghtsEngine::gravity() const
{
    Vector3d acceleration = Vector3d::Zero();
    if (lmp::Fix* fix = findFixOfStyle(*implementation_->program().modify, "gravity"))
    {
        // The fix works out its components in init(), which LIGGGHTS itself calls before the first step only.
        fix->init();
        static_cast<lmp::FixGravity*>(fix)->get_gravity(acceleration.data());
    }
    return acceleration;
}

std::vector<ContactMaterial> LiggghtsEngine::contactMaterials() const
{
    lmp::Modify& modify = *implementation_->program().modify;
    const int materialCount = implementation_->program().atom->ntypes;
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
    implementation_->keepFinishedInsertionsFinished();
    const lmp::LAMMPS& program = implementation_->program();
    std::vector<std::filesystem::path> files = filesWritten(name, program.comm->me);
    std::list<FileThroughPipe> pipes;
    std::exception_ptr failure;
    const auto attempt = [&](const auto& step) {
        try
        {
            step();
        }
        catch (const FileError&)
        {
            failure = std::current_exception();
        }
    };
    attempt([&] {
        for (const std::filesystem::path& file : files)
        {
            pipes.emplace_back(file);
        }
    });
    // All write or none does: the others would wait for one that has no file.
    int ready = failure ? 0 : 1;
    MPI_Allreduce(MPI_IN_PLACE, &ready, 1, MPI_INT, MPI_MIN, program.world);
    if (ready != 0)
    {
        implementation_->execute("write_restart " + FileThroughPipe::entrance(name).string(), "checkpoint");
        attempt([&] { std::for_each(pipes.begin(), pipes.end(), [](FileThroughPipe& pipe) { pipe.finish(); }); });
        implementation_->restartInsertions();
    }
    MPI_Barrier(program.world);
    if (failure)
    {
        std::rethrow_exception(failure);
    }
    return files;
}

std::string LiggghtsEngine::version() const
{
    return std::string("LIGGGHTS ") + implementation_->program().universe->version;
}

} // namespace clepsydra
