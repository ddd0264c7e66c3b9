/// \file
/// The features of LIGGGHTS that the models rely on, and LIGGGHTS' own models that cases use, on one rank and on two.

#include "closures/addedMass.h"
#include "closures/lubrication.h"
#include "engine/liggghts/liggghtsEngine.h"
#include "engine/liggghts/liggghtsParticles.h"
#include "engine/liggghts/liggghtsProgram.h"
#include "engine/liggghts/fasterParts.h"
#include "engine/liggghts/script.h"
#include "engine/liggghts/subdomains.h"
#include "engine/liggghts/wallMotions.h"
#include "forcesOnParticles.h"
#include "support/demScript.h"
#include "support/stlText.h"

#include <gtest/gtest.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <string>

namespace clepsydra::tests
{

namespace
{

constexpr double radius = 1e-3;
constexpr double particleDensity = 2500;

/// Exerts nothing, and keeps the sum of the other forces of the last step.
class Probe final : public FluidForces
{
public:
    void evaluate(const ParticlesView& particles, double, Vectors force) override
    {
        force.setZero();
        otherForce = particles.otherForce;
        id = particles.id;
        pairs = particles.pairs.list.cols();
    }

    Eigen::Matrix3Xd otherForce;
    Eigen::ArrayXi id;
    Eigen::Index pairs = 0;
};

Vector3d sumOverRanks(Vector3d value)
{
    MPI_Allreduce(MPI_IN_PLACE, value.data(), 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return value;
}

/// LIGGGHTS with particles in a box of 4 x 2 x 2 cm.
class Particles
{
public:
    Particles()
    {
        box.upper = {0.04, 0.02, 0.02};
        dem.diameter = 2 * radius;
        dem.density = particleDensity;
        dem.timeStep = 1e-5;
        dem.walls = false;
    }

    /// \param contactModel  after "model hertz"
    LiggghtsEngine& start(
        FluidForces* forces, double pairReach = 0, const std::string& contactModel = "tangential history")
    {
        std::string text = dem.text(box);
        const std::string usual = "model hertz tangential history";
        for (std::size_t at = 0; (at = text.find(usual, at)) != std::string::npos; ++at)
        {
            text.replace(at, usual.size(), "model hertz " + contactModel);
        }
        const std::string usualMap = "map array";
        text.replace(text.find(usualMap), usualMap.size(), map);
        // Each rank reads its own copy.
        const std::string name = testing::TempDir() + "clepsydraModels" + std::to_string(getpid());
        std::ofstream(name) << text;
        LiggghtsSetup setup;
        setup.script = name;
        setup.logFile = name + ".log";
        setup.groupChanges = groupChanges;
        setup.variables = variables;
        engine_ = std::make_unique<LiggghtsEngine>(setup);
        facts_ = engine_->scriptFacts();
        std::filesystem::remove(name);
        std::filesystem::remove(name + ".log");
        if (pairReach > 0)
        {
            engine_->requestPairs(pairReach, submergedFractionInState);
        }
        engine_->requestState(numbersOf(CouplingState()));
        engine_->initialise(forces);
        if (forces)
        {
            engine_->evaluateFluidForces();
        }
        return *engine_;
    }

    /// On whichever rank it is.
    Vector3d velocity(int particle)
    {
        const ParticlesView particles = engine_->particles();
        Vector3d found = Vector3d::Zero();
        for (Eigen::Index i = 0; i < particles.size(); ++i)
        {
            found += particles.id[i] == particle ? Vector3d(particles.velocity.col(i)) : Vector3d::Zero();
        }
        return sumOverRanks(found);
    }

    Vector3d position(int particle)
    {
        const ParticlesView particles = engine_->particles();
        Vector3d found = Vector3d::Zero();
        for (Eigen::Index i = 0; i < particles.size(); ++i)
        {
            found += particles.id[i] == particle ? Vector3d(particles.position.col(i)) : Vector3d::Zero();
        }
        return sumOverRanks(found);
    }

    /// What the script has made. \pre started
    const ScriptFacts& facts() const
    {
        return facts_;
    }

    Box box;
    DemScript dem;
    std::vector<GroupChange> groupChanges;
    std::vector<std::pair<std::string, std::string>> variables;
    std::string map = "map array";

private:
    ScriptFacts facts_;
    std::unique_ptr<LiggghtsEngine> engine_;
};

Vector3d otherForce(const Probe& probe, int particle)
{
    Vector3d found = Vector3d::Zero();
    for (Eigen::Index i = 0; i < probe.id.size(); ++i)
    {
        found += probe.id[i] == particle ? Vector3d(probe.otherForce.col(i)) : Vector3d::Zero();
    }
    return sumOverRanks(found);
}

/// What the engine says when this is done; empty where it does not complain.
std::string errorOf(const std::function<void()>& deed)
{
    try
    {
        deed();
    }
    catch (const DemEngineError& error)
    {
        return error.what();
    }
    return {};
}

/// To the fluid, by all particles.
Vector3d impulseGiven(LiggghtsEngine& engine)
{
    const ParticlesView particles = engine.particles();
    Vector3d sum = Vector3d::Zero();
    for (Eigen::Index particle = 0; particle < particles.size(); ++particle)
    {
        sum += particles.state[particle].received.impulse;
    }
    return sumOverRanks(sum);
}

const double particleMass = particleDensity * sphereVolume(radius);

} // namespace

/// The last fix sees all other forces: the weight of a falling particle, and with it the contact of two that overlap.
/// Defined earlier, or reading the forces of the step before, it sees none of them at the first step.
TEST(Liggghts, ShowsAllOtherForces)
{
    Particles particles;
    particles.dem.particles = {{0.005, 0.01, 0.01}, {0.0198, 0.01, 0.01}, {0.0217, 0.01, 0.01}};
    Probe probe;
    particles.start(&probe);
    EXPECT_NEAR(otherForce(probe, 1).z() / (-9.81 * particleMass), 1, 1e-9);
    // Hertz: 4/3 E* sqrt(R*) overlap^1.5, E* = E/(2 (1 - nu^2)), R* = R/2.
    const double hertz = 4.0 / 3 * 5e6 / (2 * (1 - 0.04)) * std::sqrt(radius / 2) * std::pow(1e-4, 1.5);
    EXPECT_NEAR(otherForce(probe, 3).x() / hertz, 1, 1e-6);
    EXPECT_NEAR(otherForce(probe, 2).x() / -hertz, 1, 1e-6);
    EXPECT_EQ(probe.pairs, 0);
}

/// Glass starts with 4.97 m/s2 in LIGGGHTS' own integration too (5.95 without added mass).
TEST(Liggghts, TakesTheAddedMassImplicitly)
{
    Particles particles;
    particles.dem.particles = {{0.005, 0.01, 0.01}};
    Foam::dictionary dict(Foam::IStringStream("forceModels (virtualMassForce Archimedes);")());
    PhaseTimers timers;
    ParticleForces forces(dict, ModelType::A, water(), timers);
    particles.start(&forces).advance(100);
    EXPECT_NEAR(particles.velocity(1).z() / (-1e-3 * closures::accelerationFromRest(9.81, 1000, particleDensity, 0.5)),
        1, 1e-6);
}

/// `fix freeze` holds a particle against the fluid's forces, too, and its added mass has nothing to resist then: it gives
/// the fluid nothing, in still water. LIGGGHTS' fix alone clears what acts on the particle before the fluid's forces come.
TEST(Liggghts, FrozenParticlesStayWhatTheFluidDoes)
{
    Particles particles;
    particles.dem.particles = {{0.005, 0.01, 0.01}, {0.035, 0.01, 0.01}};
    particles.dem.more = "group frozen id 1\nfix frozen frozen freeze\n";
    Foam::dictionary dict(Foam::IStringStream("forceModels (virtualMassForce Archimedes);")());
    PhaseTimers timers;
    ParticleForces forces(dict, ModelType::A, water(), timers);
    LiggghtsEngine& engine = particles.start(&forces);
    const Vector3d before = impulseGiven(engine);
    engine.advance(100);
    EXPECT_EQ(particles.velocity(1), Vector3d::Zero());
    EXPECT_LT(particles.velocity(2).z(), 0);
    const double mobile = 100 * engine.timeStep() * closures::addedMass(0.5, 1000, sphereVolume(radius))
                          * closures::accelerationFromRest(9.81, 1000, particleDensity, 0.5);
    EXPECT_NEAR((impulseGiven(engine) - before).z() / mobile, 1, 1e-6);
}

/// The velocity of a point of each wall that a script moves, worked out by hand, and why that of others is not known. Planes
/// and cylinders at rest are not among them.
TEST(Liggghts, KnowsHowWallsMove)
{
    ScriptFacts facts;
    const auto add = [&](const std::string& style, const std::string& rest) {
        const std::string id = "w" + std::to_string(facts.fixes.size());
        facts.fixes.push_back({id, style, "all", {"fix " + id + " all " + style + ' ' + rest, "in line 1"}, false});
    };
    const std::string model = "model hertz tangential history primitive type 2 ";
    add("wall/gran", model + "zplane 0.");
    add("wall/gran", model + "zplane 0. shear x 0.2");
    add("wall/gran", model + "zcylinder 0.03 1. 2. store_force yes shear x -3.");
    add("wall/gran", model + "xcylinder 0.03 1. 2. shear z 3.");
    add("wall/gran", model + "zcylinder 0.03 1. 2. shear z 3.");
    add("mesh/surface", "file a.stl type 2 surface_vel 1. 2. 3.");
    add("mesh/surface/planar", "file a.stl type 2 surface_ang_vel origin 0. 1. 0. axis 0. 0. 2. omega 4.");
    add("move/mesh", "mesh m1 rotate origin 0. 1. 0. axis 0. 0. -2. period 0.5");
    add("move/mesh", "mesh m2 linear 1. 0. 0.");
    add("move/mesh", "mesh m3 wiggle amplitude 0. 0. 1. period 2.");
    add("move/mesh", "mesh m4 linear v_x 0. 0.");
    add("wall/gran", model + "ycylinder 0.03 0. 0. shear x 3.");
    add("move/mesh", "mesh m5 linear 1. 0. 0.");
    add("move/mesh", "mesh m5 linear 0. 1. 0.");

    const std::vector<WallMotion> walls = wallMotions(facts);
    ASSERT_EQ(walls.size(), 13U);
    const Vector3d point(0, 0, 5);
    const std::vector<Vector3d> expected = {
        {0.2, 0, 0}, {-6, 3, 0}, {0, -9, -3}, {0, 0, 3}, {1, 2, 3}, {4, 0, 0}, {-4 * M_PI, 0, 0}, {1, 0, 0}};
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        EXPECT_EQ(walls[i].unknownBecause, "") << walls[i].command.text;
        EXPECT_LT((walls[i].motion.at(point) - expected[i]).norm(), 1e-12)
            << walls[i].command.text << ": " << walls[i].motion.at(point).transpose();
    }
    for (const auto& [wall, reason] :
        std::vector<std::pair<std::size_t, std::string>>{{8, "only 'rotate' and 'linear'"},
            {9, "not stated in numbers"}, {10, "ycylinder"}, {11, "several fixes"}, {12, "several fixes"}})
    {
        EXPECT_NE(walls[wall].unknownBecause.find(reason), std::string::npos) << walls[wall].unknownBecause;
    }
}

/// The fluid's torque slows a spinning particle in LIGGGHTS' own integration as in the exact solution, and a frozen one not at
/// all. A torque that did not get into LIGGGHTS' arrays, or twice, would leave 100 or 30.1 rad/s.
TEST(Liggghts, TakesTheFluidsTorque)
{
    Particles particles;
    particles.dem.gravity = 0;
    particles.dem.particles = {{0.005, 0.01, 0.01}, {0.035, 0.01, 0.01}};
    particles.dem.more = "set group all omegay 100\ngroup frozen id 1\nfix frozen frozen freeze\n";
    Foam::dictionary dict(Foam::IStringStream("forceModels (StokesTorque);")());
    PhaseTimers timers;
    ParticleForces forces(dict, ModelType::A, {1000, 1e-2, Vector3d::Zero()}, timers);
    LiggghtsEngine& engine = particles.start(&forces);
    engine.advance(1000);
    Eigen::Array2d spin = Eigen::Array2d::Zero();
    const ParticlesView view = engine.particles();
    for (Eigen::Index particle = 0; particle < view.size(); ++particle)
    {
        spin[view.id[particle] - 1] += view.angularVelocity(1, particle);
    }
    MPI_Allreduce(MPI_IN_PLACE, spin.data(), 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    // rho_p R^2/(15 mu) = 1/60 s, and the velocities of LIGGGHTS' half steps lag by a half.
    EXPECT_NEAR(spin[1], 100 * std::exp(-0.6), 0.05);
    EXPECT_EQ(spin[0], 100);
}

/// Where LIGGGHTS alone would end the process, an error arrives: `quit`, also in an `if`, which are refused; an error of a
/// compute and a log file that cannot be opened, with LIGGGHTS' message. The process of this test would be gone.
TEST(Liggghts, DoesNotEndTheProcess)
{
    const auto messageOf = [](const std::string& command) {
        Particles particles;
        particles.dem.particles = {{0.005, 0.01, 0.01}};
        particles.dem.more = command + '\n';
        return errorOf([&] { particles.start(nullptr); });
    };
    for (const std::string quit : {"quit", "if '2 > 1' then quit"})
    {
        const std::string message = messageOf(quit);
        EXPECT_NE(message.find(": '" + quit + "'; allowed: "), std::string::npos) << message;
        EXPECT_NE(message.find(" without 'quit'"), std::string::npos) << message;
    }
    const std::string ofCompute = messageOf("compute near all coord/atom 0.003 mix maybe");
    EXPECT_NE(ofCompute.find("compute coord/atom (id near): "), std::string::npos) << ofCompute;
    LiggghtsSetup setup;
    setup.communicator = MPI_COMM_SELF; // who opens the file
    setup.logFile = "none/log.liggghts";
    const std::string ofLog = errorOf([&] { LiggghtsEngine engine(setup); });
    EXPECT_NE(ofLog.find("LIGGGHTS did not start: Cannot open universe log file"), std::string::npos) << ofLog;
}

/// A file that is no restart file is named. LIGGGHTS goes round for ever in one of zeros, as a crash of the machine leaves
/// behind, and ends the process in one where the first text has the length -1.
TEST(Liggghts, RefusesWhatIsNoRestartFile)
{
    const std::string file = testing::TempDir() + "clepsydraModels" + std::to_string(getpid()) + ".restart";
    const std::string zeros(4096, '\0');
    for (const std::string& content : {zeros, zeros.substr(0, 4) + "\xff\xff\xff\xff" + zeros, std::string("text")})
    {
        std::ofstream(file) << content;
        Particles particles;
        particles.dem.readRestart = file;
        const std::string message = errorOf([&] { particles.start(nullptr); });
        EXPECT_NE(message.find(file + " is no restart file; allowed"), std::string::npos) << message;
    }
    std::filesystem::remove(file);
}

/// What a resumed run does with a command. Repeated, `replicate` would double the particles, `write_restart` would write the
/// state of the checkpoint over that of the start, and `shell rm` would remove what the run has written; left out, a fix or a
/// dump would be missing.
TEST(Liggghts, KnowsWhichCommandsAResumedRunRepeats)
{
    const std::vector<std::pair<OnResume, std::vector<std::string>>> expected = {
        {OnResume::repeat, {"", "# replicate 1 1 2", "fix gravity all gravity 9.81 vector 0 0 -1",
                               "dump d all custom 50 DEM/d id x", "variable t equal step",
                               "print \"file and append in a text\"", "shell mkdir post", "region r block 0 1"}},
        {OnResume::takeFromCheckpoint,
            {"create_box 2 domain", "read_data packing", "replicate 1 1 2", "change_box all z final 0 1 units box",
                "read_dump frames.dump 50 x y z", "create_atoms 1 single 0 0 0", "set group all diameter 1e-3",
                "  velocity all set 0 0 1", "group moving union all", "reset_timestep 0",
                "displace_atoms all move 0 0 1e-3 units box", "delete_atoms group moving", "delete_bonds all multi",
                "rotate all", "read_restart packing.restart"}},
        {OnResume::leaveOut,
            {"write_restart start.restart", "write_dump all custom start.dump id", "print \"begun\" file begun.txt",
                "print begun append begun.txt", "shell rm -r post", "shell"}},
        {OnResume::unknown, {"make_particles all"}},
    };
    for (const auto& [what, commands] : expected)
    {
        for (const std::string& command : commands)
        {
            EXPECT_EQ(onResume(command), what) << command;
        }
    }
}

/// Commands that end the program, or hide others from it, are refused with their line, also within an `if`; so is there one
/// that a resumed run would have to leave out.
TEST(Liggghts, RefusesCommandsThatHideOrEndIt)
{
    const std::string file = testing::TempDir() + "clepsydraModels" + std::to_string(getpid()) + ".hiding";
    for (const std::string command : {"clear", "partition yes 1 fix g all gravity 9.81 vector 0 0 -1", "quit",
             "run_time 1", "if \"1 > 0\" then \"replicate 1 1 2\"", "if \"1 > 0\" then \"shell rm -r post\"",
             "if \"1 > 0\" then \"write_restart start.restart\""})
    {
        std::ofstream(file) << "units si\n" << command << '\n';
        const std::string message = errorOf([&] { readScript(file, {}); });
        EXPECT_NE(message.find(file + " line 2: '" + command + "'; allowed"), std::string::npos) << message;
    }
    std::ofstream(file) << "if \"1 > 0\" then \"shell mkdir post\" else \"print no\"\n";
    EXPECT_EQ(errorOf([&] { readScript(file, {}); }), "");
    std::filesystem::remove(file);
}

/// A variable whose value holds its own name is one without a value. Replaced again and again it never comes to an end.
TEST(Liggghts, RefusesAnIncludeWhoseVariableHoldsItself)
{
    const std::string file = testing::TempDir() + "clepsydraModels" + std::to_string(getpid()) + ".include";
    std::ofstream(file) << "include DEM/in.${sizes}\n";
    const std::string message = errorOf([&] { readScript(file, {{"sizes", "a${sizes}"}}); });
    EXPECT_NE(message.find(file + " line 1: include 'DEM/in.a${sizes}'; allowed"), std::string::npos) << message;
    std::filesystem::remove(file);
}

/// A file that includes itself, also through another one and by another path, is named with its line; one that is included
/// twice is read twice. The stack ran over.
TEST(Liggghts, RefusesAScriptThatIncludesItself)
{
    const std::string name = "clepsydraModels" + std::to_string(getpid());
    const std::string first = testing::TempDir() + name + ".first";
    const std::string second = testing::TempDir() + name + ".second";
    const auto messageOf = [&](const std::string& ofFirst, const std::string& ofSecond) {
        std::ofstream(first) << ofFirst;
        std::ofstream(second) << ofSecond;
        return errorOf([&] { readScript(first, {}); });
    };
    const std::string again = "include " + testing::TempDir() + "./" + name + ".first";
    const std::string itself = messageOf(again + '\n', "");
    EXPECT_NE(itself.find(first + " line 1: " + again.substr(0, 7)), std::string::npos) << itself;
    EXPECT_NE(itself.find("allowed: a file that does not include " + first), std::string::npos) << itself;
    const std::string through = messageOf("units si\ninclude " + second + '\n', "\n" + again + '\n');
    EXPECT_NE(through.find(second + " line 2: " + again.substr(0, 7)), std::string::npos) << through;
    const std::string twice = "include " + second + '\n';
    EXPECT_EQ(messageOf(twice + twice, "units si\n"), "");
    std::filesystem::remove(first);
    std::filesystem::remove(second);
}

/// When the last particle has been thrown out of the box LIGGGHTS speaks of atom types; the error says what has happened.
TEST(Liggghts, TellsThatAllParticlesAreGone)
{
    Particles particles;
    particles.dem.particles = {{0.005, 0.01, 0.01}};
    particles.dem.more = "velocity all set 0 0 1e6 units box\n";
    LiggghtsEngine& engine = particles.start(nullptr);
    const bool isHere = engine.particles().size() > 0;
    try
    {
        engine.advance(500);
        ADD_FAILURE() << "the particle is gone, and nothing was said";
    }
    catch (const DemEngineError& error)
    {
        const std::string message = error.what();
        EXPECT_EQ(message.find("No particle is left of the 1") != std::string::npos, isHere) << message;
        EXPECT_EQ(message.find("particle 1 is at (0.005 0.01 ") != std::string::npos, isHere) << message;
    }
}

/// Gravity is the sum of all fixes, in whatever direction; the first one alone was looked at.
TEST(Liggghts, AddsUpTheGravityOfAllFixes)
{
    Particles particles;
    particles.dem.particles = {{0.005, 0.01, 0.01}};
    particles.dem.more = "fix sideways all gravity 3 vector 1 0 0\n";
    const LiggghtsEngine& engine = particles.start(nullptr);
    EXPECT_NEAR((engine.gravity() - Vector3d(3, 0, -9.81)).norm(), 0, 1e-12);
}

/// Fixes with their groups and commands as LIGGGHTS has read them, those that are gone left out, and those that
/// integrate the same particles, also particles that are still to be inserted.
TEST(Liggghts, StatesWhatTheScriptHasMade)
{
    Particles particles;
    particles.dem.particles = {{0.005, 0.01, 0.01}, {0.035, 0.01, 0.01}};
    particles.dem.more = "variable second equal 2\ngroup later initialize\ngroup one id 1\ngroup two id ${second}\n"
                         "unfix integrate\nfix a one nve/sphere\nfix b two nve/noforce\nfix c later nve/sphere\n"
                         "region feed block 0.01 0.03 0.005 0.015 0.005 0.015 units box\n"
                         "fix t all particletemplate/sphere 10007 atom_type 1 density constant 2500. radius constant "
                         "0.001\nfix d all particledistribution/discrete 10009 1 t 1.0\n"
                         "fix pour later insert/rate/region seed 86028121 distributiontemplate d nparticles ${most} "
                         "particlerate 2000 insert_every 25 overlapcheck yes all_in yes vel constant 0. 0. 0. region "
                         "feed\n";
    particles.variables = {{"most", "INF"}, {"limit", "1e-3"}};
    particles.start(nullptr);
    const ScriptFacts& facts = particles.facts();
    const auto find = [&](const std::string& id) {
        return std::find_if(
            facts.fixes.begin(), facts.fixes.end(), [&](const ScriptFacts::Fix& fix) { return fix.id == id; });
    };
    EXPECT_EQ(find("integrate"), facts.fixes.end());
    ASSERT_NE(find("b"), facts.fixes.end());
    EXPECT_EQ(find("b")->style, "nve/noforce");
    EXPECT_EQ(find("b")->group, "two");
    EXPECT_TRUE(find("b")->integrates);
    EXPECT_EQ(find("b")->command.text, "fix b two nve/noforce");
    EXPECT_NE(find("pour")->command.text.find("nparticles INF"), std::string::npos) << find("pour")->command.text;
    EXPECT_EQ(facts.lastCommand("group")->text, "group two id 2");
    EXPECT_EQ(facts.unitStyle, "si");
    EXPECT_EQ(facts.atomStyle, "granular");
    EXPECT_EQ(facts.runStyle, "verlet");
    EXPECT_EQ(facts.pairStyle, "gran");
    EXPECT_FALSE(facts.periodic.isPeriodic());
    EXPECT_TRUE(facts.integratedTwice.empty());

    const auto shared = [](const std::string& more) {
        Particles other;
        other.dem.particles = {{0.005, 0.01, 0.01}, {0.035, 0.01, 0.01}};
        other.dem.more = more;
        std::string text;
        other.start(nullptr);
        for (const auto& [first, second] : other.facts().integratedTwice)
        {
            text += first + ' ' + second + ';';
        }
        return text;
    };
    EXPECT_EQ(shared("group two id 2\nfix again two nve/noforce\n"), "integrate again;");
    EXPECT_EQ(shared("group none id 3\nfix again none nve/noforce\n"), "");
}

/// A step of another length in the middle of a coupling step would leave the particles behind the fluid.
TEST(Liggghts, RefusesAStepThatChanges)
{
    Particles particles;
    particles.dem.particles = {{0.005, 0.01, 0.01}};
    particles.dem.more = "velocity all set 1 0 0 units box\nfix reset all dt/reset 1 1e-9 1e-6 1e-7 units box\n";
    const std::string message = errorOf([&] { particles.start(nullptr).advance(10); });
    EXPECT_NE(message.find("The script changes the DEM step during the run, from "), std::string::npos) << message;
    EXPECT_NE(message.find("; allowed: a DEM step that remains the same"), std::string::npos) << message;
}

/// A box of 3 m with particles of 2 mm has more bins than LIGGGHTS can count, twice over: each message names the command
/// that helps, and with both commands it starts.
TEST(Liggghts, SaysWhatToDoAboutTooManyBins)
{
    const auto messageIn3m = [](const std::string& map, const std::string& more) {
        Particles particles;
        particles.box.upper = {3, 3, 3};
        particles.map = "map hash" + map;
        particles.dem.particles = {{0.005, 0.01, 0.01}};
        particles.dem.more = more;
        return errorOf([&] { particles.start(nullptr); });
    };
    const std::string ofSorting = messageIn3m("", "neigh_modify binsize 0.1\n");
    EXPECT_NE(ofSorting.find("Too many atom sorting bins; allowed: "), std::string::npos) << ofSorting;
    EXPECT_NE(ofSorting.find("'atom_modify sort 0 0'"), std::string::npos) << ofSorting;
    const std::string ofNeighbours = messageIn3m(" sort 0 0", "");
    EXPECT_NE(ofNeighbours.find("neighbor bins; allowed: "), std::string::npos) << ofNeighbours;
    EXPECT_NE(ofNeighbours.find("'neigh_modify binsize <length>'"), std::string::npos) << ofNeighbours;
    EXPECT_EQ(messageIn3m(" sort 0 0", "neigh_modify binsize 0.1\n"), "");
}

/// Particles without a radius of their own: the coupling would read an array that LIGGGHTS does not have.
TEST(Liggghts, RefusesAtomsWithoutRadius)
{
    const std::string file = testing::TempDir() + "clepsydraModels" + std::to_string(getpid()) + ".atomic";
    std::ofstream(file) << "atom_style atomic\nunits si\nregion domain block 0 1 0 1 0 1\ncreate_box 1 domain\n";
    LiggghtsSetup setup;
    setup.script = file;
    setup.logFile = "/dev/null";
    const std::string message = errorOf([&] { LiggghtsEngine engine(setup); });
    EXPECT_NE(message.find("atom_style 'atomic'"), std::string::npos) << message;
    EXPECT_NE(message.find("allowed: atom_style granular"), std::string::npos) << message;
    std::filesystem::remove(file);
}

namespace
{

/// Position, velocity and angular velocity, a column for each particle, after 260 particles of two sizes have fallen into a heap,
/// with friction and sliding. Twenty pairs touch at the start, when no spring is loaded.
Eigen::MatrixXd heap(
    int steps, const std::string& wordsOfContactLaw, const std::string& more = {}, const std::string& map = "map array")
{
    Particles particles;
    particles.map = map;
    particles.dem.walls = true;
    particles.dem.timeStep = 2e-5;
    particles.dem.particles = simpleLattice(particles.box, {10, 6, 4});
    jitter(particles.dem.particles, 4e-4, 1);
    for (std::size_t particle = 0; particle < 20; ++particle)
    {
        particles.dem.particles.emplace_back(particles.dem.particles[particle] + Vector3d(0, 0, 0.0022));
    }
    particles.dem.more =
        "group larger id 1:100\nset group larger diameter 2.6e-3\n"
        "fix rolling all property/global coefficientRollingFriction peratomtypepair 2 0.2 0.2 0.2 0.2\n"
        "pair_style gran model hertz tangential history "
        + wordsOfContactLaw + "\npair_coeff * *\n" + more;
    LiggghtsEngine& engine = particles.start(nullptr);
    engine.advance(steps);
    const ParticlesView view = engine.particles();
    Eigen::MatrixXd state = Eigen::MatrixXd::Zero(9, static_cast<Eigen::Index>(particles.dem.particles.size()));
    for (Eigen::Index particle = 0; particle < view.size(); ++particle)
    {
        state.col(view.id[particle] - 1) << view.position.col(particle), view.velocity.col(particle),
            view.angularVelocity.col(particle);
    }
    MPI_Allreduce(MPI_IN_PLACE, state.data(), static_cast<int>(state.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return state;
}

} // namespace

/// Our contacts and LIGGGHTS' own, which any further word in the line of the contact law brings back, here one that
/// states the default: the same to the last bit after 2000 steps and thousands of contacts, on one rank and across the
/// boundary between two; one wrong digit in one contact would be a millimetre by then. Both keep the springs of contacts
/// that have parted, as LIGGGHTS does. With OpenFOAM's traps set, as in a run.
TEST(Liggghts, HasTheSameContactsAsItsOwn)
{
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    const Eigen::MatrixXd ours = heap(2000, "tangential_reset off");
    fedisableexcept(FE_ALL_EXCEPT);
    const Eigen::MatrixXd theirs = heap(2000, "tangential_reset off tangential_damping on");
    EXPECT_EQ(ours, theirs);
    EXPECT_GT(ours.bottomRows<3>().norm(), 1) << "nothing turns, so nothing touches";
}

/// The same with rolling friction, which slows the rotation. Twenty pairs touch at the start without turning against each
/// other.
TEST(Liggghts, HasTheSameRollingFrictionAsItsOwn)
{
    const std::string rolling = "rolling_friction cdt tangential_reset off";
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    const Eigen::MatrixXd ours = heap(2000, rolling);
    fedisableexcept(FE_ALL_EXCEPT);
    EXPECT_EQ(ours, heap(2000, rolling + " tangential_damping on"));
    EXPECT_LT(ours.bottomRows<3>().norm(), 0.8 * heap(2000, "tangential_reset off").bottomRows<3>().norm());
}

/// The search by rows of bins finds the pairs that LIGGGHTS finds when it compares all with all, also where pairs of a
/// group are excluded. The forces on a particle are added up in another order, so the states differ by rounding. A pair
/// that is missing, or an excluded one that is not, makes a difference of a tenth of a millimetre.
TEST(Liggghts, FindsThePairsThatAComparisonOfAllWithAllFinds)
{
    constexpr int steps = 2000;
    const std::string excluded = "neigh_modify exclude group larger larger\n";
    const Eigen::MatrixXd with = heap(steps, "", excluded);
    const Eigen::MatrixXd without = heap(steps, "");
    EXPECT_GT((with - without).topRows<3>().cwiseAbs().maxCoeff(), 1e-4);
    const auto largestDifference = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
        return (a - b).topRows<3>().cwiseAbs().maxCoeff();
    };
    EXPECT_LT(largestDifference(with, heap(steps, "", excluded + "neighbor 0.001 nsq\n")), 1e-8);
    EXPECT_LT(largestDifference(without, heap(steps, "", "neighbor 0.001 nsq\n")), 1e-8);
}

/// A new neighbour list makes LIGGGHTS forget springs of contacts that have parted. With a new one in every step it does
/// what our contacts do without: the same to the last bit, whoever evaluates them. It differs from what LIGGGHTS does
/// with lists that last, so some contacts have parted and met again.
TEST(Liggghts, ForgetsWhatItsOwnForgetsWithAListForEveryStep)
{
    constexpr int steps = 1200;
    const Eigen::MatrixXd ours = heap(steps, "");
    EXPECT_EQ(ours, heap(steps, "tangential_reset on tangential_damping on"));
    EXPECT_EQ(
        ours, heap(steps, "tangential_reset off tangential_damping on", "neigh_modify delay 0 every 1 check no\n"));
    EXPECT_NE(ours, heap(steps, "tangential_reset off"));
}

/// Particles are found by a hash of their numbers, whose memory does not grow with the largest of them on every rank, with the
/// same springs of contacts, to the last bit, as by an array.
TEST(Liggghts, FindsParticlesByAHashAsByAnArray)
{
    constexpr int steps = 1200;
    EXPECT_EQ(heap(steps, "", "", "map hash"), heap(steps, ""));
}

namespace
{

/// A file of triangles, while the object exists; each rank has its own.
class TriangleFile
{
public:
    TriangleFile(const std::string& name, const std::vector<Triangle>& triangles)
        : name_(testing::TempDir() + name + std::to_string(getpid()) + ".stl")
    {
        std::ofstream(name_) << stlText(triangles);
    }

    ~TriangleFile()
    {
        std::filesystem::remove(name_);
    }

    TriangleFile(const TriangleFile&) = delete;
    TriangleFile& operator=(const TriangleFile&) = delete;

    const std::string& name() const
    {
        return name_;
    }

private:
    std::string name_;
};

/// How a run of funnel() differs from others.
struct FunnelRun
{
    int steps = 3000;
    bool ourWalls = true;
    /// Before the triangles.
    std::string more;
    /// How far along x particles are at the start [m].
    double particlesUpTo = 0.04;
};

/// Position and velocity, a column for each particle, after 240 particles have fallen into a funnel of triangles in which a
/// plate swings to and fro.
/// \param atEnd  is called with LIGGGHTS as the run has left it
Eigen::MatrixXd funnel(const FunnelRun& run, const std::function<void(LiggghtsProgram&)>& atEnd = {})
{
    Box box;
    box.upper = {0.04, 0.02, 0.05};
    const Vector3d low(0.013, 0.007, 0.001);
    const std::array<Vector3d, 4> rim = {
        Vector3d(0, 0, 0.01), Vector3d(0.04, 0, 0.01), Vector3d(0.04, 0.02, 0.01), Vector3d(0, 0.02, 0.01)};
    const TriangleFile sides("clepsydraFunnel",
        {{rim[0], rim[1], low}, {rim[1], rim[2], low}, {rim[2], rim[3], low}, {rim[3], rim[0], low}});
    const TriangleFile plate("clepsydraPlate",
        {{Vector3d(0.02, 0.005, 0.011), Vector3d(0.03, 0.005, 0.0105), Vector3d(0.025, 0.015, 0.0115)}});
    DemScript dem;
    dem.timeStep = 2e-5;
    dem.friction = 0.4;
    dem.particles = simpleLattice({{0, 0, 0.013}, {run.particlesUpTo, 0.02, 0.05}, {}}, {10, 6, 4});
    jitter(dem.particles, 4e-4, 1);
    // Lists of neighbours that last let contacts part and meet again within one list.
    dem.more = run.more + "neighbor 0.003 bin\nfix sides all mesh/surface file " + sides.name()
               + " type 2\nfix plate all mesh/surface file " + plate.name()
               + " type 2\nfix swing all move/mesh mesh plate wiggle amplitude 0.002 0. 0. period 0.02\n"
                 "fix meshes all wall/gran model hertz tangential history mesh n_meshes 2 meshes sides plate\n";
    LiggghtsProgram program(testing::TempDir() + "clepsydraFunnel.log" + std::to_string(getpid()), MPI_COMM_WORLD, {});
    if (run.ourWalls)
    {
        replaceMeshWallContacts(program);
    }
    allowUnequalSubdomains(program);
    std::istringstream lines(dem.text(box));
    for (std::string line; std::getline(lines, line);)
    {
        program.execute(line, "test");
    }
    LiggghtsParticles particles(program);
    particles.requestState(numbersOf(CouplingState()));
    particles.addProperties(false);
    program.execute("run " + std::to_string(run.steps), "test");
    const ParticlesView view = particles.view();
    Eigen::MatrixXd state = Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(dem.particles.size()));
    for (Eigen::Index particle = 0; particle < view.size(); ++particle)
    {
        state.col(view.id[particle] - 1) << view.position.col(particle), view.velocity.col(particle);
    }
    MPI_Allreduce(MPI_IN_PLACE, state.data(), static_cast<int>(state.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    if (atEnd)
    {
        atEnd(program);
    }
    return state;
}

int ranksOfTest()
{
    int ranks = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    return ranks;
}

} // namespace

/// Walls of triangles, at rest and moving, by our evaluation and by LIGGGHTS' own: the same to the last bit after hundreds of
/// contacts at faces, edges and corners. A contact that is missed, or one whose spring is forgotten or kept too long, would be
/// a millimetre by then. Below the funnel there is nothing to rest on but the floor 8 mm deeper.
TEST(Liggghts, HasTheSameContactsWithTrianglesAsItsOwn)
{
    const Eigen::MatrixXd ours = funnel({});
    FunnelRun other;
    other.ourWalls = false;
    EXPECT_EQ(ours, funnel(other));
    EXPECT_GT(ours.row(2).mean(), 0.009) << "particles are not on the triangles";
}

/// Two ranks share a box 40 mm long, and the particles come to rest about its third: without `fix balance` one of them gets
/// nearly all. The box is cut elsewhere then, at the start and again and again, with particles, triangles and the springs of
/// contacts on both sides. While the particles fall, what is lost on the way shows at once, because rounding is all that may
/// differ: a triangle that is not handed on lets a particle through.
TEST(Liggghts, CutsTheBoxWhereTheParticlesAre)
{
    FunnelRun start;
    start.steps = 1200;
    FunnelRun balanced = start;
    balanced.more = "fix balance all balance 40 1.05\n";
    EXPECT_LT((funnel(start) - funnel(balanced)).topRows(3).cwiseAbs().maxCoeff(), 1e-9);
    balanced.steps = start.steps = 3000;
    const auto busiest = [&](const FunnelRun& run) {
        double ratio = 0;
        FunnelRun asked = run;
        asked.more += "fix watched all balance 1000000 1000\n";
        const Eigen::MatrixXd state = funnel(asked, [&](LiggghtsProgram& program) {
            program.execute("variable busiest equal f_watched", "test");
            ratio = std::stod(program.withVariables("${busiest}"));
        });
        EXPECT_GT(state.row(2).mean(), 0.009) << "particles have fallen through the triangles";
        return ratio;
    };
    EXPECT_LT(busiest(balanced), 1.1);
    FunnelRun onOneSide = start;
    onOneSide.particlesUpTo = 0.025;
    onOneSide.steps = 0;
    FunnelRun balancedAtOnce = onOneSide;
    balancedAtOnce.more = balanced.more;
    EXPECT_LT(busiest(balancedAtOnce), 1.1);
    if (ranksOfTest() > 1)
    {
        EXPECT_GT(busiest(start), 1.3);
        EXPECT_GT(busiest(onOneSide), 1.3);
    }
}

/// What would be left without effect, and the fix whose measure of the boxes would be wrong after the first cut.
TEST(Liggghts, RefusesABalanceThatItCannotKeep)
{
    const auto messageOf = [](const std::string& more) {
        Particles particles;
        particles.dem.particles = {{0.005, 0.01, 0.01}};
        particles.dem.more = more;
        return errorOf([&] { particles.start(nullptr); });
    };
    for (const char* const wrong : {"", " 0 1.1", " 10", " 10 1", " 1.5 1.1", " 10 1.1x", " 10 1.1 shift xyz 10 1.05"})
    {
        const std::string message = messageOf(std::string("fix balance all balance") + wrong + '\n');
        EXPECT_NE(message.find("allowed: 'fix ID all balance N threshold'"), std::string::npos)
            << wrong << ": " << message;
    }
    EXPECT_EQ(messageOf("fix balance all balance 10 1.1\n"), "");
    const std::string message = messageOf("fix balance all balance 10 1.1\n"
                                          "fix mean all ave/euler nevery 10 cell_size_relative 4 parallel yes\n");
    EXPECT_NE(message.find("fix balance cannot be used with fix ave/euler"), std::string::npos) << message;
}

/// A particle is led past another: it touches it and shears the contact by B, parts, goes back, and touches it again with a
/// shear of B, all within one neighbour list. The second contact is a new one, its spring k_t B. LIGGGHTS goes on with
/// the old one, 2 k_t B, which `tangential_reset off` keeps. Both hold whoever evaluates the contact: a further word in the
/// line brings LIGGGHTS' own loop back.
TEST(Liggghts, ForgetsTheSpringOfAContactThatHasParted)
{
    constexpr double deepest = 1e-5;
    constexpr double shear = 1e-6;
    const auto secondSpring = [](const std::string& words) {
        Particles particles;
        particles.dem.gravity = 0;
        particles.dem.fixed = true;
        particles.dem.restitution = 1; // no damping
        particles.dem.friction = 1e6;  // no sliding
        particles.dem.particles = {{0.01, 0.01, 0.01}, {0.01, 0.01, 0.01 + 2 * radius - deepest}};
        const auto line = [](const std::string& name, double scale, const std::string& function) {
            std::ostringstream text;
            text << "variable " << name << " equal " << scale << '*' << function << '\n';
            return text.str();
        };
        constexpr double period = 0.01;
        constexpr double rate = 2 * static_cast<double>(EIGEN_PI) / period;
        std::ostringstream phase;
        phase << '(' << rate << "*step*dt)";
        particles.dem.more =
            "group led id 2\n" + line("x", shear, "sin" + phase.str()) + line("vx", shear * rate, "cos" + phase.str())
            + line("z", deepest, "(1-cos" + phase.str() + ")") + line("vz", deepest * rate, "sin" + phase.str())
            + "fix lead led move variable v_x NULL v_z v_vx NULL v_vz units box\n"
              "pair_style gran model hertz tangential history "
            + words + "\npair_coeff * *\n";
        Probe probe;
        particles.start(&probe).advance(static_cast<int>(std::lround(period / particles.dem.timeStep)));
        const double shearModulus = particles.dem.youngsModulus / (4 * (2 - 0.2) * (1 + 0.2));
        const double stiffness = 8 * shearModulus * std::sqrt(radius / 2 * deepest);
        return otherForce(probe, 1).x() / (stiffness * shear);
    };
    EXPECT_NEAR(secondSpring(""), 1, 0.01);
    EXPECT_NEAR(secondSpring("tangential_reset on tangential_damping on"), 1, 0.01);
    EXPECT_NEAR(secondSpring("tangential_reset off"), 2, 0.01);
    EXPECT_NEAR(secondSpring("tangential_damping on tangential_reset off"), 2, 0.01);
    EXPECT_THROW(secondSpring("tangential_reset maybe"), DemEngineError);
    EXPECT_THROW(secondSpring("forget_parted off"), DemEngineError); // the old name
}

/// Two particles 50 um apart, one on either side of the boundary between two ranks, beyond the skin of 1 um, approach by
/// .2 mm/s: lubrication slows both alike by c v/m, and no contact force acts at that distance. A list that ends at
/// the skin shows no force; pairs counted once per rank but applied to both particles on either show twice of it. The first
/// particle leaves the fluid then, half of it and all: both are slowed by so much less, also where it is another rank's.
TEST(Liggghts, LubricatesPairsAcrossRanks)
{
    Particles particles;
    constexpr double gap = 5e-5;
    constexpr double speed = 1e-4;
    particles.dem.gravity = 0;
    particles.dem.particles = {{0.02 - radius - gap / 2, 0.01, 0.01}, {0.02 + radius + gap / 2, 0.01, 0.01}};
    particles.dem.more =
        "neighbor 1e-6 bin\ngroup first id 1\ngroup second id 2\nvelocity first set 1e-4 0 0 units box\n"
        "velocity second set -1e-4 0 0 units box\n";
    const FluidProperties fluid{1000, 1e-3, Vector3d::Zero()};
    Foam::dictionary dict(
        Foam::IStringStream("forceModels (lubricationForce); lubricationForceProps { roughness 1e-6; reach 0.1; }")());
    PhaseTimers timers;
    ParticleForces forces(dict, ModelType::A, fluid, timers);
    LiggghtsEngine& engine = particles.start(&forces, forces.needs().pairReach);
    engine.advance(20);
    const double coefficient = closures::squeezeCoefficient(1e-3, radius / 2, gap, 1e-6, 0.2 * radius);
    const double slowed = speed - particles.velocity(1).x();
    EXPECT_NEAR(slowed / (20 * engine.timeStep() * coefficient * 2 * speed / particleMass), 1, 0.01);
    for (const double part : {0.5, 0.0})
    {
        const ParticlesView view = engine.particles();
        for (Eigen::Index particle = 0; particle < view.size(); ++particle)
        {
            view.state[particle].fluid.submergedFraction = view.id[particle] == 1 ? part : 1;
        }
        engine.advance(1); // the first half of a step has the force of the last one
        const double before = particles.velocity(1).x();
        engine.advance(20);
        EXPECT_NEAR((before - particles.velocity(1).x()) / slowed, part, 0.05);
    }
    EXPECT_LT((particles.velocity(1) + particles.velocity(2)).norm(), 1e-12 * speed);
}

/// sjkr: an attraction k A, A the area where the spheres cut each other, pi (R^2 - (l/2)^2) for alike ones at distance
/// l: R 1 mm, l 1.9 mm: pi*9.75e-8 = 3.063053e-7 m2, * 1e5 J/m3 = 3.063053e-2 N. With the wrong sign the particles repel.
TEST(Liggghts, CohesionSjkrAttractsByTheAreaOfContact)
{
    const auto forceOnSecond = [](const std::string& model, double energyDensity) {
        Particles particles;
        particles.dem.gravity = 0;
        particles.dem.particles = {{0.0090, 0.01, 0.01}, {0.0109, 0.01, 0.01}};
        if (energyDensity > 0)
        {
            particles.dem.more =
                "fix cohesion all property/global cohesionEnergyDensity peratomtypepair 2 1e5 1e5 1e5 1e5\n";
        }
        Probe probe;
        particles.start(&probe, 0, model);
        return otherForce(probe, 2).x();
    };
    const double attraction =
        forceOnSecond("tangential history", 0) - forceOnSecond("tangential history cohesion sjkr", 1e5);
    EXPECT_NEAR(attraction / 3.063053e-2, 1, 1e-4);
}

namespace
{

struct Roll
{
    double sliding; // deceleration while the particle slides, in units of g
    double rolling; // speed when it has begun to roll, in units of the first
    double slowing; // deceleration while it rolls, in units of g
};

/// A particle on the floor, started at 10 cm/s without spin.
Roll roll(double wallFriction, const std::string& model, double rollingFriction)
{
    Particles particles;
    particles.dem.walls = true;
    particles.dem.restitution = 0.5;
    particles.dem.wallFriction = wallFriction;
    particles.dem.particles = {{0.005, 0.01, radius}};
    particles.dem.more = "velocity all set 0.1 0 0 units box\n";
    if (rollingFriction > 0)
    {
        const std::string value = std::to_string(rollingFriction);
        particles.dem.more += "fix rolling all property/global coefficientRollingFriction peratomtypepair 2 " + value
                              + ' ' + value + ' ' + value + ' ' + value + '\n';
    }
    Probe probe;
    LiggghtsEngine& engine = particles.start(&probe, 0, model);
    const auto speedAfter = [&](double seconds) {
        engine.advance(static_cast<int>(std::lround(seconds / engine.timeStep())));
        return particles.velocity(1).x();
    };
    const double first = speedAfter(0.003);
    const double second = speedAfter(0.006);
    const double third = speedAfter(0.041);
    const double last = speedAfter(0.1);
    return {(first - second) / 0.006 / 9.81, third / 0.1, (third - last) / 0.1 / 9.81};
}

} // namespace

/// Friction of its own for the floor: a sliding particle is slowed by mu g (.15 among particles, .3 here), then rolls on at 5/7
/// of its speed for ever. With the particles' own friction for the wall it is half.
TEST(Liggghts, WallsHaveTheirOwnFriction)
{
    for (const double friction : {0.15, 0.3})
    {
        const Roll r = roll(friction, "tangential history", 0);
        EXPECT_NEAR(r.sliding / friction, 1, 0.03);
        EXPECT_NEAR(r.rolling, 5.0 / 7, 0.01);
        EXPECT_NEAR(r.slowing, 0, 1e-4);
    }
}

/// Rolling friction mu_r: a torque mu_r F_n R slows a rolling particle by 5/7 mu_r g; none is there without the model.
TEST(Liggghts, RollingFrictionSlowsARollingParticle)
{
    for (const std::string model : {"cdt", "epsd2"})
    {
        const Roll r = roll(0.3, "tangential history rolling_friction " + model, 0.03);
        EXPECT_NEAR(r.slowing / (5.0 / 7 * 0.03), 1, 0.05) << model;
    }
}

namespace
{

std::string outputOf(const std::string& command)
{
    FILE* pipe = popen(command.c_str(), "r");
    std::string output;
    std::array<char, 4096> buffer;
    for (std::size_t count; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    {
        output.append(buffer.data(), count);
    }
    EXPECT_EQ(pclose(pipe), 0) << command;
    return output;
}

} // namespace

/// scripts/sizeDistribution's lines make LIGGGHTS pour particles of a normal distribution cut at two deviations: mean 2 mm,
/// deviation .8796 * .1 mm (a normal one cut there), less 1 % for the classes, none outside. Shares taken by mass, as
/// LIGGGHTS does by default, shift the mean by a per cent; a single template has no deviation.
TEST(Liggghts, FillsADistributionOfSizes)
{
    Particles particles;
    particles.dem.more = outputOf(std::string(SIZE_DISTRIBUTION) + " --mean 2e-3 --deviation 1e-4")
                         + "region inside block 0 0.04 0 0.02 0 0.02 units box\n"
                           "fix pour all insert/pack seed 86028157 distributiontemplate particles maxattempt 200 "
                           "insert_every once overlapcheck yes all_in yes vel constant 0. 0. 0. region inside "
                           "particles_in_region 800\n";
    Probe probe;
    LiggghtsEngine& engine = particles.start(&probe);
    engine.advance(2);
    const Eigen::ArrayXd diameters = 2 * engine.particles().radius;
    const Vector3d sums =
        sumOverRanks({static_cast<double>(diameters.size()), diameters.sum(), diameters.square().sum()});
    const double mean = sums[1] / sums[0];
    const double deviation = std::sqrt(sums[2] / sums[0] - mean * mean);
    EXPECT_EQ(sums[0], 800);
    EXPECT_NEAR(mean / 2e-3, 1, 2e-3);
    EXPECT_NEAR(deviation / 0.8796e-4, 1, 0.06);
    EXPECT_GT(diameters.minCoeff(), 1.8e-3);
    EXPECT_LT(diameters.maxCoeff(), 2.2e-3);
}

namespace
{

/// Particles that rest below 5 mm once slower than 5 mm/s for 10 ms, and then are no more integrated.
Particles restingParticles()
{
    Particles particles;
    particles.dem.walls = true;
    particles.dem.fixed = true;
    particles.dem.restitution = 0.3;
    particles.dem.more =
        "group moving union all\ngroup resting initialize\nneigh_modify exclude group resting resting\n"
        "fix integrate moving nve/sphere\n";
    particles.groupChanges = {{"atRest", "moving", "resting", 5e-3, GroupChange::Rest{5e-3, 0.01}}};
    return particles;
}

void advanceInIntervals(LiggghtsEngine& engine, double seconds)
{
    constexpr double interval = 1e-3;
    for (int i = 0; i < std::lround(seconds / interval); ++i)
    {
        engine.advance(static_cast<int>(std::lround(interval / engine.timeStep())));
    }
}

} // namespace

/// A particle that has settled on the floor does not move any more, not even when another falls on it; that one, which
/// starts at the same time but higher, is thrown back by it and does not go through. Without the change of group the
/// particle below is moved by micrometres and more; a resting particle that is taken out altogether lets the other through.
TEST(GroupChange, RestingParticlesStayAndAreFeltByOthers)
{
    Particles particles = restingParticles();
    particles.dem.particles = {{0.0201, 0.01, 1.1e-3}, {0.0199, 0.01, 0.019}};
    LiggghtsEngine& engine = particles.start(nullptr);
    advanceInIntervals(engine, 0.05);
    const Vector3d before = particles.position(1);
    EXPECT_EQ(particles.velocity(1), Vector3d::Zero());
    ASSERT_GT(particles.position(2).z(), 3e-3);
    advanceInIntervals(engine, 0.05);
    EXPECT_EQ(particles.position(1), before);
    EXPECT_GT((particles.position(2) - before).norm(), 1.98e-3);
    EXPECT_NE(particles.velocity(2), Vector3d::Zero());
}

/// Added mass is the fluid's resistance to a particle's acceleration, and a fixed particle has none: in still water two
/// particles at rest, one upon the other, give the fluid nothing. `exclude` spares their contact, and so the weight of the
/// upper one seems to let it fall: taken for a free particle it pushed the fluid down for ever.
TEST(GroupChange, RestingParticlesDoNotPushTheFluidByTheirAddedMass)
{
    Particles particles = restingParticles();
    particles.dem.particles = {{0.0201, 0.01, 1.0e-3}, {0.0201, 0.01, 3.0e-3}};
    Foam::dictionary dict(Foam::IStringStream("forceModels (virtualMassForce Archimedes);")());
    PhaseTimers timers;
    ParticleForces forces(dict, ModelType::A, water(), timers);
    LiggghtsEngine& engine = particles.start(&forces);
    advanceInIntervals(engine, 0.05);
    ASSERT_EQ(particles.velocity(1), Vector3d::Zero());
    ASSERT_EQ(particles.velocity(2), Vector3d::Zero());
    const Vector3d before = impulseGiven(engine);
    EXPECT_GT(before.norm(), 0) << "they gave nothing while they settled either";
    advanceInIntervals(engine, 0.01);
    EXPECT_EQ(impulseGiven(engine), before);
}

/// Above the threshold no particle rests for good: the same particle on the same floor goes on trembling.
TEST(GroupChange, LeavesParticlesAboveTheThreshold)
{
    Particles particles = restingParticles();
    particles.groupChanges.front().below = 0.5e-3;
    particles.dem.particles = {{0.0201, 0.01, 1.1e-3}};
    advanceInIntervals(particles.start(nullptr), 0.05);
    EXPECT_NE(particles.velocity(1), Vector3d::Zero());
}

/// A group that the script does not make, and particles that are in neither of the two, are refused by name: nothing would
/// move them.
TEST(GroupChange, RefusesWhatTheScriptLacks)
{
    const auto messageOf = [](Particles& particles) {
        particles.dem.particles = {{0.005, 0.01, 0.01}, {0.035, 0.01, 0.01}};
        try
        {
            particles.start(nullptr).advance(1);
        }
        catch (const DemEngineError& error)
        {
            return std::string(error.what());
        }
        return std::string();
    };
    Particles misspelt = restingParticles();
    misspelt.groupChanges.front().to = "restng";
    const std::string unknown = messageOf(misspelt);
    EXPECT_NE(unknown.find("atRest"), std::string::npos) << unknown;
    EXPECT_NE(unknown.find("'restng'"), std::string::npos) << unknown;
    EXPECT_NE(unknown.find("all moving resting"), std::string::npos) << unknown;

    Particles forgotten = restingParticles();
    forgotten.groupChanges.front().from = "resting";
    forgotten.groupChanges.front().to = "other";
    forgotten.dem.more += "group other initialize\n";
    const std::string inNone = messageOf(forgotten);
    EXPECT_NE(inNone.find("is in neither of the groups 'resting' and 'other'"), std::string::npos) << inNone;
}

} // namespace clepsydra::tests
