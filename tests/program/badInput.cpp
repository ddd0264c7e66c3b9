/// \file
/// Cases with a mistake in them. The program must say where the mistake is and what is allowed, end with a status that
/// a script notices, and leave every file as it was: the case's own, and results of an earlier run.

#include "support/testCase.h"
#include "tokens/exactText.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <regex>

namespace
{

using clepsydra::exactText;
using namespace clepsydra::tests;

const std::string couplingProperties = "constant/couplingProperties";
const std::string transportProperties = "constant/transportProperties";
const std::string controlDict = "system/controlDict";
const std::string script = "DEM/in.particles";

using Change = std::function<void(TestCase&)>;
using Words = std::vector<std::string>;
using Files = std::map<std::string, std::string>;

/// The text of all files below a folder by their path in it.
Files filesIn(const std::filesystem::path& folder)
{
    Files files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    {
        if (entry.is_regular_file())
        {
            std::ifstream is(entry.path(), std::ios::binary);
            files[std::filesystem::relative(entry.path(), folder).string()] = {
                std::istreambuf_iterator<char>(is), std::istreambuf_iterator<char>()};
        }
    }
    return files;
}

/// A case that is right, where an earlier run has left its results: one particle above the middle of a box of water.
void fillIn(TestCase& test)
{
    test.cells = {4, 4, 8};
    test.dem.particles = {{0.0101, 0.0099, 0.02}};
    test.dem.timeStep = 4e-5;
    test.setTimes(0.004, 1e-3, 0.002);
    test.coupling().set("particleOutput/writeVtk", "on").set("DEM/writeRestart", "\"DEM/end.restart\"");
    test.control()
        .set("functions/massInHopper/type", "massInHopper")
        .set("functions/massInHopper/libs", "()")
        .set("functions/massInHopper/patch", "walls");
    test.extraFiles["VTK/particles.pvd"] =
        "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>"
        "<DataSet timestep=\"0\" file=\"particles_0.vtp\"/></Collection></VTKFile>\n";
    for (const char* result : {"postProcessing/massInHopper/0/massInHopper.dat",
             "postProcessing/conservation/0/summary.json", "VTK/particles_0.vtp", "DEM/end.restart", "log.liggghts"})
    {
        test.extraFiles[result] = "of an earlier run\n";
    }
}

std::string commandOn(int ranks)
{
    return ranks == 1 ? "$SOLVER" : "mpirun -np " + std::to_string(ranks) + " $SOLVER -parallel";
}

void decompose(TestCase& test, int ranks)
{
    test.divideAmong(ranks);
    test.write();
    ASSERT_TRUE(test.runCommand("decomposePar").succeeded());
}

/// The mistakes that the program can see before it starts LIGGGHTS, which begins a new log.liggghts.
enum class SeenBy
{
    dictionaries,
    engine
};

void expectRefused(const Outcome& outcome, const Words& words)
{
    EXPECT_NE(outcome.status, 0) << outcome.output;
    EXPECT_LT(outcome.status, 128) << "ended by a signal\n" << outcome.output;
    for (const std::string& word : words)
    {
        EXPECT_TRUE(outcome.says(word)) << "not said: " << word << "\n" << outcome.output;
    }
}

void expectSameFiles(const Files& before, const Files& after, SeenBy seenBy)
{
    for (const auto& [file, text] : before)
    {
        const auto now = after.find(file);
        EXPECT_TRUE(now != after.end() && (now->second == text || (seenBy == SeenBy::engine && file == "log.liggghts")))
            << file << " was changed";
    }
    for (const auto& [file, text] : after)
    {
        EXPECT_TRUE(before.count(file) || file == ".pimpleDemFoam.lock" || file == "checkpoints/beginning")
            << file << " was written";
    }
}

/// Makes the mistake, runs the case, expects a refusal with all of `words` that changes no file.
void expectRefused(const Change& makeMistake, const Words& words, SeenBy seenBy, int ranks = 1)
{
    TestCase test;
    fillIn(test);
    makeMistake(test);
    ASSERT_TRUE(test.makeMesh().succeeded());
    if (ranks > 1)
    {
        decompose(test, ranks);
    }
    const Files before = filesIn(test.path());
    const Outcome outcome = test.runCommand(commandOn(ranks));
    expectRefused(outcome, words);
    expectSameFiles(before, filesIn(test.path()), seenBy);
}

/// One wrong entry of couplingProperties, refused with the file's name, the entry's and what is allowed.
void expectEntryRefused(const std::string& entry, const std::string& value, const Words& allowed)
{
    SCOPED_TRACE(entry + ' ' + value);
    Words words = allowed;
    words.push_back(couplingProperties);
    words.push_back(entry.substr(entry.rfind('/') + 1));
    words.push_back("allowed:");
    expectRefused([&](TestCase& test) { test.coupling().set(entry, value); }, words, SeenBy::dictionaries);
}

/// A wrong line at the end of the DEM script, refused with the script's name, the line's number and LIGGGHTS' words.
void expectLineRefused(const std::string& line, const std::string& liggghtsSays, int ranks = 1)
{
    SCOPED_TRACE(line);
    const auto append = [&](TestCase& test) { test.dem.more = line; };
    TestCase ordinary;
    fillIn(ordinary);
    const std::string text = ordinary.dem.text(ordinary.box);
    // The script ends with `more` and a line feed.
    const auto lineNumber = std::count(text.begin(), text.end(), '\n');
    expectRefused(append, {script + " line " + std::to_string(lineNumber) + ": LIGGGHTS", line, liggghtsSays},
        SeenBy::engine, ranks);
}

/// The case of all tests below runs where there is no mistake in it: what they see refused is the mistake.
TEST(BadInput, TheSameCaseWithoutMistakeRuns)
{
    TestCase test;
    fillIn(test);
    const Outcome outcome = test.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
}

/// A box of water of which two sides are joined, as text of blockMeshDict.
/// \param patches  without the other sides
/// \param corners  of the upper side
std::string joinedBox(const std::string& patches, const std::string& corners = "(0 0 4) (2 0 4) (2 2 4) (0 2 4)")
{
    return FoamFile().text("blockMeshDict") + "scale 0.01; vertices ((0 0 0) (2 0 0) (2 2 0) (0 2 0) " + corners
           + ");\nblocks (hex (0 1 2 3 4 5 6 7) (4 4 8) simpleGrading (1 1 1));\nboundary (" + patches
           + "walls { type wall; faces ((0 3 2 1) (4 5 6 7) (0 1 5 4) (3 7 6 2)); } );\n";
}

Change withJoinedSides(const std::string& mesh)
{
    return [mesh](TestCase& test) {
        test.extraFiles["system/blockMeshDict"] = mesh;
        for (const char* field : {"0/U", "0/p"})
        {
            const std::string type = mesh.find("cyclicAMI") != std::string::npos ? "cyclicAMI" : "cyclic";
            test.file(field).set("boundaryField/\"west|east\"/type", type);
        }
    };
}

/// Sides that are joined otherwise than by a translation along an axis would give a particle's image another direction or
/// another shape.
TEST(BadInput, CyclicPatchesThatAreNoTranslation)
{
    const auto pair = [](const std::string& type, const std::string& more = "") {
        return "west { type " + type + "; neighbourPatch east; faces ((0 4 7 3)); " + more + " }\neast { type " + type
               + "; neighbourPatch west; faces ((1 2 6 5)); " + more + " }\n";
    };
    for (const int ranks : {1, 2})
    {
        expectRefused(withJoinedSides(joinedBox(pair("cyclicAMI", "transform translational; separationVector (0.02 0 "
                                                                  "0);"))),
            {"'west'", "polyMesh/boundary", "cyclicAMI", "allowed:", "pairs of cyclic patches"}, SeenBy::dictionaries,
            ranks);
        // A parallelepiped: the sides are planes and translations of each other, but at right angles to no axis.
        expectRefused(withJoinedSides(joinedBox(pair("cyclic"), "(1 0 4) (3 0 4) (3 2 4) (1 2 4)")),
            {"'west'", "polyMesh/boundary", "plane perpendicular to an axis", "allowed:"}, SeenBy::dictionaries, ranks);
    }
    // A quarter of a ring around the z axis.
    const std::string ring =
        FoamFile().text("blockMeshDict")
        + "scale 0.01; vertices ((1 0 0) (3 0 0) (0 3 0) (0 1 0) (1 0 4) (3 0 4) (0 3 4) (0 1 4));\n"
          "blocks (hex (0 1 2 3 4 5 6 7) (4 4 8) simpleGrading (1 1 1));\n"
          "boundary ( west { type cyclic; neighbourPatch east; transform rotational; rotationAxis (0 0 1); "
          "rotationCentre (0 0 0); faces ((0 1 5 4)); } east { type cyclic; neighbourPatch west; transform rotational; "
          "rotationAxis (0 0 1); rotationCentre (0 0 0); faces ((3 7 6 2)); }\n"
          "walls { type wall; faces ((0 3 2 1) (4 5 6 7) (0 4 7 3) (1 2 6 5)); } );\n";
    expectRefused(
        withJoinedSides(ring), {"'west'", "polyMesh/boundary", "rotational", "allowed:"}, SeenBy::dictionaries);
}

/// The particles' space must be periodic where the mesh is, and only there, over the same length: otherwise particles
/// cross walls of the fluid, or leave it where it goes on.
TEST(BadInput, BoxesThatDoNotAgree)
{
    const std::string joined = joinedBox("west { type cyclic; neighbourPatch east; faces ((0 4 7 3)); }\n"
                                         "east { type cyclic; neighbourPatch west; faces ((1 2 6 5)); }\n");
    const auto with = [&](const std::string& periodic, const std::string& region) {
        return [=](TestCase& test) {
            withJoinedSides(joined)(test);
            std::string text = test.dem.text(test.box);
            text = std::regex_replace(text, std::regex("boundary f f f"), "boundary " + periodic);
            text = std::regex_replace(text, std::regex("block \\S+ \\S+"), "block " + region);
            test.extraFiles[script] = std::regex_replace(text, std::regex("fix wallx.*\n"), "");
        };
    };
    const std::string agree = "do not agree";
    for (const int ranks : {1, 2})
    {
        expectRefused(with("f f f", "0 0.02"),
            {agree, script,
                "line 3: 'boundary f f f': the fluid's mesh has the cyclic patches 'west' and 'east' along x",
                "allowed: p in the command boundary, and a box from 0 to 0.02 m"},
            SeenBy::engine, ranks);
        expectRefused(with("p f f", "0 0.0201"),
            {agree, script, "'create_box", "the periodic DEM box is from 0 to 0.0201 m along x",
                "the cyclic patches 'west' and 'east' are at the ends of the mesh from 0 to 0.02 m",
                "allowed: the same in both"},
            SeenBy::engine, ranks);
        expectRefused(with("p f f", "0.001 0.021"), {agree, "from 0.001 to 0.021 m", "allowed: the same in both"},
            SeenBy::engine, ranks);
    }
    expectRefused(with("p p f", "0 0.02"), {agree, script, "the DEM box is periodic along y", "has no cyclic patches"},
        SeenBy::engine);
    TestCase right;
    fillIn(right);
    with("p f f", "0 0.02")(right);
    const Outcome outcome = right.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
}

/// Nothing would carry a suspension along a periodic direction: the entry must say what does. Along other directions p
/// itself has the gradient.
TEST(BadInput, MeanPressureGradient)
{
    const auto alongZ = [](const std::string& gradient) {
        return [gradient](TestCase& test) {
            test.box.periodic = {false, false, true};
            if (!gradient.empty())
            {
                test.coupling().set("meanPressureGradient", gradient);
            }
        };
    };
    expectRefused(alongZ(""),
        {couplingProperties, "'meanPressureGradient' is missing", "gravity", "allowed: balanceWeight"},
        SeenBy::dictionaries);
    expectRefused(
        alongZ("balanceWieght"), {couplingProperties, "'meanPressureGradient'", "did you mean"}, SeenBy::dictionaries);
    expectRefused(alongZ("(1 0 0)"),
        {couplingProperties, "'meanPressureGradient' is (1 0 0)", "no cyclic patches along x"}, SeenBy::dictionaries);
    expectEntryRefused("meanPressureGradient", "balanceWeight", {"no direction in which the mesh has cyclic patches"});
    for (const std::string gradient : {"balanceWeight", "none", "(0 0 -20)"})
    {
        SCOPED_TRACE(gradient);
        TestCase right;
        fillIn(right);
        alongZ(gradient)(right);
        const Outcome outcome = right.run();
        EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    }
}

/// In a slice of an axisymmetric flow a whole sphere would have its volume and its drag: in a wedge of five degrees, 72 times
/// too much.
TEST(BadInput, Wedges)
{
    const Change makeWedge = [](TestCase& test) {
        test.extraFiles["system/blockMeshDict"] =
            FoamFile().text("blockMeshDict")
            + "scale 1; vertices ((0 0 0) (0.0389629 -0.0017012 0) (0.0389629 0.0017012 0) (0 0 0.06)\n"
              "(0.0389629 -0.0017012 0.06) (0.0389629 0.0017012 0.06));\n"
              "blocks (hex (0 1 2 0 3 4 5 3) (12 1 15) simpleGrading (1 1 1));\n"
              "boundary ( front { type wedge; faces ((0 1 4 3)); } back { type wedge; faces ((0 3 5 2)); }\n"
              "walls { type wall; faces ((1 2 5 4) (0 0 2 1) (3 4 5 3)); } axis { type empty; faces ((0 3 3 0)); } "
              ");\n";
        for (const char* field : {"0/U", "0/p"})
        {
            test.file(field).set("boundaryField/\"front|back\"/type", "wedge").set("boundaryField/axis/type", "empty");
        }
    };
    expectRefused(makeWedge, {"'front'", "polyMesh/boundary", "wedge", "allowed:"}, SeenBy::dictionaries);
}

/// Cells that are made or removed during a run would not hold the particles of the old ones.
TEST(BadInput, MovingMesh)
{
    const auto meshOf = [](const std::string& type) {
        return [type](TestCase& test) {
            test.extraFiles["constant/dynamicMeshDict"] = FoamFile().set("dynamicFvMesh", type).text("dynamicMeshDict");
        };
    };
    for (const int ranks : {1, 2})
    {
        expectRefused(meshOf("dynamicRefineFvMesh"),
            {"constant/dynamicMeshDict", "'dynamicFvMesh'", "dynamicRefineFvMesh",
                "allowed: dynamicMotionSolverFvMesh"},
            SeenBy::dictionaries, ranks);
    }
    TestCase still;
    fillIn(still);
    meshOf("staticFvMesh")(still);
    const Outcome outcome = still.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
}

/// A pressure in Pa is 1000 times the kinematic one. OpenFOAM itself stops at the first equation, with a stack trace and
/// without a file.
TEST(BadInput, DimensionsOfFields)
{
    const auto withDimensions = [](const std::string& file, const std::string& dimensions) {
        return [=](TestCase& test) { test.file(file).set("dimensions", dimensions); };
    };
    expectRefused(withDimensions("0/p", "[1 -1 -2 0 0 0 0]"),
        {"The file 0/p has the dimensions [1 -1 -2 0 0 0 0]", "allowed: dimensions [0 2 -2 0 0 0 0]", "Pa"},
        SeenBy::engine);
    expectRefused(withDimensions("0/U", "[0 0 0 0 0 0 0]"),
        {"The file 0/U has the dimensions [0 0 0 0 0 0 0]", "allowed: dimensions [0 1 -1 0 0 0 0]"}, SeenBy::engine);
}

/// Options that the momentum equation cannot have, or that would be wrong in it, are refused by their names. OpenFOAM warns of
/// the first after two steps and takes the others.
TEST(BadInput, FluidSources)
{
    const auto with = [](const std::string& options) {
        return [options](
                   TestCase& test) { test.extraFiles["constant/fvOptions"] = FoamFile().text("fvOptions") + options; };
    };
    const std::string specific = " selectionMode all; volumeMode specific; injectionRateSuSp { ";
    expectRefused(with("heat { type scalarSemiImplicitSource;" + specific + "T (1 0); } }"),
        {"constant/fvOptions", "'heat'", "scalarSemiImplicitSource", "allowed: options that act on U"}, SeenBy::engine);
    expectRefused(with("lift { type buoyancyForce; fields (U); }"), {"constant/fvOptions", "'lift'", "buoyancyForce"},
        SeenBy::engine);
    expectRefused(with("push { type vectorSource; }"), {"vectorSource", "vectorSemiImplicitSource"}, SeenBy::engine);
    const std::string push = "push { type vectorSemiImplicitSource;" + specific + "U ((0 0 1) 0); } }";
    expectRefused(
        [&](TestCase& test) {
            with(push)(test);
            test.extraFiles["system/fvOptions"] = test.extraFiles["constant/fvOptions"];
        },
        {"constant/fvOptions", "system/fvOptions", "allowed: one of them"}, SeenBy::engine);
    TestCase inactive;
    fillIn(inactive);
    with("heat { type scalarSemiImplicitSource; active no;" + specific + "T (1 0); } }")(inactive);
    const Outcome outcome = inactive.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
}

/// Temperatures: entries that are missing, wrong or without effect, and what is stated twice or nowhere. Each would be a run
/// with other temperatures than the user has in mind.
TEST(BadInput, Temperatures)
{
    const auto expectWithEnergyRefused = [](const Change& makeMistake, const Words& words, SeenBy seenBy) {
        const Change change = [&](TestCase& test) {
            test.transport().set("Cp", 4200).set("kappa", 0.6);
            test.coupling()
                .set("energy/heatTransferModel", "Gunn")
                .set("energy/particleCp", 840)
                .set("energy/particleTemperature", 350);
            test.file("0/T") = FoamFile("volScalarField");
            test.file("0/T")
                .set("dimensions", "[0 0 0 1 0 0 0]")
                .set("internalField", "uniform 300")
                .set("boundaryField/walls/type", "zeroGradient");
            test.file("system/fvSchemes").set("divSchemes/div(phi,T)", "Gauss upwind");
            test.solution().set("solvers/T", "{ solver PBiCGStab; preconditioner DILU; tolerance 1e-14; relTol 0; }");
            makeMistake(test);
        };
        expectRefused(change, words, seenBy);
    };
    const auto expectInCoupling = [&](const std::string& entry, const std::string& value, const Words& words) {
        SCOPED_TRACE(entry + ' ' + value);
        expectWithEnergyRefused(
            [&](TestCase& test) { test.coupling().set(entry, value); }, words, SeenBy::dictionaries);
    };
    expectInCoupling("energy/heatTransferModel", "Wakao", {couplingProperties, "'Wakao'", "RanzMarshall"});
    expectInCoupling("energy/particleCP", "840", {couplingProperties, "did you mean 'particleCp'?"});
    expectInCoupling("energy/particleCp", "0", {couplingProperties, "'particleCp' is 0", "a number > 0"});
    expectInCoupling("useDDTvoidfraction", "off", {couplingProperties, "'useDDTvoidfraction' is off", "'energy'"});

    const auto expectInTransport = [&](const std::string& entry, const std::string& value, const Words& words) {
        SCOPED_TRACE(entry + ' ' + value);
        expectWithEnergyRefused(
            [&](TestCase& test) { test.transport().set(entry, value); }, words, SeenBy::dictionaries);
    };
    expectInTransport("kappa", "-1", {transportProperties, "'kappa' is -1", "a number > 0"});
    expectInTransport("beta", "2e-4", {transportProperties, "'beta'", "'TRef'", "allowed: both"});
    expectInTransport(
        "Prt", "0.85", {transportProperties, "'Prt' has no effect in laminar flow", "turbulenceProperties"});
    expectWithEnergyRefused(
        [](TestCase& test) {
            test.transport().set("beta", "2e-4").set("TRef", "300");
            test.coupling().set("modelType", "B").set("forceModels", "(DiFeliceDrag Archimedes)");
        },
        {transportProperties, "'beta'", "'modelType'", "allowed: modelType A"}, SeenBy::dictionaries);
    expectWithEnergyRefused(
        [](TestCase& test) { test.transport().remove("Cp"); }, {transportProperties, "Cp"}, SeenBy::dictionaries);

    // Without energy
    expectRefused([](TestCase& test) { test.transport().set("Cp", "4200"); },
        {transportProperties, "'Cp' has no effect without", "'energy'"}, SeenBy::dictionaries);
    expectRefused([](TestCase& test) { test.coupling().set("conservationCheck/heatTolerance", "1e-6"); },
        {couplingProperties, "'heatTolerance' has no effect without", "'energy'"}, SeenBy::engine);

    // Beside the DEM script
    expectWithEnergyRefused([](TestCase& test) { test.coupling().remove("energy/particleCp"); },
        {couplingProperties, "'particleCp' is given neither", "thermalCapacity"}, SeenBy::engine);
    expectWithEnergyRefused(
        [](TestCase& test) { test.dem.more = "fix Temp all property/atom Temp scalar yes yes no 300"; },
        {couplingProperties, "'particleTemperature' is given", "Temp scalar", "allowed: exactly one of the two"},
        SeenBy::engine);
    expectWithEnergyRefused(
        [](TestCase& test) {
            test.coupling().remove("energy/particleTemperature");
            test.dem.more = "fix Temp all property/atom Temp scalar no yes no 300";
        },
        {"not in restart files", "allowed: 'property/atom Temp scalar yes yes no"}, SeenBy::engine);

    // The field
    expectWithEnergyRefused([](TestCase& test) { test.file("0/T").set("dimensions", "[0 0 0 0 0 0 0]"); },
        {"0/T", "dimensions [0 0 0 1 0 0 0] of a temperature"}, SeenBy::engine);
    expectWithEnergyRefused([](TestCase& test) { test.removeFile("0/T"); }, {"0/T"}, SeenBy::engine);
}

/// OpenFOAM's transport equation with the flux between the particles would change a uniform concentration, to 0.64 to 1.46
/// in a fluidised bed; a scheme that subtracts the divergence of the flux does not.
TEST(BadInput, ScalarTransportWithoutBoundedScheme)
{
    const Change tracer = [](TestCase& test) {
        test.control()
            .set("functions/tracer/type", "scalarTransport")
            .set("functions/tracer/libs", "(\"libsolverFunctionObjects.so\")");
    };
    expectRefused(
        tracer, {controlDict, "'tracer'", "scalarTransport", "'div(phi,s)'", "bounded"}, SeenBy::dictionaries);
}

/// Unknown names of models are refused with a list of the known ones. A program that took the usual model instead, or
/// left the force out, would run to its end with status 0.
TEST(BadInput, UnknownModels)
{
    expectEntryRefused("forceModels", "(DiFelice gradPForce)",
        {"'DiFelice'", "DiFeliceDrag", "SchillerNaumannDrag", "GidaspowDrag", "KochHillDrag", "BeetstraDrag",
            "RongDrag", "StokesDrag", "TangDrag", "gradPForce", "viscForce", "Archimedes"});
    expectEntryRefused("forceModels", "(DiFeliceDrag gradForce)", {"'gradForce' (did you mean 'gradPForce'?)"});
    expectEntryRefused("forceModels", "(DiFeliceDrag Archimedes Archimedes)", {"'Archimedes' twice"});
    expectEntryRefused("voidFractionModel", "big", {"'big'", "divided", "centre"});
    expectEntryRefused("smoothingModel", "diffusion", {"'diffusion'", "constDiffSmoothing", "off"});
    expectEntryRefused("fluid", "water", {"'water'", "incompressible", "none"});
    expectEntryRefused("modelType", "C", {"'C'", "(A"});
    expectEntryRefused("momCoupleModels", "(implicit)", {"'implicit'", "implicitCouple", "explicitCouple"});
    expectEntryRefused("constDiffSmoothingProps/nSteps", "4", {"'nSteps'", "bandwidth"});
    expectEntryRefused("DEM/engine", "lammps", {"'lammps'", "liggghts"});
}

/// A set of forces that belongs to no equation is refused. Without the check each of these runs to its end: a bed without
/// gradPForce does not lift, a particle without Archimedes falls half as fast again, two drag laws are added.
TEST(BadInput, SetsOfForcesThatBelongToNoEquation)
{
    expectEntryRefused("forceModels", "(DiFeliceDrag viscForce Archimedes)",
        {"no model of the pressure gradient", "model A", "(gradPForce noPressureGradient)"});
    expectEntryRefused("forceModels", "(DiFeliceDrag gradPForce viscForce)",
        {"no model of the buoyancy", "model A", "(Archimedes noBuoyancy)"});
    expectEntryRefused("forceModels", "(DiFeliceDrag GidaspowDrag gradPForce viscForce Archimedes)",
        {"'DiFeliceDrag' and 'GidaspowDrag'", "would add up", "one of (BeetstraDrag"});
    expectEntryRefused("forceModels", "(gradPForce Archimedes)",
        {"no model of the drag", "SchillerNaumannDrag", "noDrag", "(viscForce noViscousStress)"});
    expectRefused([](TestCase& test) { test.coupling().set("modelType", "B").set("forceModels", "(DiFeliceDrag)"); },
        {couplingProperties, "forceModels", "model B", "(Archimedes noBuoyancy)"}, SeenBy::dictionaries);
}

/// Parcels whose number of particles makes no sense, and forces that have no scaling to parcels. Read and not checked, the
/// first would divide by zero or make particles larger than their parcel; the second would act with the parcel's size.
TEST(BadInput, Parcels)
{
    for (const char* ratio : {"0.5", "0", "-2", "5000"})
    {
        expectEntryRefused("coarseGraining", ratio, {ratio, "a number from 1 to 1000"});
    }
    expectRefused(
        [](TestCase& test) {
            test.coupling()
                .set("coarseGraining", "2")
                .set("forceModels", "(DiFeliceDrag gradPForce viscForce Archimedes lubricationForce)")
                .set("lubricationForceProps/roughness", "1e-6");
        },
        {couplingProperties, "'coarseGraining' is 2", "'lubricationForce'", "allowed: without it, or coarseGraining 1"},
        SeenBy::dictionaries);
    expectRefused(
        [](TestCase& test) {
            test.coupling().set("coarseGraining", "2").set("selfInducedVelocityCorrection", "Oseen");
        },
        {couplingProperties, "'selfInducedVelocityCorrection' is Oseen", "'coarseGraining' is 2", "allowed:"},
        SeenBy::engine);
}

/// A keyword that is unknown is refused, with the known one that it may stand for: the user waits for its effect in
/// vain. A program that looks up what it knows and no more would run to its end.
TEST(BadInput, EntriesThatNobodyReads)
{
    expectRefused(
        [](TestCase& test) {
            test.coupling().set("selfInducedVelocityCorection", "Oseen").set("dividdProps/alphaMin", "0.2");
        },
        {couplingProperties,
            "'selfInducedVelocityCorection' is unknown (did you mean 'selfInducedVelocityCorrection'?)",
            "'dividdProps' is unknown (did you mean 'dividedProps'?)", "allowed:"},
        SeenBy::dictionaries);
    expectEntryRefused("DiFeliceDragProps/facotr", "2", {"did you mean 'factor'?"});
    expectEntryRefused("dividedProps/minimumAlpha", "0.2", {"'minimumAlpha' is unknown", "alphaMin"});
    expectEntryRefused("DEM/maxRaleighFraction", "0.2", {"did you mean 'maxRayleighFraction'?"});
    expectRefused(
        [](TestCase& test) {
            test.coupling().set("DEM/groupChanges/atRest", "{ from all; to all; below 1; slowerThen 2; }");
        },
        {couplingProperties, "'slowerThen'", "did you mean 'slowerThan'?"}, SeenBy::dictionaries);
    expectRefused(
        [](TestCase& test) {
            test.coupling().set("DEM/groupChanges/atRest", "{ from all; to all; below 1; during 0.1; }");
        },
        {couplingProperties, "'slowerThan'"}, SeenBy::dictionaries);
    expectEntryRefused("maxCo", "0.5", {"without 'adjustableCouplingTimeStep'"});
    expectRefused([](TestCase& test) { test.coupling().set("conservationCheck/momentumTollerance", "1e-6"); },
        {couplingProperties, "did you mean 'momentumTolerance'?"}, SeenBy::engine);
    expectRefused([](TestCase& test) { test.control().set("functions/massInHopper/stopWhenFlowEnds", "0.3"); },
        {controlDict, "'stopWhenFlowEnds'", "did you mean 'stopWhenFlowStops'?"}, SeenBy::engine);
}

/// Entries and function objects under the name that they had in an earlier version, or that they have in CFDEMcoupling
/// with another meaning, are errors that name the new one. A program that knew the new names alone would suggest whatever
/// known word is spelt most alike, and none for names that have nothing in common.
TEST(BadInput, OldNamesAreRefusedWithTheNewOnes)
{
    const std::map<std::string, std::string> entries = {{"couplingInterval", "couplingTimeStep"},
        {"adjustableInterval", "adjustableCouplingTimeStep"}, {"minInterval", "minCouplingTimeStep"},
        {"maxInterval", "maxCouplingTimeStep"}, {"selfDisturbance", "selfInducedVelocityCorrection"},
        {"beadOutlets", "particleOutlets"}};
    for (const auto& [oldName, newName] : entries)
    {
        expectEntryRefused(oldName, "100", {"'" + oldName + "' is unknown (it is now called '" + newName + "'"});
    }
    expectEntryRefused("couplingInterval", "100", {"counts DEM steps", "[s]"});
    expectEntryRefused("beadOutput", "{ writeVtk on; }", {"now called 'particleOutput'"});
    expectEntryRefused("ledger", "{ momentumTolerance 1e-6; }", {"now called 'conservationCheck'"});
    expectEntryRefused("constDiffSmoothingProps/smoothingLength", "3e-3", {"now called 'bandwidth'", "half of"});
    for (const auto& [oldName, newName] :
        std::map<std::string, std::string>{{"beadHeight", "particleHeight"}, {"beadFlux", "particleFlux"}})
    {
        expectRefused([type = oldName](TestCase& test) { test.control().set("functions/massInHopper/type", type); },
            {controlDict, "'" + oldName + "'", "now called '" + newName + "'"}, SeenBy::dictionaries);
    }
}

/// What helps to write couplingProperties is no mistake: a word that it uses as $word, what an included file holds, and
/// coefficients of models that are not chosen. A check that knew the program's own keywords alone would refuse it, one that
/// looked at the tail of a file's name alone would take two of these for the file itself.
TEST(BadInput, EntriesThatOthersReadAreNoMistake)
{
    TestCase test;
    fillIn(test);
    test.extraFiles["constant/lengths"] = "particle 2e-3; coarse { cell 5e-3; }\n";
    test.extraFiles["constant/common.couplingProperties"] = "fine { cell 1e-3; }\n";
    test.extraFiles["shared/couplingProperties"] = "liquid water;\n";
    test.coupling()
        .remove("forceModels")
        .remove("constDiffSmoothingProps/bandwidth")
        .set("#include \"lengths\"\n#include \"common.couplingProperties\"\nlift",
            "SaffmanLiftForce;\n#include \"../shared/couplingProperties\"\nuseDDTvoidfraction on")
        .set("forceModels", "(DiFeliceDrag gradPForce viscForce Archimedes $lift)")
        .set("constDiffSmoothingProps/length", "6e-3")
        .set("constDiffSmoothingProps/bandwidth", "$length")
        .set("\".*DragProps\"/factor", "1")
        .set("GaussianProps/bandwidth", "$particle");
    const Outcome outcome = test.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
}

/// A file that includes itself is refused, by whatever name it does so, also a DEM script that does so through another one. The
/// stack ran over.
TEST(BadInput, FilesThatIncludeThemselves)
{
    for (const std::string name :
        {"couplingProperties", "../constant/couplingProperties", "$FOAM_CASE/constant/couplingProperties"})
    {
        SCOPED_TRACE(name);
        expectRefused(
            [&](TestCase& test) {
                test.coupling().set("fluid", "incompressible;\n#include \"" + name + "\"\nuseDDTvoidfraction on");
            },
            {couplingProperties, "The file includes itself"}, SeenBy::dictionaries);
    }
    expectRefused(
        [](TestCase& test) {
            test.dem.more = "include DEM/in.more";
            test.extraFiles["DEM/in.more"] = "\ninclude DEM/../" + script + '\n';
        },
        {"DEM/in.more line 2: include 'DEM/../" + script + "'", "allowed:"}, SeenBy::engine);
}

/// Settings that leave no whole checkpoint for a while, or on a full disk one that only seems to be whole. With
/// `writeCompression on` a run went on with status 0 whatever became of its files.
TEST(BadInput, CheckpointsThatMayNotBeWhole)
{
    expectRefused([](TestCase& test) { test.control().set("purgeWrite", "1"); },
        {controlDict, "'purgeWrite' is 1", "allowed:"}, SeenBy::dictionaries);
    expectRefused([](TestCase& test) { test.control().set("writeCompression", "on"); },
        {controlDict, "'writeCompression' is on", "allowed: off"}, SeenBy::dictionaries);
}

/// A dictionary in the place of a value, no value, two values, and numbers beyond all sense. The program ended by
/// SIGABRT and SIGSEGV at the first ones, without a word about the entry, and took the first of two values.
TEST(BadInput, ValuesOfTheWrongKind)
{
    expectEntryRefused("momCoupleModels", "{ a 1; }", {"is a dictionary", "allowed: a value"});
    expectEntryRefused("DEM/variables", "5", {"is a value", "allowed: a dictionary"});
    expectEntryRefused("DEM/variables/friction", "", {"has 0 values", "one number, word or"});
    expectEntryRefused("DEM/variables/friction", "0.1 0.2", {"has 2 values", "one number, word or"});
    expectEntryRefused("DEM/variables/friction", "1e200", {"1e+200", "1e60"});
    expectEntryRefused("constDiffSmoothingProps/bandwidth", "1e200", {"1e+200", "a number > 0, at most 1e60"});
}

/// The correction for a particle's own disturbance is for particles that are smeared over more than their size: elsewhere its
/// formula gives numbers that mean nothing, and a program that used them would run to its end.
TEST(BadInput, SelfInducedVelocityCorrectionWithoutSmoothing)
{
    const auto oseenAnd = [](const std::string& entry, const std::string& value) {
        return [=](TestCase& test) { test.coupling().set("selfInducedVelocityCorrection", "Oseen").set(entry, value); };
    };
    expectRefused(oseenAnd("smoothingModel", "off"),
        {couplingProperties, "'selfInducedVelocityCorrection'", "smoothingModel", "allowed:"}, SeenBy::engine);
    expectRefused(oseenAnd("momCoupleModels", "(explicitCouple)"),
        {couplingProperties, "'selfInducedVelocityCorrection'", "allowed:", "implicitCouple"}, SeenBy::engine);
    expectRefused(oseenAnd("constDiffSmoothingProps/bandwidth", "1e-3"),
        {couplingProperties, "'selfInducedVelocityCorrection'", "bandwidth", "allowed:"}, SeenBy::engine);
}

/// A missing file, dictionary or entry is named. A program with silent defaults would run to its end.
TEST(BadInput, MissingEntries)
{
    for (const std::string entry : {"couplingTimeStep", "fluid", "modelType", "forceModels", "voidFractionModel",
             "smoothingModel", "constDiffSmoothingProps/bandwidth", "momCoupleModels", "DEM", "DEM/script"})
    {
        SCOPED_TRACE(entry);
        expectRefused([&](TestCase& test) { test.coupling().remove(entry); },
            {couplingProperties, entry.substr(entry.find('/') + 1)}, SeenBy::dictionaries);
    }
    for (const std::string entry : {"rho", "nu"})
    {
        SCOPED_TRACE(entry);
        expectRefused([&](TestCase& test) { test.transport().remove(entry); }, {transportProperties, entry},
            SeenBy::dictionaries);
    }
    for (const std::string& file : {couplingProperties, transportProperties, std::string("constant/g")})
    {
        SCOPED_TRACE(file);
        expectRefused([&](TestCase& test) { test.removeFile(file); }, {file}, SeenBy::dictionaries);
    }
    expectEntryRefused("DEM/script", "\"DEM/in.none\"", {"'script'", "DEM/in.none", "a file"});
}

/// Quantities that cannot be negative are refused with their file and what is allowed. Negative friction is the
/// treacherous one: LIGGGHTS takes it and pushes particles on instead of holding them.
TEST(BadInput, NegativeQuantities)
{
    for (const char* entry : {"DEM/variables/particleDensity", "DEM/variables/particleDiameter",
             "constDiffSmoothingProps/bandwidth", "couplingTimeStep", "dividedProps/alphaMin"})
    {
        expectEntryRefused(entry, "-0.1", {"-0.1", "a number > 0"});
    }
    for (const char* entry :
        {"DEM/variables/friction", "DEM/variables/frictionWall", "useDDTvoidfractionProps/smoothingTime"})
    {
        expectEntryRefused(entry, "-0.1", {"-0.1", "a number >= 0"});
    }
    for (const std::string entry : {"rho", "nu"})
    {
        for (const std::string value : {"-1000", "0"})
        {
            SCOPED_TRACE(entry + ' ' + value);
            expectRefused([&](TestCase& test) { test.transport().set(entry, value); },
                {transportProperties, "'" + entry + "' is " + value, "a number > 0"}, SeenBy::dictionaries);
        }
    }
    expectRefused([](TestCase& test) { test.transport().set("stratification", "{ height 0.02; width 0; step 0.7; }"); },
        {transportProperties, "'width' is 0", "a number > 0"}, SeenBy::dictionaries);
    expectRefused(
        [](TestCase& test) { test.transport().set("stratification", "{ height 0.02; width 1e-3; step 70; }"); },
        {transportProperties, "'step' is 70", "allowed:", "-20 to 20"}, SeenBy::dictionaries);
    expectRefused([](TestCase& test) { test.transport().set("stratificaton/step", "0.7"); },
        {transportProperties, "'stratificaton'", "did you mean 'stratification'?"}, SeenBy::dictionaries);
    expectRefused([](TestCase& test) { test.dem.friction = -0.1; },
        {script, "coefficientFriction", "-0.1", "a number >= 0"}, SeenBy::engine);
    expectLineRefused("set group all density -1", "Invalid density");
    expectLineRefused("set group all diameter -0.002 density 2500", "Invalid diameter");
    expectLineRefused("set group all mass -1e-5", "Invalid mass");
    expectLineRefused(
        "fix b all particletemplate/sphere 10007 atom_type 1 density constant -2540 radius constant 0.001", "density");
}

/// Steps that do not fit each other, or at which contacts explode: refused before the first step, with the number that
/// would be right. A program that rounded the number of DEM steps would drift from the fluid's time; one without the
/// check of the Rayleigh time would lose particles later on.
TEST(BadInput, Steps)
{
    expectEntryRefused("couplingTimeStep", "2e-3", {"0.002 s", "deltaT", controlDict, "0.001 s"});
    expectRefused([](TestCase& test) { test.dem.timeStep = 3e-5; },
        {couplingProperties, "'couplingTimeStep' is 0.001 s", "allowed: a whole multiple", "3e-05 s", script},
        SeenBy::engine);
    expectRefused([](TestCase& test) { test.dem.timeStep = 2.5e-4; },
        {couplingProperties, "DEM step is above the stable one", script, "0.00025 s", "Rayleigh", "allowed: at most",
            "'maxRayleighFraction'"},
        SeenBy::engine);
    expectRefused([](TestCase& test) { test.control().set("adjustTimeStep", "yes"); },
        {controlDict, "'adjustTimeStep'", "allowed: off"}, SeenBy::dictionaries);
}

/// Limits of an adjustable coupling step that leave none, and times that no whole number of DEM steps can hit.
TEST(BadInput, AdjustableCouplingTimeStep)
{
    const auto refused = [](const std::string& file, const std::string& entry, const std::string& value,
                             const Words& allowed, SeenBy seenBy) {
        SCOPED_TRACE(entry + ' ' + value);
        Words words = allowed;
        words.insert(words.end(), {file, "'" + entry + "' is", "allowed:"});
        expectRefused(
            [&](TestCase& test) {
                test.coupling()
                    .set("adjustableCouplingTimeStep", "yes")
                    .set("maxCo", "0.5")
                    .set("minCouplingTimeStep", "4e-4")
                    .set("maxCouplingTimeStep", "2e-3");
                test.file(file).set(entry, value);
            },
            words, seenBy);
    };
    refused(couplingProperties, "maxCo", "0", {"a number > 0"}, SeenBy::dictionaries);
    refused(couplingProperties, "minCouplingTimeStep", "3e-3", {"at most maxCouplingTimeStep", "0.002 s"},
        SeenBy::dictionaries);
    refused(couplingProperties, "maxCouplingTimeStep", "-1", {"a number > 0"}, SeenBy::dictionaries);
    expectRefused(
        [](TestCase& test) {
            test.coupling()
                .set("adjustableCouplingTimeStep", "yes")
                .set("maxCo", "0.5")
                .set("minCouplingTimeStep", "2e-3")
                .set("maxCouplingTimeStep", "2e-3");
        },
        {couplingProperties, "'couplingTimeStep' is 0.001 s",
            "allowed: from minCouplingTimeStep to maxCouplingTimeStep"},
        SeenBy::dictionaries);
    refused(couplingProperties, "minCouplingTimeStep", "3e-5", {"at least the DEM step", "4e-05 s"}, SeenBy::engine);
    refused(controlDict, "writeInterval", "0.00202", {"a whole multiple of the DEM step", "4e-05 s"}, SeenBy::engine);
    refused(controlDict, "endTime", "0.00402", {"a whole multiple of the DEM step", "4e-05 s"}, SeenBy::engine);
}

/// What the script says is at odds with the fluid's case. A particle outside the mesh would feel no water; with different
/// gravity in the two engines particles would float or sink that should not; without the patch massInHopper counts nothing.
TEST(BadInput, ParticlesAndFluidAtOdds)
{
    expectRefused([](TestCase& test) { test.dem.particles.emplace_back(0.01, 0.01, 0.0412); },
        {"Particle 2 at (0.01 0.01 0.0412) m lies in no cell of the mesh", "spans"}, SeenBy::engine);
    expectRefused([](TestCase& test) { test.dem.gravity = 1.62; },
        {"constant/g is (0 0 -9.81)", "fix gravity of the DEM script gives (0 0 -1.62)", "allowed: the same"},
        SeenBy::engine);
    expectRefused([](TestCase& test) { test.control().set("functions/massInHopper/patch", "hopper"); },
        {controlDict, "'patch' is 'hopper'", "not a patch of the mesh; allowed: ", "(walls)"}, SeenBy::engine);
}

/// LIGGGHTS' own errors, which it would print to its log and end the process with, reach the user with script and line.
TEST(BadInput, DemScript)
{
    expectLineRefused("fix oops all gravvity 9.81", "Invalid fix style: \"gravvity\"");
    expectLineRefused("pear_style gran model hertz", "Unknown command");
    expectLineRefused("timestep ${demStep}", "demStep");
    expectLineRefused("fix m all mesh/surface file DEM/none.stl type 1", "DEM/none.stl");
    expectRefused([](TestCase& test) { test.dem.more = "read_restart DEM/none.restart"; },
        {script + " line ", "Cannot open DEM/none.restart"}, SeenBy::engine);
    expectRefused([](TestCase& test) { test.dem.more = "include DEM/in.${none}"; },
        {script + " line ", "DEM/in.${none}", "allowed", "DEM/variables"}, SeenBy::engine);
    // What LIGGGHTS sees only when all lines are read.
    expectRefused([](TestCase& test) { test.dem.youngsModulus = -5e6; }, {"LIGGGHTS stopped", "youngsModulus", script},
        SeenBy::engine);
    expectRefused([](TestCase& test) { test.dem.restitution = 1.5; },
        {"LIGGGHTS stopped", "coefficientRestitution <= 1", script}, SeenBy::engine);
    expectRefused([](TestCase& test) { test.dem.more = "unfix friction"; },
        {"LIGGGHTS stopped", "coefficientFriction", script}, SeenBy::engine);
}

/// Particles that LIGGGHTS leaves out without a word, divides by zero for (SIGFPE, no particle named), or lets explode out of
/// the box ("the DEM box is too small"): each is named with its place.
TEST(BadInput, PlacesOfParticles)
{
    const auto withParticleAt = [](const Eigen::Vector3d& place) {
        return [=](TestCase& test) { test.dem.particles.push_back(place); };
    };
    expectRefused(withParticleAt({0.0101, 0.0099, 0.02}), {"particle 2 is at the same place", "0.0099 0.02) m", script},
        SeenBy::engine);
    expectRefused(withParticleAt({0, 0.01, 0.03}),
        {"particle 2 at (0 0.01 0.03) m is not a finite number", "exactly on a wall"}, SeenBy::engine);
    expectRefused(
        withParticleAt({0.1, 0.01, 0.03}), {script + " line ", "made no particle", "the box, (-0.002"}, SeenBy::engine);
    expectRefused(withParticleAt({0.0101, 0.0099, 0.0208}), {"Particles 1 and 2 at", "overlap by 0.0012 m", "allowed"},
        SeenBy::engine);
}

/// The script's own `run` moves the particles without the fluid; it was taken, with exit 0, and within an `if` for longer. A last
/// line that is to go on was left out without a word. What LIGGGHTS says of a command with variables comes with their values.
TEST(BadInput, RunAndVariablesInDemScript)
{
    expectRefused([](TestCase& test) { test.dem.more = "run 10"; }, {script + " line ", "'run 10'", "without 'run'"},
        SeenBy::engine);
    for (const std::string command :
        {"run 10", "create_atoms 1 single 0.01 0.01 0.03", "if 1 then 'jump in.particles'"})
    {
        SCOPED_TRACE(command);
        expectRefused([&](TestCase& test) { test.dem.more = R"(if 1 then "variable a equal 1" ")" + command + '"'; },
            {script + " line ", command, "allowed: an 'if' without"}, SeenBy::engine);
    }
    expectRefused([](TestCase& test) { test.dem.more = "variable a &"; },
        {script, "'variable a  ', ends in '&'", "allowed:"}, SeenBy::engine);
    expectRefused(
        [](TestCase& test) {
            test.dem.more = "variable inside equal -0.5\nregion mouth cylinder z 0 0 ${inside} 0 1 units box";
        },
        {script + " line ", "(region mouth cylinder z 0 0 -0.5 0 1 units box)", "Illegal region"}, SeenBy::engine);
}

/// Sizes that cannot go together, as lengths in mm do not, a model that other solvers know, a field by CFDEMcoupling's
/// name: refused, where the program ran, or began a smoothing of thousands of sweeps.
TEST(BadInput, SizesAndFilesThatNobodyReads)
{
    expectEntryRefused("DEM/variables/particleDiameter", "2", {"2 m", "the mesh spans"});
    expectEntryRefused("DEM/variables/youngsModulus", "1e200", {"1e+200"});
    expectRefused([](TestCase& test) { test.coupling().set("constDiffSmoothingProps/bandwidth", "1"); },
        {couplingProperties, "'bandwidth' is 1 m", "the mesh spans"}, SeenBy::engine);
    expectRefused([](TestCase& test) { test.file("constant/turbulenceProperties").set("simulationType", "DNS"); },
        {"turbulenceProperties", "'DNS'", "laminar"}, SeenBy::dictionaries);
    expectRefused([](TestCase& test) { test.file("0/voidfraction") = test.file("0/p"); },
        {"0/voidfraction", "did you mean 'voidFraction'?", "allowed:"}, SeenBy::engine);
}

/// What pimpleFoam does and this solver does not: refused, where the program ran without it.
TEST(BadInput, OfPimpleFoamOnly)
{
    expectRefused([](TestCase& test) { test.file("constant/MRFProperties").set("rotor/omega", "100"); },
        {"MRFProperties", "'rotor'", "would have no effect", "active no", "dynamicMeshDict"}, SeenBy::dictionaries);
    expectRefused([](TestCase& test) { test.solution().set("PIMPLE/consistent", "yes"); },
        {"fvSolution", "'consistent yes'", "allowed: no"}, SeenBy::dictionaries);
    expectRefused([](TestCase& test) { test.solution().set("PIMPLE/frozenFlow", "yes"); },
        {"fvSolution", "'frozenFlow yes'", "allowed: no"}, SeenBy::dictionaries);
    expectRefused([](TestCase& test) { test.solution().set("PIMPLE/solveFlow", "no"); },
        {"fvSolution", "'solveFlow no'", "allowed: yes"}, SeenBy::dictionaries);
    expectRefused([](TestCase& test) { test.file("constant/turbulenceProperties").set("simulationtype", "RAS"); },
        {"turbulenceProperties", "did you mean 'simulationType'?"}, SeenBy::dictionaries);
    expectRefused([](TestCase& test) { test.file("constant/turbulenceProperties").set("RAS/RASModel", "kEpsilon"); },
        {"turbulenceProperties", "simulationType"}, SeenBy::dictionaries);
}

/// Schemes that would make the equations others: a run with them reached its end with another velocity.
TEST(BadInput, Schemes)
{
    const auto refused = [](const std::string& entry, const std::string& scheme,
                             const std::vector<std::string>& words) {
        expectRefused(
            [&](TestCase& test) { test.file("system/fvSchemes").set(entry, scheme); }, words, SeenBy::dictionaries);
    };
    refused("divSchemes/div(phi,U)", "bounded Gauss upwind", {"'div(phi,U)'", "fvSchemes", "'bounded'"});
    refused("ddtSchemes/default", "steadyState", {"'ddt(voidFraction,U)'", "fvSchemes", "steadyState", "Euler"});
    refused("ddtSchemes/ddt(voidFraction,U)", "backward", {"'ddt(voidFraction)'", "fvSchemes", "differ"});
}

/// Values that a case sets and the script replaces, or does not use; forces that could not act: refused, or a warning,
/// where the program ran without them.
TEST(BadInput, ValuesWithoutEffect)
{
    expectRefused(
        [](TestCase& test) {
            test.coupling().set("DEM/variables/friction", "0.3");
            test.dem.more += "variable friction equal 0.5\n";
        },
        {script + " line ", "'variable friction equal 0.5'", "DEM { variables { friction } }", "index"},
        SeenBy::engine);
    const std::string lubricated = "(DiFeliceDrag gradPForce viscForce Archimedes lubricationForce)";
    expectRefused(
        [&](TestCase& test) {
            test.coupling()
                .set("forceModels", lubricated)
                .set("lubricationForceProps/roughness", "1e-6")
                .set("lubricationForceProps/wallReach", "1");
        },
        {couplingProperties, "'wallReach'", "'walls"}, SeenBy::dictionaries);
    expectRefused(
        [&](TestCase& test) {
            test.coupling().set("forceModels", lubricated).set("lubricationForceProps/roughness", "1e-6");
            test.dem.more += "pair_style none\n";
        },
        {"'lubricationForce'", "pair_style none", "allowed: pair_style gran"}, SeenBy::engine);

    const auto withDefault = [](TestCase& test) {
        test.coupling().set("DEM/variables/frition", "0.3");
        test.dem.more += "variable friction index 0.5\nprint \"friction ${friction}\"\n";
    };
    expectRefused(withDefault, {"DEM { variables { frition } }", "did you mean 'friction'?"}, SeenBy::engine);

    TestCase unused;
    fillIn(unused);
    unused.extraFiles.clear();
    withDefault(unused);
    unused.coupling().set("DEM/variables/friction", "0.3");
    const Outcome outcome = unused.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    EXPECT_TRUE(unused.runCommand("grep 'friction 0.3' log.liggghts").succeeded()) << "index is a default only";
}

/// A pressure solver that stops at maxIter is reported once, counted at the end, and ends a run that goes on like that. The
/// program went on in silence.
TEST(BadInput, UnconvergedPressure)
{
    TestCase test;
    fillIn(test);
    test.extraFiles.clear();
    const std::string stopsEarly = "{ solver PCG; preconditioner DIC; tolerance 1e-10; relTol 0; maxIter 1; }";
    test.solution().set("solvers/p", stopsEarly).set("solvers/pFinal", stopsEarly);
    const Outcome few = test.run();
    EXPECT_TRUE(few.succeeded()) << few.output;
    EXPECT_TRUE(few.says("DICPCG stopped after 1 iterations")) << few.output;
    EXPECT_TRUE(few.says("WARNING: the pressure was not solved to its tolerance in 4 of 4 coupling steps"))
        << few.output;

    test.control().set("endTime", "0.2").set("startFrom", "latestTime");
    test.write();
    expectRefused(test.runCommand("$SOLVER"), {"DICPCG stopped after 1 iterations", "in the last 50 coupling steps"});
}

/// A coupling step in which a particle crosses many cells: warned of with the figure. A hundredfold deltaT went
/// unnoticed.
TEST(BadInput, LongInterval)
{
    TestCase test;
    fillIn(test);
    test.extraFiles.clear();
    test.setTimes(0.05, 0.05, 0.05);
    const Outcome outcome = test.run();
    EXPECT_TRUE(outcome.says("in a coupling step of 0.05 s")) << outcome.output;
    EXPECT_TRUE(outcome.says("WARNING: particles moved farther")) << outcome.output;
}

/// `-dryRun` refuses what a start refuses, writes nothing (no table of function objects, no dump, no lock), replaces
/// nothing of an earlier run, and prints what a run will take. One that only read the dictionaries would pass the
/// second case.
TEST(BadInput, DryRun)
{
    TestCase test;
    fillIn(test);
    test.dem.dumpEvery = 10;
    test.dem.more = "compute energy all ke\nfix mean all ave/time 1 1 1 c_energy file DEM/energy.txt\n"
                    "fix reported all print 1 \"file 1\" file DEM/reported.txt screen no\n";
    ASSERT_TRUE(test.makeMesh().succeeded());
    const Files before = filesIn(test.path());
    const Outcome outcome = test.runCommand("$SOLVER -dryRun");
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    EXPECT_TRUE(outcome.says("Case check: one coupling step took")) << outcome.output;
    EXPECT_TRUE(outcome.says("MiB")) << outcome.output;
    EXPECT_EQ(before, filesIn(test.path()));

    expectRefused(test.runCommand("TMPDIR=/proc/none OMPI_MCA_orte_tmpdir_base=/tmp $SOLVER -dryRun"),
        {"TMPDIR is '/proc/none'", "allowed:"});
    const Outcome atEnd = test.runCommand("cp -r . ../$$ && cd ../$$ && $SOLVER && $SOLVER -dryRun; status=$?; "
                                          "rm -r ../$$; exit $status");
    EXPECT_TRUE(atEnd.succeeded()) << atEnd.output;
    EXPECT_TRUE(atEnd.says("Case check: the case has reached its end, 0.004 s")) << atEnd.output;

    test.dem.particles.emplace_back(0.01, 0.01, 0.0412);
    test.write();
    const Files wrong = filesIn(test.path());
    expectRefused(
        test.runCommand("$SOLVER -dryRun"), {"Particle 2 at (0.01 0.01 0.0412) m lies in no cell of the mesh"});
    EXPECT_EQ(wrong, filesIn(test.path()));
}

/// The same on two ranks: the message comes through and the program ends. An error that one rank alone reports would
/// leave the other waiting for ever.
TEST(BadInput, OnTwoRanks)
{
    expectRefused([](TestCase& test) { test.coupling().set("forceModels", "(DiFelice)"); },
        {couplingProperties, "'DiFelice'", "DiFeliceDrag"}, SeenBy::dictionaries, 2);
    expectLineRefused("fix oops all gravvity 9.81", "Invalid fix style: \"gravvity\"", 2);
    expectRefused(
        [](TestCase& test) {
            test.dem.readRestart = "DEM/none.restart";
            test.dem.particles.clear();
        },
        {script + " line ", "Cannot open DEM/none.restart"}, SeenBy::engine, 2);
    expectRefused([](TestCase& test) { test.dem.particles.emplace_back(0.01, 0.01, 0.0412); },
        {"Particle 2 at (0.01 0.01 0.0412) m lies in no cell of the mesh"}, SeenBy::engine, 2);
}

/// A case that is decomposed for two ranks does not start on three, nor one that is not decomposed on two. A program
/// that took the parts it finds would solve half of the tank.
TEST(BadInput, AnotherNumberOfRanks)
{
    TestCase test;
    fillIn(test);
    ASSERT_TRUE(test.makeMesh().succeeded());
    const Files whole = filesIn(test.path());
    expectRefused(test.runCommand(commandOn(2)), {"decomposeParDict"});
    expectSameFiles(whole, filesIn(test.path()), SeenBy::dictionaries);

    decompose(test, 2);
    const Files before = filesIn(test.path());
    expectRefused(test.runCommand(commandOn(3)), {"number of processor directories = 2", "number of processors = 3"});
    expectSameFiles(before, filesIn(test.path()), SeenBy::dictionaries);
}

/// A second program in a case that is at work is refused and does not disturb the first: its curve has every row, once.
/// Without the lock both would write into the same files.
TEST(BadInput, TwoProgramsInOneCase)
{
    TestCase test;
    fillIn(test);
    test.extraFiles.clear();
    test.setTimes(0.5, 1e-3, 0.5);
    ASSERT_TRUE(test.makeMesh().succeeded());
    // The first is halted while the second tries, so that it cannot have ended by then.
    const Outcome second =
        test.runCommand("$SOLVER > first.log 2>&1 & first=$!; "
                        "until grep -q \"Time scales\" first.log || ! kill -0 $first; do sleep 0.02; done; "
                        "kill -STOP $first; $SOLVER; second=$?; kill -CONT $first; "
                        "wait $first || exit 0; exit $second");
    expectRefused(
        second, {"Another program runs in this case", "process ", test.path().string(), ".pimpleDemFoam.lock"});
    EXPECT_EQ(test.table("postProcessing/massInHopper/0/massInHopper.dat").size(), 501U);
}

} // namespace
