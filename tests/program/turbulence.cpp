/// \file
/// Turbulence models in the program: the same flow as in OpenFOAM's pimpleFoam where there are no particles, every model
/// that is listed, resumed and parallel runs, and what is refused. (The stress on particles: models/viscousStress.cpp.)

#include "support/testCase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

namespace clepsydra::tests
{

namespace
{

constexpr double viscosity = 1e-6;
constexpr double velocity = 1;
const std::string libraryOfModels = "libturbulenceModels";

struct InitialField
{
    std::string dimensions;
    double value;
    std::string atWalls;
};

/// Fields of the models, with 5 % turbulence in a flow of 1 m/s and eddies of some millimetres.
const std::map<std::string, InitialField> initialFields = {
    {"k", {"[0 2 -2 0 0 0 0]", 3.75e-3, "kqRWallFunction"}},
    {"epsilon", {"[0 2 -3 0 0 0 0]", 0.03, "epsilonWallFunction"}},
    {"omega", {"[0 0 -1 0 0 0 0]", 90, "omegaWallFunction"}},
    {"nut", {"[0 2 -1 0 0 0 0]", 4.2e-5, "nutkWallFunction"}},
    {"nuTilda", {"[0 2 -1 0 0 0 0]", 4.2e-5, "zeroGradient"}},
    {"ReThetat", {"[0 0 0 0 0 0 0]", 100, "zeroGradient"}},
    {"gammaInt", {"[0 0 0 0 0 0 0]", 1, "zeroGradient"}},
    {"flm", {"[0 4 -4 0 0 0 0]", 1e-8, "zeroGradient"}},
    {"fmm", {"[0 4 -4 0 0 0 0]", 1e-6, "zeroGradient"}},
};

/// Fields that a model reads besides nut.
std::vector<std::string> fieldsOf(const std::string& model)
{
    const auto begins = [&](const std::string& text) { return model.compare(0, text.size(), text) == 0; };
    if (model == "kOmegaSSTLM")
    {
        return {"k", "omega", "ReThetat", "gammaInt"};
    }
    if (begins("kOmega"))
    {
        return {"k", "omega"};
    }
    if (begins("SpalartAllmaras"))
    {
        return {"nuTilda"};
    }
    if (model == "kEqn" || model == "dynamicKEqn")
    {
        return {"k"};
    }
    if (model == "dynamicLagrangian")
    {
        return {"flm", "fmm"};
    }
    return model == "Smagorinsky" || model == "WALE" ? std::vector<std::string>()
                                                     : std::vector<std::string>{"k", "epsilon"};
}

void setField(TestCase& test, const std::string& name, bool throughFlow)
{
    const InitialField& initial = initialFields.at(name);
    std::ostringstream value;
    value << "uniform " << initial.value;
    FoamFile field("volScalarField");
    field.set("dimensions", initial.dimensions)
        .set("internalField", value.str())
        .set("boundaryField/walls/type", initial.atWalls)
        .set("boundaryField/walls/value", value.str());
    if (throughFlow)
    {
        field.set("boundaryField/inlet/type", name == "nut" ? "calculated" : "fixedValue")
            .set("boundaryField/inlet/value", value.str())
            .set("boundaryField/outlet/type", name == "nut" ? "calculated" : "zeroGradient");
        if (name == "nut")
        {
            field.set("boundaryField/outlet/value", value.str());
        }
    }
    test.file("0/" + name) = field;
}

/// Selects a model, with its fields, schemes and solvers.
void selectModel(TestCase& test, const std::string& type, const std::string& model, bool throughFlow)
{
    FoamFile& properties = test.file("constant/turbulenceProperties");
    properties.set("simulationType", type)
        .set(type + '/' + type + "Model", model)
        .set(type + "/turbulence", "on")
        .set(type + "/printCoeffs", "off");
    if (model == "kOmegaSSTSAS")
    {
        properties.set("RAS/delta", "cubeRootVol").set("RAS/cubeRootVolCoeffs/deltaCoeff", "1");
    }
    if (type == "LES")
    {
        properties.set("LES/delta", model.find("IDDES") != std::string::npos ? "IDDESDelta" : "cubeRootVol")
            .set("LES/cubeRootVolCoeffs/deltaCoeff", "1")
            .set("LES/filter", "simple");
    }
    setField(test, "nut", throughFlow);
    if (model.find("SpalartAllmaras") == 0)
    {
        // It has no k, which the other wall function asks for.
        test.file("0/nut").set("boundaryField/walls/type", "nutUSpaldingWallFunction");
    }
    for (const std::string& field : fieldsOf(model))
    {
        setField(test, field, throughFlow);
        test.file("system/fvSchemes").set("divSchemes/div(phi," + field + ")", "Gauss upwind");
    }
    test.file("system/fvSchemes").set("wallDist/method", "meshWave");
    const std::string tolerance = " tolerance 1e-13; relTol 0; }";
    test.solution()
        .set("solvers/\"(U|k|epsilon|omega|nuTilda|ReThetat|gammaInt|flm|fmm)(Final)?\"",
            "{ solver smoothSolver; smoother symGaussSeidel;" + tolerance)
        .remove("solvers/\"U|UFinal\"");
    for (const std::string field : {"p", "pFinal"})
    {
        test.solution().set("solvers/" + field, "{ solver PCG; preconditioner DIC;" + tolerance);
    }
}

/// A square channel with rough guesses of turbulence at its inlet. Cells at the walls end at y+ = 100, so that wall
/// functions act.
void channel(TestCase& test)
{
    test.box.upper = {0.02, 0.02, 0.04};
    test.cells = {8, 8, 12};
    test.setFluid(1000, viscosity);
    test.setThroughFlow("uniform (0 0 1)");
    test.file("0/U").set("internalField", "uniform (0 0 1)").set("boundaryField/walls/type", "noSlip");
    test.setTimes(0.02, 1e-3, 0.02);
    test.dem.timeStep = 1e-5;
}

/// A run with fluid has particles: one that the fluid cannot feel, beside the mesh.
void addParticleOutside(TestCase& test)
{
    test.dem.walls = false;
    test.dem.fixed = true;
    test.dem.particles = {{test.box.upper.x() + 0.8 * test.dem.diameter, 0.01, 0.02}};
    test.coupling().set("allowParticlesOutsideMesh", "yes");
}

/// Particles that fall through a channel with upward flow, faster at the start than it.
void addParticles(TestCase& test)
{
    test.dem.diameter = 1e-3;
    test.dem.particles = simpleLattice(Box{{0.002, 0.002, 0.012}, {0.018, 0.018, 0.032}}, {4, 4, 5});
    jitter(test.dem.particles, 4e-4, 5);
    test.coupling().set("constDiffSmoothingProps/bandwidth", "3e-3");
}

/// Largest difference of two fields over the largest value.
double difference(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other)
{
    return (one - other).cwiseAbs().maxCoeff() / other.cwiseAbs().maxCoeff();
}

/// Model -> type (RAS, LES), as the program lists them.
std::map<std::string, std::string> listedModels()
{
    TestCase test;
    std::istringstream lines(test.runCommand("$SOLVER -listModels").output);
    std::map<std::string, std::string> models;
    std::string type;
    for (std::string line; std::getline(lines, line);)
    {
        if (line.compare(0, 4, "    ") != 0)
        {
            type = line.find("RASModel") != std::string::npos   ? "RAS"
                   : line.find("LESModel") != std::string::npos ? "LES"
                                                                : "";
        }
        else if (!type.empty())
        {
            std::string name;
            std::istringstream(line) >> name;
            models[name] = type;
        }
    }
    return models;
}

} // namespace

class ChannelBesidePimpleFoam : public testing::TestWithParam<std::string>
{};

/// Twenty steps of a channel without particles, with wall functions, in this program and in pimpleFoam, from the same
/// files. A stress without the eddy viscosity, another order of the equations, or boundary conditions that find another
/// model differ at once: the mean eddy viscosity of a RAS model is more than five times the viscosity of the fluid, and in
/// laminar flow U differs by percents. WALE, whose eddy viscosity vanishes at walls, changes U at least a thousand times
/// more than the two programs differ.
TEST_P(ChannelBesidePimpleFoam, IsTheSameToRounding)
{
    const std::string model = GetParam();
    TestCase test;
    channel(test);
    const std::string type = model == "WALE" ? "LES" : "RAS";
    selectModel(test, type, model, true);
    addParticleOutside(test);
    test.transport().set("transportModel", "Newtonian");
    const Outcome ours = test.run();
    ASSERT_TRUE(ours.succeeded()) << ours.output;
    EXPECT_TRUE(ours.says("nut: " + type + ' ' + model)) << ours.output;
    const Outcome theirs = test.runCommand("mkdir single && cp -r 0 constant system single && cd single && pimpleFoam");
    ASSERT_TRUE(theirs.succeeded()) << theirs.output;
    std::vector<std::string> names = fieldsOf(model);
    names.insert(names.end(), {"U", "p", "nut"});
    for (const std::string& name : names)
    {
        const Eigen::MatrixXd there = readInternalField(test.path() / "single/0.02" / name);
        const double found = difference(test.field(name, "0.02"), there);
        std::cout << model << ", " << name << ": " << found << std::endl;
        EXPECT_LT(found, 1e-9) << name;
    }
    if (type == "RAS")
    {
        EXPECT_GT(test.field("nut", "0.02").mean(), 5 * viscosity);
    }

    TestCase laminar;
    channel(laminar);
    addParticleOutside(laminar);
    const Outcome without = laminar.run();
    ASSERT_TRUE(without.succeeded()) << without.output;
    EXPECT_GT(difference(laminar.field("U", "0.02"), test.field("U", "0.02")), type == "RAS" ? 1e-2 : 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Models, ChannelBesidePimpleFoam, testing::Values("kEpsilon", "kOmegaSST", "WALE"),
    [](const testing::TestParamInfo<std::string>& model) { return model.param; });

/// Every model that -listModels names is created, by its name, and solves two coupling steps with particles.
TEST(Turbulence, EveryListedModelRuns)
{
    const std::map<std::string, std::string> models = listedModels();
    EXPECT_GE(models.size(), 20U);
    for (const auto& [model, type] : models)
    {
        TestCase test;
        channel(test);
        selectModel(test, type, model, true);
        addParticles(test);
        test.setTimes(2e-3, 1e-3, 2e-3);
        const Outcome outcome = test.run();
        ASSERT_TRUE(outcome.succeeded()) << model << '\n' << outcome.output;
        EXPECT_TRUE(outcome.says("Selecting " + type + " turbulence model " + model)) << outcome.output;
        EXPECT_GT(test.field("nut", "0.002").maxCoeff(), 0) << model;
    }
}

/// Particles that fall in a turbulent flow receive what the fluid gives: to rounding with either model type, where the
/// stress of the fluid's equation and that of the particles differed, the momentum error would be the stress on a particle.
TEST(Turbulence, ConservesMomentum)
{
    for (const std::string modelType : {"A", "B"})
    {
        TestCase test;
        channel(test);
        selectModel(test, "RAS", "kEpsilon", true);
        addParticles(test);
        test.coupling().set("modelType", modelType);
        if (modelType == "B")
        {
            test.coupling().set("forceModels", "(DiFeliceDrag Archimedes)");
        }
        const Outcome outcome = test.run();
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
        EXPECT_LT(test.conservationSummary()["momentumError"], 1e-9) << modelType;
    }
}

/// Without production, destruction and gradients the equation of SpalartAllmaras says that nuTilda moves with the fluid, so
/// a uniform one remains uniform while a cloud of particles falls through it. Its equation has the void fraction and the
/// flux of different steps: without the continuity error subtracted, nuTilda would change by parts of a thousand.
TEST(Turbulence, UniformFieldRemainsUniformBetweenMovingParticles)
{
    TestCase test;
    test.setTimes(0.05, 1e-3, 0.05);
    selectModel(test, "RAS", "SpalartAllmaras", false);
    test.file("0/nut").set("boundaryField/walls/type", "calculated");
    test.file("constant/turbulenceProperties")
        .set("RAS/SpalartAllmarasCoeffs/Cb1", "0")
        .set("RAS/SpalartAllmarasCoeffs/Cb2", "-1");
    test.dem.particles = simpleLattice(Box{{0.003, 0.003, 0.015}, {0.017, 0.017, 0.035}}, {4, 4, 6});
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const Eigen::MatrixXd voidFraction = test.field("voidFraction", "0.05");
    EXPECT_LT(voidFraction.minCoeff(), 0.93);
    EXPECT_GT(voidFraction.maxCoeff(), 0.99);
    const Eigen::MatrixXd nuTilda = test.field("nuTilda", "0.05");
    std::cout << "nuTilda: " << nuTilda.minCoeff() << " to " << nuTilda.maxCoeff() << std::endl;
    EXPECT_LT((nuTilda.array() / initialFields.at("nuTilda").value - 1).abs().maxCoeff(), 1e-9);
}

class TurbulentCheckpoint : public testing::TestWithParam<std::string>
{};

/// A run that stops in the middle and is resumed, beside one that has a checkpoint there: the same to the last bit. A model
/// that loses a field differs, and so does one whose eddy viscosity is computed again at the start: Spalding's law at the
/// walls of SpalartAllmaras is solved from the value that was found last, to a hundredth.
TEST_P(TurbulentCheckpoint, ResumedIsNeverStopped)
{
    TestCase through;
    TestCase stopped;
    for (TestCase* test : {&through, &stopped})
    {
        channel(*test);
        selectModel(*test, "RAS", GetParam(), true);
        addParticles(*test);
        test->setTimes(0.02, 1e-3, 0.01);
        // A boundary whose values are all alike is written as text also then.
        test->control().set("writeFormat", "binary").set("writePrecision", "17");
    }
    const Outcome whole = through.run();
    ASSERT_TRUE(whole.succeeded()) << whole.output;
    ASSERT_TRUE(stopped.makeMesh().succeeded());
    const Outcome second =
        stopped.runCommand("cp system/controlDict asked && echo 'endTime 0.01;' >> system/controlDict && "
                           "$SOLVER && cp asked system/controlDict && $SOLVER");
    ASSERT_TRUE(second.succeeded()) << second.output;
    EXPECT_TRUE(second.says("Resuming from the checkpoint of time 0.01")) << second.output;
    EXPECT_TRUE(stopped.runCommand(TestCase::sameCheckpoint("0.02", through)).succeeded());
    for (const std::string& field : fieldsOf(GetParam()))
    {
        EXPECT_TRUE(through.runCommand("grep -q 0.02/" + field + " checkpoints/0.02/complete").succeeded()) << field;
        EXPECT_FALSE(through.runCommand("cmp 0.01/" + field + " 0.02/" + field).succeeded()) << field;
    }
    EXPECT_TRUE(through.runCommand("grep -q 0.02/nut checkpoints/0.02/complete").succeeded());

    const Outcome changed = stopped.runCommand("echo 'RAS { kMin 1e-9; }' >> constant/turbulenceProperties && "
                                               "echo 'endTime 0.021;' >> system/controlDict && $SOLVER");
    EXPECT_TRUE(changed.says("constant/turbulenceProperties has changed")) << changed.output;
}

INSTANTIATE_TEST_SUITE_P(Models, TurbulentCheckpoint, testing::Values("kEpsilon", "kOmegaSST", "SpalartAllmaras"),
    [](const testing::TestParamInfo<std::string>& model) { return model.param; });

class TurbulenceOnTwoRanks : public testing::TestWithParam<std::pair<std::string, double>>
{};

/// Fields of a turbulent channel with particles in serial and on two ranks. A wall function or a wall distance that saw one
/// rank only would differ by parts of the field. In the middle of the channel the blending function of kOmegaSST depends on
/// grad(k) . grad(omega) where both vanish, so that differences by rounding grow there.
TEST_P(TurbulenceOnTwoRanks, AgreesWithSerial)
{
    const auto& [model, tolerance] = GetParam();
    TestCase serial;
    TestCase parallel;
    for (TestCase* test : {&serial, &parallel})
    {
        channel(*test);
        selectModel(*test, "RAS", model, true);
        addParticles(*test);
    }
    const Outcome alone = serial.run();
    ASSERT_TRUE(alone.succeeded()) << alone.output;
    const Outcome together = parallel.run(2);
    ASSERT_TRUE(together.succeeded()) << together.output;
    std::vector<std::string> names = fieldsOf(model);
    names.insert(names.end(), {"U", "p", "nut", "voidFraction"});
    for (const std::string& name : names)
    {
        const double found = difference(parallel.field(name, "0.02"), serial.field(name, "0.02"));
        std::cout << model << ", " << name << ": " << found << std::endl;
        EXPECT_LT(found, tolerance) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(Models, TurbulenceOnTwoRanks,
    testing::Values(std::pair("kEpsilon", 1e-9), std::pair("kOmegaSST", 1e-6)),
    [](const testing::TestParamInfo<TurbulenceOnTwoRanks::ParamType>& model) { return model.param.first; });

/// Particles that follow the liquid within a twentieth of an eddy's lifetime of 4 ms, in liquid at rest whose turbulence
/// neither decays nor diffuses: the variance of their places grows as 2 D t with the coefficient of the closure
/// (tests/closures/discreteRandomWalk.cpp), with two coupling steps to an eddy and with five eddies to a coupling step.
/// Particles without dispersion rest; with one eddy for good they spread with t^2, seven times as far; with one eddy to
/// each coupling step the variance of the second run is five times as large.
TEST(Turbulence, ParticlesDisperseAsTheEddiesSay)
{
    constexpr double k = 1e-4;
    constexpr double dissipation = 4e-3;
    constexpr double end = 0.2;
    for (const double couplingTimeStep : {2e-3, 2e-2})
    {
        TestCase test;
        test.box.upper = {0.04, 0.04, 0.04};
        test.cells = {4, 4, 4};
        test.dem.diameter = 5e-5;
        test.dem.density = 1000;
        test.dem.walls = false;
        test.dem.timeStep = 1e-4;
        // No contacts, whose duration would limit the DEM step, nor what LIGGGHTS does for them in bins of small particles.
        test.dem.more = "atom_modify sort 0 0\nneigh_modify exclude group all all binsize 0.01";
        test.coupling().set("DEM/maxRayleighFraction", "1000");
        test.dem.gravity = 0;
        test.file("constant/g").set("value", "(0 0 0)");
        test.dem.particles = simpleLattice(Box{{0.015, 0.015, 0.015}, {0.025, 0.025, 0.025}}, {12, 12, 12});
        selectModel(test, "RAS", "kEpsilon", false);
        test.file("0/k").set("internalField", "uniform 1e-4").set("boundaryField/walls/type", "zeroGradient");
        test.file("0/epsilon").set("internalField", "uniform 4e-3").set("boundaryField/walls/type", "zeroGradient");
        test.file("0/nut").set("boundaryField/walls/type", "calculated");
        test.file("constant/turbulenceProperties").set("RAS/turbulence", "off");
        test.coupling()
            .set("turbulentDispersion", "discreteRandomWalk")
            .set("turbulentDispersionProps/seed", "5")
            .set("forceModels", "(SchillerNaumannDrag gradPForce viscForce Archimedes)");
        test.setTimes(end, couplingTimeStep, end);
        test.dem.dumpEvery = 2000;
        const Outcome outcome = test.run();
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
        const auto history = test.particleHistory();
        const Eigen::Matrix3Xd moved = history.back().position - history.front().position;
        const double size = std::pow(0.09, 0.75) * std::pow(k, 1.5) / dissipation;
        const double coefficient = size * std::sqrt(2 * k / 3) / (6 * std::sqrt(2 / M_PI));
        const double found = moved.squaredNorm() / static_cast<double>(moved.size()) / (2 * coefficient * end);
        std::cout << "coupling step " << couplingTimeStep << " s: " << found << " of the diffusion" << std::endl;
        // A standard error of sqrt(2/5184), and of the walk's finite length.
        EXPECT_NEAR(found, 1, 0.08) << couplingTimeStep;
        EXPECT_LT(test.conservationSummary()["momentumError"], 1e-9);
    }
}

/// Eddies survive a stop, to the last bit, and another number of ranks.
TEST(Turbulence, EddiesOfParticlesAreThoseOfTheRunThatNeverStopped)
{
    TestCase through;
    TestCase stopped;
    TestCase parallel;
    TestCase without;
    for (TestCase* test : {&through, &stopped, &parallel, &without})
    {
        channel(*test);
        selectModel(*test, "RAS", "kEpsilon", true);
        addParticles(*test);
        test->setTimes(0.02, 1e-3, 0.01);
        test->control()
            .set("writeFormat", test == &stopped || test == &through ? "binary" : "ascii")
            .set("writePrecision", "17");
        test->dem.dumpEvery = 1000;
        test->coupling().set("turbulentDispersion", test == &without ? "off" : "discreteRandomWalk");
    }
    for (TestCase* test : {&through, &without})
    {
        const Outcome outcome = test->run();
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    }
    ASSERT_TRUE(stopped.makeMesh().succeeded());
    const Outcome second =
        stopped.runCommand("cp system/controlDict asked && echo 'endTime 0.01;' >> system/controlDict && "
                           "$SOLVER && cp asked system/controlDict && $SOLVER");
    ASSERT_TRUE(second.succeeded()) << second.output;
    EXPECT_TRUE(stopped.runCommand(TestCase::sameCheckpoint("0.02", through)).succeeded());
    const Outcome together = parallel.run(2);
    ASSERT_TRUE(together.succeeded()) << together.output;

    const Eigen::Matrix3Xd places = through.particleHistory().back().position;
    const double eddies = (places - without.particleHistory().back().position).cwiseAbs().maxCoeff();
    const double ranks = (places - parallel.particleHistory().back().position).cwiseAbs().maxCoeff();
    std::cout << "eddies move particles by " << eddies << " m, another number of ranks by " << ranks << " m"
              << std::endl;
    EXPECT_GT(eddies, 1e-5);
    EXPECT_LT(ranks, 1e-8 * eddies);
}

/// A laminar case needs no library of turbulence models, and one with the file is the case without it, to the last bit.
TEST(Turbulence, LaminarCaseIsLeftAlone)
{
    TestCase without;
    TestCase with;
    for (TestCase* test : {&without, &with})
    {
        channel(*test);
        addParticles(*test);
        test->setTimes(5e-3, 1e-3, 5e-3);
    }
    with.file("constant/turbulenceProperties").set("simulationType", "laminar");
    ASSERT_TRUE(with.makeMesh().succeeded());
    const std::string traced = "LD_DEBUG=files LD_DEBUG_OUTPUT=loaded $SOLVER && cat loaded.*";
    const Outcome laminar = with.runCommand(traced);
    ASSERT_TRUE(laminar.succeeded()) << laminar.output;
    EXPECT_TRUE(laminar.says("libcoupling"));
    EXPECT_FALSE(laminar.says(libraryOfModels));
    const Outcome other = without.run();
    ASSERT_TRUE(other.succeeded()) << other.output;
    for (const std::string name : {"U", "p", "phi", "voidFraction"})
    {
        EXPECT_TRUE(with.runCommand(TestCase::sameFile("0.005/" + name, without)).succeeded()) << name;
    }
}

/// Names that are not known are refused with those that are; so is what would be solved wrongly.
TEST(Turbulence, WhatIsRefused)
{
    const auto refused = [](const auto& change, const std::vector<std::string>& expected) {
        TestCase test;
        channel(test);
        addParticles(test);
        selectModel(test, "RAS", "kEpsilon", true);
        change(test);
        const Outcome outcome = test.run();
        EXPECT_NE(outcome.status, 0);
        for (const std::string& text : expected)
        {
            EXPECT_TRUE(outcome.says(text)) << text << '\n' << outcome.output;
        }
    };
    const std::string properties = "constant/turbulenceProperties";
    refused([&](TestCase& test) { test.file(properties).set("simulationType", "DNS"); },
        {"turbulenceProperties", "'DNS'", "(laminar RAS LES)"});
    refused([&](TestCase& test) { test.file(properties).set("RAS/RASModel", "kEpsilom"); },
        {"turbulenceProperties", "'kEpsilom'", "did you mean 'kEpsilon'?", "kOmegaSST"});
    refused(
        [&](TestCase& test) {
            test.file(properties)
                .set("simulationType", "LES")
                .set("LES/LESModel", "kOmegaSST")
                .set("LES/turbulence", "on");
        },
        {"turbulenceProperties", "'kOmegaSST'", "WALE"});
    refused(
        [&](TestCase& test) {
            test.file(properties).set("simulationType", "laminar").set("laminar/laminarModel", "Maxwell");
        },
        {"turbulenceProperties", "'Maxwell'", "Stokes"});
    refused([](TestCase& test) { test.file("system/fvSchemes").set("divSchemes/div(phi,k)", "bounded Gauss upwind"); },
        {"div(phi,k)", "bounded", "allowed:"});
    refused([](TestCase& test) { test.removeFile("0/epsilon"); }, {"epsilon"});
    refused(
        [&](TestCase& test) {
            test.file(properties).set("simulationType", "laminar");
            test.coupling().set("turbulentDispersion", "discreteRandomWalk");
        },
        {"'turbulentDispersion'", "laminar", "RAS"});
    refused([](TestCase& test) { test.coupling().set("turbulentDispersion", "randomWalk"); },
        {"'randomWalk'", "discreteRandomWalk"});
    refused(
        [](TestCase& test) {
            test.coupling()
                .set("turbulentDispersion", "discreteRandomWalk")
                .set("selfInducedVelocityCorrection", "Oseen");
        },
        {"'turbulentDispersion'", "selfInducedVelocityCorrection off"});
}

} // namespace clepsydra::tests
