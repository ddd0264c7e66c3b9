#include "engine/liggghts/librarySelfTest.h"

#include "engine/demEngine.h"
#include "engine/liggghts/floatingPointTraps.h"
#include "engine/liggghts/fasterParts.h"
#include "engine/liggghts/liggghtsErrors.h"
#include "engine/liggghts/quietRegistration.h"
#include "engine/liggghts/replacedFunctions.h"

#include <atom.h>
#include <comm.h>
#include <domain.h>
#include <fix_property_global.h>
#include <force.h>
#include <group.h>
#include <input.h>
#include <lammps.h>
#include <library.h>
#include <modify.h>
#include <neigh_list.h>
#include <neighbor.h>
#include <pair.h>
#include <pair_gran_proxy.h>
#include <universe.h>
#include <update.h>

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <string>

namespace clepsydra
{

namespace
{

namespace lmp = LAMMPS_NS;

constexpr const char* versionAllowed = "3.8";
/// Relative tolerance of values that both the library and this program compute.
constexpr double tolerance = 1e-12;

[[noreturn]] void refuse(const std::string& difference)
{
    throw DemEngineError(
        "The library " + fileOfObjectAt(reinterpret_cast<const void*>(&lammps_open)) + ' ' + difference
        + ". To run with it would corrupt memory or results; allowed: LIGGGHTS " + versionAllowed
        + ", built with the flags of the headers which this program was compiled with, as Debian's libliggghts3 and "
          "libliggghts-dev are");
}

template<class T>
std::string asText(const T& value)
{
    std::ostringstream text;
    text.precision(17);
    text << value;
    return text.str();
}

/// Two particles in contact, as the commands below create them. SI units.
struct Particle
{
    int id;
    std::array<double, 3> position;
    double radius;
};

constexpr std::array<Particle, 2> particles{{{1, {0.004, 0.005, 0.006}, 0.001}, {2, {0.0055, 0.0062, 0.0065}, 0.0012}}};
constexpr std::array<double, 3> velocity{1, 2, 3};
constexpr double density = 2500;
constexpr double youngsModulus = 5e6;
constexpr double poissonsRatio = 0.25;
constexpr double timeStep = 1e-6;

/// A file in memory for LIGGGHTS' screen output.
class Screen
{
public:
    Screen()
        : file_(memfd_create("clepsydra", MFD_CLOEXEC))
    {}

    ~Screen()
    {
        close(file_);
    }

    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    /// Name of the file for fopen().
    std::string name() const
    {
        return "/proc/self/fd/" + std::to_string(file_);
    }

    std::string firstLine() const
    {
        std::fflush(nullptr);
        std::array<char, 512> text{};
        const ssize_t size = pread(file_, text.data(), text.size(), 0);
        const std::string whole(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
        return whole.substr(0, whole.find('\n'));
    }

private:
    int file_;
};

/// An instance of LIGGGHTS that the library allocates. One that this program allocated would be too small where the
/// library's class LAMMPS is larger.
class ScratchInstance
{
public:
    ScratchInstance()
    {
        std::array<std::string, 5> words{"liggghts", "-log", "none", "-screen", screen_.name()};
        std::array<char*, words.size()> arguments{};
        for (std::size_t i = 0; i < words.size(); ++i)
        {
            arguments[i] = words[i].data();
        }
        try
        {
            const QuietRegistration quiet;
            lammps_open(static_cast<int>(arguments.size()), arguments.data(), MPI_COMM_SELF, &instance_);
        }
        catch (const LiggghtsStopped& stopped)
        {
            throw DemEngineError(std::string("LIGGGHTS did not start for its self-test: ") + stopped.what());
        }
    }

    /// An instance that has failed stays in memory, because its destructor may fail, too.
    void close()
    {
        lammps_close(instance_);
    }

    void execute(const std::string& command)
    {
        try
        {
            (*this)->input->one(command.c_str());
        }
        catch (const LiggghtsStopped& stopped)
        {
            refuse("fails its self-test at '" + command + "': " + stopped.what());
        }
    }

    /// Version as LIGGGHTS prints it before anything else, independently of the layout of its classes.
    std::string versionLine() const
    {
        return screen_.firstLine();
    }

    lmp::LAMMPS* operator->() const
    {
        return static_cast<lmp::LAMMPS*>(instance_);
    }

    void* handle() const
    {
        return instance_;
    }

private:
    Screen screen_;
    void* instance_ = nullptr;
};

void requireVersion(const std::string& line)
{
    // The line is "LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0, compiled ...)".
    const std::size_t name = line.find("Version LIGGGHTS");
    const std::size_t blank = line.find(' ', name == std::string::npos ? name : name + std::string("Version ").size());
    const std::string number = blank == std::string::npos ? "" : line.substr(blank + 1);
    if (number.rfind(std::string(versionAllowed) + '.', 0) != 0)
    {
        refuse("is of another version: '" + line + "'");
    }
}

/// \param object  an object that the library has allocated
template<class T>
void requireSize(const char* name, T* object)
{
    // Allocators round sizes up, and glibc adds a remainder of up to 16 bytes that is too small for other uses.
    constexpr std::size_t remainder = 16;
    const std::size_t there = malloc_usable_size(object);
    const std::unique_ptr<void, decltype(&std::free)> own(std::malloc(sizeof(T)), &std::free);
    if (there < sizeof(T) || there > malloc_usable_size(own.get()) + remainder)
    {
        refuse("has a class " + std::string(name) + " of about " + std::to_string(there) + " bytes, its headers one of "
               + std::to_string(sizeof(T)));
    }
}

void requireSizes(const ScratchInstance& liggghts)
{
    requireSize("LAMMPS", liggghts.operator->());
    requireSize("Atom", liggghts->atom);
    requireSize("Comm", liggghts->comm);
    requireSize("Domain", liggghts->domain);
    requireSize("Force", liggghts->force);
    requireSize("Group", liggghts->group);
    requireSize("Input", liggghts->input);
    requireSize("Modify", liggghts->modify);
    requireSize("Neighbor", liggghts->neighbor);
    requireSize("Universe", liggghts->universe);
    requireSize("Update", liggghts->update);
}

void makeParticles(ScratchInstance& liggghts)
{
    for (const char* command : {"units si", "atom_style granular", "atom_modify map array", "boundary f f f",
             "newton off", "communicate single vel yes", "region box block 0. 0.01 0. 0.01 0. 0.01 units box",
             "create_box 1 box", "neighbor 0.001 bin", "neigh_modify delay 0"})
    {
        liggghts.execute(command);
    }
    const auto property = [&](const char* name, const std::string& values) {
        liggghts.execute(std::string("fix ") + name + " all property/global " + name + ' ' + values);
    };
    property("youngsModulus", "peratomtype " + asText(youngsModulus));
    property("poissonsRatio", "peratomtype " + asText(poissonsRatio));
    property("coefficientRestitution", "peratomtypepair 1 0.9");
    property("coefficientFriction", "peratomtypepair 1 0.5");
    for (const Particle& particle : particles)
    {
        const auto& at = particle.position;
        liggghts.execute(
            "create_atoms 1 single " + asText(at[0]) + ' ' + asText(at[1]) + ' ' + asText(at[2]) + " units box");
        liggghts.execute("set atom " + asText(particle.id) + " diameter " + asText(2 * particle.radius) + " density "
                         + asText(density));
    }
    liggghts.execute("velocity all set " + asText(velocity[0]) + ' ' + asText(velocity[1]) + ' ' + asText(velocity[2]));
    liggghts.execute("timestep " + asText(timeStep));
}

/// Runs one step. No fix integrates, so the particles do not move.
void makeOneStep(ScratchInstance& liggghts)
{
    liggghts.execute("pair_style gran model hertz tangential history");
    liggghts.execute("pair_coeff * *");
    liggghts.execute("run 1");
    requireSize("PairGranProxy", static_cast<lmp::PairGranProxy*>(liggghts->force->pair));
    requireSize("NeighList", liggghts->force->pair->list);
}

/// Position of a member according to the library and according to its headers.
struct Member
{
    const char* name;
    const void* there;
    const void* here;
};

void requireMembers(const ScratchInstance& liggghts)
{
    void* const instance = liggghts.handle();
    const auto global = [&](const char* name, const void* here) {
        return Member{name, lammps_extract_global(instance, name), here};
    };
    const auto array = [&](const char* name, const void* here) {
        return Member{name, lammps_extract_atom(instance, name), here};
    };
    const lmp::Atom& atom = *liggghts->atom;
    const lmp::Domain& domain = *liggghts->domain;
    for (const Member& member :
        {global("natoms", &atom.natoms), global("nlocal", &atom.nlocal), global("nghost", &atom.nghost),
            global("dt", &liggghts->update->dt), global("ntimestep", &liggghts->update->ntimestep),
            global("boxxlo", &domain.boxlo[0]), global("boxyhi", &domain.boxhi[1]), array("id", atom.tag),
            array("type", atom.type), array("mask", atom.mask), array("image", atom.image), array("x", atom.x),
            array("v", atom.v), array("f", atom.f), array("omega", atom.omega), array("torque", atom.torque),
            array("radius", atom.radius), array("rmass", atom.rmass), array("density", atom.density)})
    {
        if (member.there != member.here)
        {
            refuse(std::string("has the member '") + member.name
                   + "' of its atoms, box or time at another place than its headers");
        }
    }
    const lmp::Fix& fix = *liggghts->modify->fix[0];
    requireSize("FixPropertyGlobal", static_cast<lmp::FixPropertyGlobal*>(liggghts->modify->fix[0]));
    if (fix.style != std::string("property/global") || fix.id != std::string("youngsModulus") || fix.groupbit != 1)
    {
        refuse("has other members in its class Fix than its headers");
    }
}

template<class T>
void requireEqual(const std::string& name, const T& there, const T& expected)
{
    if (there != expected)
    {
        refuse("gives " + name + " as " + asText(there) + " instead of " + asText(expected));
    }
}

void requireNear(const std::string& name, double there, double expected)
{
    // In this form the condition also refuses "not a number".
    if (!(std::abs(there - expected) <= tolerance * std::abs(expected)))
    {
        refuse("gives " + name + " as " + asText(there) + " instead of " + asText(expected));
    }
}

void requireState(const ScratchInstance& liggghts)
{
    const lmp::Atom& atom = *liggghts->atom;
    requireEqual<lmp::bigint>("the number of particles", atom.natoms, particles.size());
    requireEqual("the number of local particles", atom.nlocal, static_cast<int>(particles.size()));
    requireNear("the time step", liggghts->update->dt, timeStep);
    for (std::size_t i = 0; i < particles.size(); ++i)
    {
        const Particle& particle = particles[i];
        const std::string of = " of particle " + asText(particle.id);
        requireEqual("the id (tag)" + of, atom.tag[i], particle.id);
        requireEqual("the type" + of, atom.type[i], 1);
        requireNear("the radius" + of, atom.radius[i], particle.radius);
        requireNear("the mass" + of, atom.rmass[i], 4. / 3. * M_PI * std::pow(particle.radius, 3) * density);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            requireNear("a coordinate" + of, atom.x[i][axis], particle.position[axis]);
            requireNear("a velocity" + of, atom.v[i][axis], velocity[axis]);
        }
    }
}

/// Hertz force of two spheres of one material at rest relative to each other: F = 4/3 E* sqrt(r) delta^(3/2) with
/// E* = E/(2 (1 - nu^2)) and 1/r = 1/r1 + 1/r2 (K. L. Johnson, Contact Mechanics, 1985, eq. 4.23).
void requireHertzForce(const ScratchInstance& liggghts, const char* whose)
{
    const auto& [first, second] = particles;
    std::array<double, 3> apart{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        apart[axis] = first.position[axis] - second.position[axis];
    }
    const double distance = std::hypot(apart[0], apart[1], apart[2]);
    const double overlap = first.radius + second.radius - distance;
    const double radius = first.radius * second.radius / (first.radius + second.radius);
    const double modulus = youngsModulus / (2 * (1 - poissonsRatio * poissonsRatio));
    const double force = 4. / 3. * modulus * std::sqrt(radius * overlap) * overlap;
    double* const* const there = liggghts->atom->f;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        const std::string name = std::string("a component of the Hertz force of two particles (") + whose + ')';
        requireNear(name, there[0][axis], force * apart[axis] / distance);
        requireNear(name, there[1][axis], -there[0][axis]);
    }
}

} // namespace

void testLiggghtsLibrary()
{
    const FloatingPointTraps none(0);
    ScratchInstance liggghts;
    requireVersion(liggghts.versionLine());
    requireSizes(liggghts);
    makeParticles(liggghts);
    makeOneStep(liggghts);
    requireMembers(liggghts);
    requireState(liggghts);
    requireHertzForce(liggghts, "LIGGGHTS' loop");
    // This program's loop reads more of LIGGGHTS' classes.
    registerHertzPairStyle();
    makeOneStep(liggghts);
    requireHertzForce(liggghts, "this program's loop");
    liggghts.close();
}

} // namespace clepsydra
