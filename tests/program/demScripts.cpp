/// \file
/// What a DEM script may hold beside a fluid. LIGGGHTS accepts all of it, and with a fluid much of it gave wrong results
/// without a message.

#include "support/stlText.h"
#include "support/testCase.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace
{

using namespace clepsydra::tests;

using Words = std::vector<std::string>;

const std::string script = "DEM/in.particles";
const std::string allowing = "DEM/allowedInScript";

/// A case that is right: one particle above the middle of a box of water.
void fillIn(TestCase& test)
{
    test.cells = {4, 4, 8};
    test.dem.particles = {{0.0101, 0.0099, 0.02}};
    test.dem.timeStep = 4e-5;
    test.setTimes(0.002, 1e-3, 0.002);
}

/// Replaces a text in the DEM script.
void replaceInScript(TestCase& test, const std::string& from, const std::string& to)
{
    std::string text = test.dem.text(test.box);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    test.extraFiles[script] = text.replace(at, from.size(), to);
}

void withoutFluid(TestCase& test)
{
    test.coupling().set("fluid", "none");
}

void expectSays(const Outcome& outcome, const Words& words)
{
    for (const std::string& word : words)
    {
        EXPECT_TRUE(outcome.says(word)) << "not said: " << word << '\n' << outcome.output;
    }
}

void expectRefused(TestCase& test, const Words& words)
{
    const Outcome outcome = test.run();
    EXPECT_NE(outcome.status, 0) << outcome.output;
    EXPECT_LT(outcome.status, 128) << "ended by a signal\n" << outcome.output;
    expectSays(outcome, words);
}

void expectRuns(TestCase& test, const Words& words = {})
{
    const Outcome outcome = test.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    expectSays(outcome, words);
}

/// Lines at the end of the script, the last of which is refused beside a fluid by the name of its style and with a
/// reason, and which run without fluid.
void expectOnlyWithoutFluid(const std::string& lines, const std::string& style, const std::string& reason)
{
    SCOPED_TRACE(lines);
    const std::string last = lines.substr(lines.rfind('\n') + 1);
    TestCase withFluid;
    fillIn(withFluid);
    withFluid.dem.more = lines;
    expectRefused(withFluid,
        {script + " line ", "'" + last + "'", "has the style '" + style + "': " + reason,
            "allowed: a script without it", "allowedInScript ( \"" + style + "\" )", "constant/couplingProperties"});
    TestCase demOnly;
    fillIn(demOnly);
    demOnly.dem.more = lines;
    withoutFluid(demOnly);
    expectRuns(demOnly);
}

const std::string heat = "fix conductivity all property/global thermalConductivity peratomtype 1.0 1.0\n"
                         "fix capacity all property/global thermalCapacity peratomtype 800. 800.\n"
                         "fix heat all heat/gran/conduction initial_temperature 300.";

const std::string plate = stlText({{{{0.005, 0.005, 0.01}, {0.015, 0.005, 0.01}, {0.01, 0.015, 0.01}}}});
const std::string plateWall = "fix plate all mesh/surface file DEM/plate.stl type 2";

} // namespace

/// The case of the tests below without its mistake runs, and warns of nothing in the script: what they see refused or
/// warned of is the mistake.
TEST(DemScripts, TheSameCaseWithoutMistakeRuns)
{
    TestCase test;
    fillIn(test);
    const Outcome outcome = test.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    EXPECT_FALSE(outcome.says("LIGGGHTS warns")) << outcome.output;
    EXPECT_FALSE(outcome.says("have no effect")) << outcome.output;
}

/// Heat that the fluid does not carry, drag beside the fluid's own, forces that are set, and a limit of the velocity
/// that takes away momentum. They ran as if the fluid took part.
TEST(DemScripts, FixesThatAFluidMakesWrongAreRefusedByName)
{
    expectOnlyWithoutFluid(heat, "heat/gran/conduction", "the fluid neither heats nor cools the particles");
    expectOnlyWithoutFluid("fix slow all viscous 1e-6", "viscous", "the fluid's forces are those of forceModels");
    expectOnlyWithoutFluid("fix held all setforce 0 0 0", "setforce", "it is not known to work with a fluid");
}

/// The word in the dictionary allows what it names, also by a pattern, and nothing else.
TEST(DemScripts, AWordInTheDictionaryAllowsAFix)
{
    for (const std::string words : {"( \"heat/gran/conduction\" )", "( viscous \"heat/.*\" )"})
    {
        SCOPED_TRACE(words);
        TestCase test;
        fillIn(test);
        test.dem.more = heat;
        test.coupling().set(allowing, words);
        expectRuns(test);
    }
    TestCase other;
    fillIn(other);
    other.dem.more = heat;
    other.coupling().set(allowing, "( viscous )");
    expectRefused(other, {"has the style 'heat/gran/conduction'"});
}

/// A wall that moves in the DEM alone is refused, and allowed by its word: a mesh that moves, a conveyor's surface and a
/// plane that move along themselves. The fluid would stick to a wall at rest.
TEST(DemScripts, WallsThatMoveWithoutTheFluidAreRefused)
{
    const std::string moving = plateWall + "\nfix lift all move/mesh mesh plate linear 0. 0. 0.01";
    TestCase refused;
    fillIn(refused);
    refused.extraFiles["DEM/plate.stl"] = plate;
    refused.dem.more = moving;
    expectRefused(refused, {script + " line ", "fix lift has the style 'move/mesh': the wall moves in the DEM only",
                               "allowedInScript ( \"move/mesh\" )"});
    TestCase allowed;
    fillIn(allowed);
    allowed.extraFiles["DEM/plate.stl"] = plate;
    allowed.dem.more = moving;
    allowed.coupling().set(allowing, "( \"move/mesh\" )");
    expectRuns(allowed);
    TestCase belt;
    fillIn(belt);
    belt.extraFiles["DEM/plate.stl"] = plate;
    belt.dem.more = plateWall
                    + " surface_vel 0.1 0. 0.\n"
                      "fix plates all wall/gran model hertz tangential history mesh n_meshes 1 meshes plate\n"
                      "fix belt all wall/gran model hertz tangential history primitive type 2 zplane 0.001 shear x 0.2";
    // Root mean square over the patch, whose faces across the belt, two fifths of it, have no velocity along themselves.
    expectRefused(belt, {"fix plate has the word 'surface_vel': the wall moves in the DEM only",
                            "fix belt has the word 'shear': the wall moves in the DEM only",
                            "patch 'walls': velocity differs by 0.155 m/s of 0.2 m/s",
                            "allowedInScript ( \"shear\" \"surface_vel\" )"});
    TestCase allowedBelt;
    fillIn(allowedBelt);
    allowedBelt.extraFiles["DEM/plate.stl"] = plate;
    allowedBelt.dem.more = belt.dem.more;
    allowedBelt.coupling().set(allowing, "( \"s.*\" )");
    expectRuns(allowedBelt);
}

/// A plane that slides in the DEM, and a patch that does in the fluid: alike they run, also without a word in the dictionary.
/// Another speed or direction, a patch that is met head on, and a patch that moves alone are refused or warned of.
TEST(DemScripts, AWallMayMoveWithItsPatch)
{
    const auto slidingSides = [](TestCase& test, const std::string& plane, const std::string& velocity) {
        fillIn(test);
        test.setThroughFlow("uniform (0 0 0)");
        test.dem.more = plane;
        test.file("0/U").set("boundaryField/walls/type", "fixedValue").set("boundaryField/walls/value", velocity);
    };
    const std::string plane =
        "fix belt all wall/gran model hertz tangential history primitive type 2 xplane 0 shear z ";
    TestCase alike;
    slidingSides(alike, plane + "0.01", "uniform (0 0 0.01)");
    expectRuns(alike);
    TestCase slower;
    slidingSides(slower, plane + "0.01", "uniform (0 0 0.009)");
    expectRefused(
        slower, {"fix belt has the word 'shear'", "patch 'walls': velocity differs by 0.001 m/s of 0.01 m/s"});
    // The same velocity at the start; that of a table changes later, and of other conditions it is not known.
    TestCase constant;
    slidingSides(constant, plane + "0.01", "uniform (0 0 0.01)");
    constant.file("0/U")
        .set("boundaryField/walls/type", "uniformFixedValue")
        .set("boundaryField/walls/uniformValue", "constant (0 0 0.01)");
    expectRuns(constant);
    TestCase faster;
    slidingSides(faster, plane + "0.01", "uniform (0 0 0.01)");
    faster.file("0/U")
        .set("boundaryField/walls/type", "uniformFixedValue")
        .set("boundaryField/walls/uniformValue", "table ((0 (0 0 0.01)) (0.001 (0 0 0.01)) (0.002 (0 0 0.02)))");
    expectRefused(faster, {"fix belt has the word 'shear'", "patch 'walls': its uniformValue changes in time"});
    TestCase scaled;
    slidingSides(scaled, plane + "0.01", "uniform (0 0 0.01)");
    scaled.file("0/U")
        .set("boundaryField/walls/type", "scaledFixedValue")
        .set("boundaryField/walls/scale", "constant 1")
        .set("boundaryField/walls/refValue/type", "fixedValue")
        .set("boundaryField/walls/refValue/value", "uniform (0 0 0.01)");
    expectRuns(scaled, {"Patch 'walls' of 0/U now has the velocity of fix belt (shear)", "'scaledFixedValue'"});
    TestCase across;
    slidingSides(across, "fix belt all wall/gran model hertz tangential history primitive type 2 xplane 0 shear y 0.01",
        "uniform (0 0.01 0)");
    expectRefused(across, {"patch 'walls': the wall would move through it"});
    TestCase alone;
    slidingSides(alone, "", "uniform (0 0 0.01)");
    expectRuns(alone, {"Patch 'walls' moves, and no wall of the DEM script has its velocity"});
}

/// A drum about an oblique place of the origin, 4 cm wide: one that turns as its patch does is allowed, by `shear` and by a mesh
/// that moves. The other sense, speed, axis or origin is refused with what differs, and so is a box that would turn.
TEST(DemScripts, ADrumMayTurnWithItsPatch)
{
    const auto outcomeOf = [](const std::string& wall, const std::string& origin, double omega, bool isRound = true) {
        TestCase test;
        fillIn(test);
        // Around (0.01, 0.01), where the particle is.
        test.file("0/U")
            .set("boundaryField/walls/type", "rotatingWallVelocity")
            .set("boundaryField/walls/origin", origin)
            .set("boundaryField/walls/axis", "(0 0 1)")
            .set("boundaryField/walls/omega", omega)
            .set("boundaryField/walls/value", "uniform (0 0 0)");
        if (isRound)
        {
            test.file("0/U").set("boundaryField/ends/type", "slip");
            test.file("0/p").set("boundaryField/ends/type", "zeroGradient");
            test.extraFiles["system/blockMeshDict"] =
                "FoamFile { version 2.0; format ascii; class dictionary; object blockMeshDict; }\nscale 0.01;\n"
                "vertices ((0 0 0) (2 0 0) (2 2 0) (0 2 0) (0 0 4) (2 0 4) (2 2 4) (0 2 4));\n"
                "blocks (hex (0 1 2 3 4 5 6 7) (6 6 8) simpleGrading (1 1 1));\n"
                "edges (arc 0 1 (1 -0.4142135623730951 0) arc 1 2 (2.414213562373095 1 0)\n"
                "arc 2 3 (1 2.414213562373095 0) arc 3 0 (-0.4142135623730951 1 0)\n"
                "arc 4 5 (1 -0.4142135623730951 4) arc 5 6 (2.414213562373095 1 4)\n"
                "arc 6 7 (1 2.414213562373095 4) arc 7 4 (-0.4142135623730951 1 4));\n"
                "boundary (walls { type wall; faces ((0 4 7 3)(1 2 6 5)(0 1 5 4)(3 7 6 2)); }\n"
                "ends { type wall; faces ((0 3 2 1)(4 5 6 7)); });\n";
        }
        test.extraFiles["DEM/plate.stl"] = plate;
        test.dem.more = wall;
        return test.runCommand("blockMesh > log.blockMesh && $SOLVER -dryRun");
    };
    const std::string shear =
        "fix drum all wall/gran model hertz tangential history primitive type 2 zcylinder 0.0141421 0.01 0.01 shear x ";
    const std::string mesh =
        plateWall + "\nfix turn all move/mesh mesh plate rotate origin 0.01 0.01 0. axis 0. 0. 1. period ";
    const std::string origin = "(0.01 0.01 0.005)";

    EXPECT_TRUE(outcomeOf(shear + "2.", origin, 2).succeeded()) << outcomeOf(shear + "2.", origin, 2).output;
    EXPECT_TRUE(outcomeOf(mesh + "3.14159265", origin, 2).succeeded());
    const auto expectRefusedWith = [](const Outcome& outcome, const Words& words) {
        EXPECT_NE(outcome.status, 0) << outcome.output;
        EXPECT_LT(outcome.status, 128) << outcome.output;
        expectSays(outcome, words);
    };
    // The wall's speed is 2 rad/s times 1.41 cm, and that of the centres of its 24 plane faces lower by cos(7.5 degrees).
    expectRefusedWith(outcomeOf(shear + "-2.", origin, 2),
        {"fix drum has the word 'shear'", "patch 'walls': velocity differs by 0.0561 m/s of 0.028 m/s"});
    expectRefusedWith(outcomeOf(mesh + "3.", origin, 2),
        {"fix turn has the style 'move/mesh'", "about (origin (0.01 0.01 0)) with the angular velocity (0 0 2.09"});
    expectRefusedWith(outcomeOf(shear + "2.", "(0.011 0.01 0)", 2), {"patch 'walls': velocity differs by 0.00"});
    expectRefusedWith(outcomeOf(shear + "2.", origin, 2, false),
        {"patch 'walls': the wall would move through it", "a component normal to it"});
}

/// Spheres that are joined overlap, and buoyancy and solid volume were 18.5 % too large for two of them.
TEST(DemScripts, JoinedSpheresAreRefused)
{
    TestCase test;
    fillIn(test);
    test.dem.particles.clear();
    test.dem.fixed = true;
    test.extraFiles["DEM/two.spheres"] = "-0.0005 0 0 0.001\n0.0005 0 0 0.001\n";
    test.dem.more = "fix pairs all particletemplate/multisphere 15485863 atom_type 1 density constant 2500 nspheres 2 "
                    "ntry 100000 spheres file DEM/two.spheres scale 1. type 1\n"
                    "fix bodies all multisphere";
    expectRefused(test, {script + " line ", "fix pairs has the style 'particletemplate/multisphere'",
                            "fix bodies has the style 'multisphere': the spheres of a body overlap",
                            "allowedInScript ( \"multisphere\" \"particletemplate/multisphere\" )"});
}

/// Between parcels a contact law with the coefficients of the real particles must keep the stress. Hertz' law does; with a
/// given stiffness the overlaps of twice the size would be twice as large again, and the run went on.
TEST(DemScripts, ContactLawsThatDoNotKeepTheStressOfParcelsAreRefused)
{
    const auto outcomeWith = [](const std::string& ratio, const std::string& contacts, bool allow) {
        TestCase test;
        fillIn(test);
        std::string text = test.dem.text(test.box);
        const std::string hertz = "model hertz tangential history";
        for (std::size_t at = text.find(hertz); at != std::string::npos; at = text.find(hertz, at + contacts.size()))
        {
            text.replace(at, hertz.size(), contacts);
        }
        const std::string beforePair = "pair_style";
        text.insert(text.find(beforePair), "fix kn all property/global kn peratomtypepair 2 1e3 1e3 1e3 1e3\n"
                                           "fix kt all property/global kt peratomtypepair 2 1e3 1e3 1e3 1e3\n"
                                           "fix gn all property/global gamman peratomtypepair 2 10 10 10 10\n"
                                           "fix gt all property/global gammat peratomtypepair 2 10 10 10 10\n");
        test.extraFiles[script] = text;
        test.coupling().set("coarseGraining", ratio);
        if (allow)
        {
            test.coupling().set(allowing, "( \"hooke/stiffness\" )");
        }
        return test.run();
    };
    const std::string stiffness = "model hooke/stiffness tangential history";
    const Outcome refused = outcomeWith("2", stiffness, false);
    EXPECT_NE(refused.status, 0);
    expectSays(refused,
        {script + " line ", "'model hooke/stiffness' is not known to be right between parcels (coarseGraining 2)",
            "allowedInScript ( \"hooke/stiffness\" )"});
    for (const auto& [ratio, contacts, allow] : std::vector<std::tuple<std::string, std::string, bool>>{
             {"1", stiffness, false}, {"2", stiffness, true}, {"2", "model hertz tangential no_history", false}})
    {
        const Outcome outcome = outcomeWith(ratio, contacts, allow);
        EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    }
}

/// With a DEM step that changes the particles lost step with the fluid: -0.070 m/s after 0.05 s for -0.204 m/s. There is
/// no word for it, and without fluid it is as wrong.
TEST(DemScripts, AChangeOfTheDemStepIsRefusedAlsoWithoutFluid)
{
    for (const bool hasFluid : {true, false})
    {
        TestCase test;
        fillIn(test);
        test.dem.more = "fix reset all dt/reset 10 1e-7 1e-5 1e-6 units box";
        test.coupling().set(allowing, "( \".*\" )");
        if (!hasFluid)
        {
            withoutFluid(test);
        }
        expectRefused(test, {script + " line ", "'fix reset all dt/reset 10 1e-7 1e-5 1e-6 units box'",
                                "fix reset changes the DEM step", "allowed: a script without 'dt/reset'"});
    }
}

/// Of several fixes the sum counts: twice the gravity is refused with the names of both, where the first alone was
/// compared, and two halves are as good as the whole.
TEST(DemScripts, GravityOfSeveralFixesIsTheirSum)
{
    TestCase twice;
    fillIn(twice);
    twice.dem.more = "fix gravity2 all gravity 9.81 vector 0 0 -1";
    expectRefused(twice, {"constant/g is (0 0 -9.81)", "(together: gravity, gravity2) gives (0 0 -19.62)", "allowed:"});
    TestCase halves;
    fillIn(halves);
    halves.dem.gravity = 4.905;
    halves.dem.more = twice.dem.more;
    halves.dem.more.replace(halves.dem.more.find("9.81"), 4, "4.905");
    expectRuns(halves);
}

/// Gravity on a part of the particles and gravity that changes are at odds with constant/g, which the first step alone
/// does not show.
TEST(DemScripts, GravityThatConstantGCannotBe)
{
    TestCase part;
    fillIn(part);
    part.dem.more = "group heavy id 1\nunfix gravity\nfix weight heavy gravity 9.81 vector 0 0 -1";
    expectRefused(
        part, {script + " line ", "gravity acts on the group 'heavy' only", "allowedInScript ( \"gravity\" )"});
    TestCase changing;
    fillIn(changing);
    changing.dem.more =
        "unfix gravity\nvariable weight equal 9.81+0*step\nfix weight all gravity v_weight vector 0 0 -1";
    expectRefused(changing, {script + " line ", "gravity changes in time", "allowedInScript ( \"gravity\" )"});
}

/// The forces take a particle that fix move moves for one without acceleration: its added mass did not act on the fluid.
TEST(DemScripts, AnAccelerationByTheScriptIsRefusedBesideAddedMass)
{
    for (const bool addedMass : {true, false})
    {
        TestCase test;
        fillIn(test);
        test.dem.fixed = true;
        test.dem.more = "fix swing all move wiggle 0 0 0.001 0.02";
        test.coupling().set("forceModels",
            std::string("(DiFeliceDrag gradPForce viscForce Archimedes") + (addedMass ? " virtualMassForce)" : ")"));
        if (addedMass)
        {
            expectRefused(test, {script + " line ", "the motion 'wiggle'", "allowedInScript ( \"move\" )"});
        }
        else
        {
            expectRuns(test);
        }
    }
}

/// A particle that left a periodic box at +20 mm appeared at -20 mm, on the other side of the fluid's walls.
TEST(DemScripts, APeriodicBoxIsRefusedWhereTheMeshHasWalls)
{
    const auto fillInPeriodic = [](TestCase& test) {
        fillIn(test);
        replaceInScript(test, "boundary f f f", "boundary p f p");
    };
    TestCase test;
    fillInPeriodic(test);
    expectRefused(test, {script + " line 3: 'boundary p f p': the DEM box is periodic along x", "periodic along z",
                            "allowed: f, or a pair of cyclic patches"});
    TestCase demOnly;
    fillInPeriodic(demOnly);
    withoutFluid(demOnly);
    expectRuns(demOnly);
}

/// A particle in two groups that are both integrated moves twice in each step. LIGGGHTS only warns, on a screen that
/// nobody saw: without fluid its warning reaches the user, with the line or the place.
TEST(DemScripts, ParticlesThatMoveTwiceAreRefusedAndWarnedOf)
{
    const std::string again = "group some id 1\nfix again some nve/sphere";
    TestCase test;
    fillIn(test);
    test.dem.more = again;
    expectRefused(
        test, {script + " line ", "The fixes integrate and again move the same particles", "allowed: groups"});
    TestCase demOnly;
    fillIn(demOnly);
    demOnly.dem.more = again;
    withoutFluid(demOnly);
    expectRuns(demOnly, {"LIGGGHTS warns: One or more atoms are time integrated more than once"});
}

/// Units and styles of atoms that the coupling does not know are named, with the line.
TEST(DemScripts, UnitsAndStylesOfAtoms)
{
    TestCase cgs;
    fillIn(cgs);
    replaceInScript(cgs, "units si", "units cgs");
    expectRefused(cgs, {script + " line 6: 'units cgs'", "allowed with a fluid: units si"});
    TestCase hybrid;
    fillIn(hybrid);
    replaceInScript(hybrid, "atom_style granular", "atom_style hybrid granular molecular");
    expectRefused(hybrid, {script + " line 1: ", "atom_style is 'hybrid'", "allowedInScript ( \"hybrid\" )"});
}

/// A coefficient for which the contact model has no word has no effect, and a warning names it. With the model in
/// the line, or as a value of a variable, it is read. Zero has no effect either way, and cases state it on purpose.
TEST(DemScripts, CoefficientsThatNoModelReadsAreWarnedOf)
{
    const std::string rolling = "fix rolling all property/global coefficientRollingFriction peratomtypepair 2 0.1 0.1 "
                                "0.1 0.1";
    TestCase forgotten;
    fillIn(forgotten);
    forgotten.dem.more = rolling;
    expectRuns(forgotten, {script + " line ", "'" + rolling + "': no model of pair_style", "so they have no effect"});
    TestCase zero;
    fillIn(zero);
    zero.dem.more = rolling;
    for (std::size_t at = 0; (at = zero.dem.more.find("0.1", at)) != std::string::npos;)
    {
        zero.dem.more.replace(at, 3, "0");
    }
    const Outcome ofZero = zero.run();
    EXPECT_TRUE(ofZero.succeeded()) << ofZero.output;
    EXPECT_FALSE(ofZero.says("have no effect")) << ofZero.output;
    const Words readers = {"pair_style gran model hertz tangential history rolling_friction cdt\npair_coeff * *",
        "fix slope all wall/gran model hertz tangential history rolling_friction cdt primitive type 2 zplane 0.0005",
        "variable resistance equal f_rolling[1][2]"};
    for (const std::string& reader : readers)
    {
        SCOPED_TRACE(reader);
        TestCase test;
        fillIn(test);
        test.dem.more = rolling + '\n' + reader;
        const Outcome outcome = test.run();
        EXPECT_TRUE(outcome.succeeded()) << outcome.output;
        EXPECT_FALSE(outcome.says("have no effect")) << outcome.output;
    }
}

/// Words and texts of DEM/variables are the script's: the name of a model in a variable whose name speaks of cohesion or
/// friction, INF for a number of particles without limit, a text of several words. INF went to LIGGGHTS as a number, and
/// the names were refused as if they were coefficients.
TEST(DemScripts, WordsAndTextsAsVariables)
{
    TestCase test;
    fillIn(test);
    test.coupling()
        .set("DEM/variables/cohesionStyle", "off")
        .set("DEM/variables/frictionModel", "history")
        .set("DEM/variables/densityKind", "constant")
        .set("DEM/variables/most", "INF")
        .set("DEM/variables/rolling", "\"rolling_friction off\"");
    test.dem.more =
        "pair_style gran model hertz tangential ${frictionModel} cohesion ${cohesionStyle} ${rolling}\n"
        "pair_coeff * *\n"
        "region feed block 0.005 0.015 0.005 0.015 0.03 0.038 units box\n"
        "fix one all particletemplate/sphere 10007 atom_type 1 density ${densityKind} 2500. radius constant "
        "0.001\n"
        "fix kinds all particledistribution/discrete 10009 1 one 1.0\n"
        "fix feeding all insert/rate/region seed 86028121 distributiontemplate kinds nparticles ${most} "
        "particlerate 2000 insert_every 25 overlapcheck yes all_in yes vel constant 0. 0. -0.1 region feed";
    expectRuns(test);
    EXPECT_GT(test.conservationSummary()["particlesInserted"].get<int>(), 0);
}

/// The only particle leaves the box through a floor that the script has forgotten: the message says where it is, how
/// fast it was, and that the wall may be missing. LIGGGHTS' message is about atom types.
TEST(DemScripts, AMissingWallIsNamedAsACause)
{
    TestCase test;
    fillIn(test);
    test.dem.walls = false;
    test.dem.particles = {{0.0101, 0.0099, 0.0005}};
    test.dem.more = "velocity all set 0 0 -4 units box";
    expectRefused(test, {"No particle is left of the 1", "particle 1 is at (0.0101", "with a speed of ",
                            "allowed: a wall in the DEM script wherever the fluid has one"});
}
