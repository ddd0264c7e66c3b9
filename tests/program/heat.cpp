/// \file
/// Temperatures of fluid and particles, the dictionary `energy`: against closed forms, and what must balance.

#include "closures/nusselt.h"
#include "support/testCase.h"
#include "tokens/exactText.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace clepsydra::tests
{

namespace
{

constexpr double pi = 3.14159265358979323846;
constexpr double diameter = 0.002;
constexpr double density = 2500;
constexpr double coldTemperature = 300;
constexpr double hotTemperature = 400;

struct Water
{
    double density = 1000;
    double viscosity = 1e-6; // kinematic
    double specificHeat = 4200;
    double conductivity = 0.6;

    double prandtl() const
    {
        return density * viscosity * specificHeat / conductivity;
    }
};

/// A case with temperatures: the water is at 300 K and the particles at 400 K.
void addHeat(TestCase& test, double particleCp, const std::string& law = "RanzMarshall")
{
    const Water water;
    test.transport().set("Cp", water.specificHeat).set("kappa", water.conductivity);
    test.coupling()
        .set("energy/heatTransferModel", law)
        .set("energy/particleCp", particleCp)
        .set("energy/particleTemperature", hotTemperature);
    test.file("0/T") = FoamFile("volScalarField");
    test.file("0/T")
        .set("dimensions", "[0 0 0 1 0 0 0]")
        .set("internalField", "uniform " + exactText(coldTemperature))
        .set("boundaryField/\".*\"/type", "zeroGradient");
    test.file("system/fvSchemes").set("divSchemes/div(phi,T)", "Gauss upwind");
    test.solution().set("solvers/T", "{ solver PBiCGStab; preconditioner DILU; tolerance 1e-14; relTol 0; }");
    test.dem.diameter = diameter;
    test.dem.density = density;
}

/// Sixteen hot particles that fall to the floor of a box of water, across the plane between two ranks.
void hotCloud(TestCase& test)
{
    test.cells = {8, 8, 16};
    test.setTimes(0.12, 1e-3, 0.04);
    addHeat(test, 840, "Gunn");
    const std::string tolerance = " tolerance 1e-13; relTol 0; }";
    for (const std::string field : {"p", "pFinal"})
    {
        test.solution().set("solvers/" + field, "{ solver PCG; preconditioner DIC;" + tolerance);
    }
    test.solution().set("solvers/\"U|UFinal\"", "{ solver smoothSolver; smoother symGaussSeidel;" + tolerance);
    Box cloud;
    cloud.lower = {0.006, 0.006, 0.024};
    cloud.upper = {0.013, 0.014, 0.034};
    test.dem.particles = simpleLattice(cloud, {2, 2, 4});
    jitter(test.dem.particles, 1e-4, 1);
    test.dem.timeStep = 4e-5;
    test.dem.more = "velocity all set 0.1 0 0 units box";
}

double heat(const TestCase& test, const std::string& entry, const std::string& startTime = "0")
{
    return test.conservationSummary(startTime)[entry];
}

double particleMass()
{
    return density * pi / 6 * std::pow(diameter, 3);
}

} // namespace

/// A sphere with so little heat that the water's temperature remains: T_p - T = 100 K exp(-h A t/(m Cp)), with the Nusselt
/// number of the law at the speed of the stream. In the second run the coupling step is ten time constants, so that an
/// explicit exchange would overshoot by nine times the difference; in the third the law is Gunn's. Without an exchange the
/// particle would stay at 400 K.
TEST(Heat, SphereInAStreamCoolsAsTheLawStates)
{
    constexpr double speed = 0.1;
    const Water water;
    struct Run
    {
        std::string law;
        double particleCp;
        int steps;
    };
    for (const Run& run : {Run{"RanzMarshall", 1, 20}, Run{"RanzMarshall", 0.01, 1}, Run{"Gunn", 1, 20}})
    {
        SCOPED_TRACE(run.law + ' ' + exactText(run.particleCp));
        TestCase test;
        constexpr double timeStep = 2.5e-5;
        test.setThroughFlow("uniform (0 0 " + exactText(speed) + ")");
        test.file("0/U").set("internalField", "uniform (0 0 " + exactText(speed) + ")");
        addHeat(test, run.particleCp, run.law);
        test.dem.particles = {{0.0101, 0.0099, 0.02}};
        test.dem.fixed = true;
        test.setTimes(run.steps * timeStep, timeStep, run.steps * timeStep);
        const Outcome outcome = test.run();
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;

        const double voidFraction = test.layerMeans("voidFraction", test.times().back()).minCoeff();
        EXPECT_GT(voidFraction, 0.99);
        const double reynolds = speed * diameter / water.viscosity;
        const double nusselt = run.law == "Gunn" ? closures::gunnNusselt(reynolds, water.prandtl(), 1)
                                                 : closures::ranzMarshallNusselt(reynolds, water.prandtl());
        const double timeConstant = density * run.particleCp * diameter * diameter / (6 * nusselt * water.conductivity);
        const double heatCapacity = particleMass() * run.particleCp;
        const double hotter = heat(test, "heatInParticles") / heatCapacity - coldTemperature;
        const double expected = (hotTemperature - coldTemperature) * std::exp(-run.steps * timeStep / timeConstant);
        std::cout << run.law << ", coupling step " << timeStep / timeConstant << " time constants: " << hotter
                  << " K hotter than the water, expected " << expected << std::endl;
        if (expected > 1)
        {
            EXPECT_NEAR(std::log(hotter / expected) / std::log(expected / 100), 0, run.law == "Gunn" ? 0.01 : 1e-3);
        }
        else
        {
            // The water around the particle is warmer by the particle's heat, some 1e-6 K.
            EXPECT_GE(hotter, 0);
            EXPECT_LT(hotter, 1e-4);
        }
        EXPECT_LT(heat(test, "heatError"), 1e-12);
    }
}

/// In a closed box the heat of fluid and particles together remains, to rounding, while particles fall, collide and stir the
/// water, with coupling steps that change. A reaction that is lost at a wall, between ranks or with the void fraction
/// would show: the particles give up most of their heat, 1/300 of all.
TEST(Heat, IsConservedInAClosedBox)
{
    TestCase test;
    hotCloud(test);
    test.coupling()
        .set("adjustableCouplingTimeStep", "yes")
        .set("maxCo", "0.1")
        .set("minCouplingTimeStep", "4e-5")
        .set("maxCouplingTimeStep", "4e-3");
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const double atStart = heat(test, "heatStart");
    const double capacity = 16 * particleMass() * 840;
    std::cout << "change of heat " << heat(test, "heatEnd") / atStart - 1 << ", of which by the continuity error "
              << heat(test, "heatOfContinuityError") / atStart << "; particles at "
              << heat(test, "heatInParticles") / capacity << " K" << std::endl;
    EXPECT_NEAR(heat(test, "heatEnd") - heat(test, "heatOfContinuityError"), atStart, 1e-12 * atStart);
    EXPECT_LT(std::abs(heat(test, "heatOfContinuityError")), 1e-9 * atStart);
    EXPECT_LT(heat(test, "heatInParticles") / capacity, hotTemperature - 30);
    EXPECT_GT(heat(test, "heatInParticles") / capacity, coldTemperature);
    EXPECT_EQ(heat(test, "heatThroughBoundary"), 0);
    const Eigen::MatrixXd T = test.field("T", test.times().back());
    EXPECT_GT(T.minCoeff(), coldTemperature - 1e-6);
    EXPECT_LT(T.maxCoeff(), hotTemperature);
}

/// Fluid and particles of one temperature keep it, although the particles move: an equation with another void fraction than
/// that of continuity would heat and cool.
TEST(Heat, UniformTemperatureRemains)
{
    TestCase test;
    hotCloud(test);
    test.coupling().set("energy/particleTemperature", coldTemperature);
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const Eigen::MatrixXd T = test.field("T", test.times().back());
    EXPECT_LT((T.array() - coldTemperature).abs().maxCoeff(), 1e-8);
    EXPECT_NEAR(heat(test, "heatInParticles"), 16 * particleMass() * 840 * coldTemperature, 1e-8);
}

/// The same on two ranks. The particles cross the plane between the ranks and have no contacts until then.
TEST(Heat, IsTheSameOnTwoRanks)
{
    TestCase serial;
    TestCase parallel;
    for (TestCase* test : {&serial, &parallel})
    {
        hotCloud(*test);
    }
    const Outcome alone = serial.run();
    ASSERT_TRUE(alone.succeeded()) << alone.output;
    const Outcome together = parallel.run(2);
    ASSERT_TRUE(together.succeeded()) << together.output;
    ASSERT_EQ(parallel.conservationSummary()["ranks"], 2);
    const Eigen::MatrixXd one = serial.field("T", "0.12");
    const Eigen::MatrixXd two = parallel.field("T", "0.12");
    std::cout << "largest difference " << (one - two).cwiseAbs().maxCoeff() << " K of "
              << one.maxCoeff() - one.minCoeff() << " K" << std::endl;
    EXPECT_GT(one.maxCoeff() - one.minCoeff(), 0.5);
    EXPECT_LT((one - two).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_NEAR(heat(serial, "heatInParticles"), heat(parallel, "heatInParticles"), 1e-9);
    EXPECT_NEAR(heat(parallel, "heatEnd") - heat(parallel, "heatOfContinuityError"), heat(parallel, "heatStart"), 1e-9);
}

/// A run that is stopped and resumed is the run that was never stopped, to the last digit of the temperatures.
TEST(Heat, ResumedRunIsTheSame)
{
    TestCase through;
    TestCase stopped;
    for (TestCase* test : {&through, &stopped})
    {
        hotCloud(*test);
        test->control().set("writeFormat", "binary"); // all digits
    }
    const Outcome whole = through.run();
    ASSERT_TRUE(whole.succeeded()) << whole.output;
    stopped.setTimes(0.08, 1e-3, 0.04);
    const Outcome first = stopped.run();
    ASSERT_TRUE(first.succeeded()) << first.output;
    const Outcome second = stopped.runCommand("echo \"endTime 0.12;\" >> system/controlDict && $SOLVER");
    ASSERT_TRUE(second.succeeded()) << second.output;
    ASSERT_TRUE(second.says("Resuming from the checkpoint of time 0.08")) << second.output;
    for (const char* field : {"T", "U", "deferredHeat"})
    {
        EXPECT_TRUE(through.runCommand(TestCase::sameFile("0.12/" + std::string(field), stopped)).succeeded()) << field;
    }
    EXPECT_EQ(heat(through, "heatInParticles"), heat(stopped, "heatInParticles", "0.08"));
    EXPECT_TRUE(stopped.runCommand(TestCase::sameCheckpoint("0.12", through)).succeeded());
}

/// Water at rest that is 10 K warmer than TRef, half of it in a bed of fixed particles: dp/dz = -beta (T - TRef) g_z
/// everywhere, as of a lighter fluid. Without buoyancy it is 0; a force per volume of fluid and particles gives twice as
/// much in the bed.
TEST(Heat, WarmFluidIsLighter)
{
    TestCase test;
    constexpr double expansion = 1e-3;
    test.box.upper = {0.0039, 0.0039, 0.0156};
    test.cells = {3, 3, 24};
    test.setThroughFlow("uniform (0 0 0)");
    addHeat(test, 840);
    test.setFluid(10, 1.5e-4);
    test.transport().set("beta", expansion).set("TRef", coldTemperature - 10);
    test.coupling()
        .set("energy/particleTemperature", coldTemperature)
        .set("forceModels", "(StokesDrag gradPForce viscForce Archimedes)")
        .set("constDiffSmoothingProps/bandwidth", "1e-3");
    test.dem.diameter = 1e-3;
    test.dem.density = 2000;
    test.dem.fixed = true;
    test.dem.timeStep = 2e-5;
    Box filled = test.box;
    filled.upper.z() *= 0.5;
    test.dem.particles = bodyCentredLattice(filled, {3, 3, 6});
    test.setTimes(0.02, 2e-4, 0.02);
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const Eigen::VectorXd p = test.layerMeans("p", test.times().back());
    const double spacing = test.layerHeight(1) - test.layerHeight(0);
    const Eigen::ArrayXd gradients = (p.tail(p.size() - 1) - p.head(p.size() - 1)).array() / spacing;
    const double expected = expansion * 10 * 9.81;
    EXPECT_LT((gradients / expected - 1).abs().maxCoeff(), 5e-3) << gradients.transpose();
    EXPECT_LT(test.layerMeans("voidFraction", test.times().back()).minCoeff(), 0.6);
}

/// LIGGGHTS' conduction between particles beside the exchange with the fluid, from the temperatures and the specific heat of
/// the script: two particles that touch, one of which has a hundred times the mass. In a first run the light one cools in
/// the water and the heavy one hardly does; in the second, which begins with these particles, the water conducts almost
/// nothing, and their difference decreases by the factor 1 - h dt(1/C_1 + 1/C_2) in each DEM step, with LIGGGHTS' h = 2 k
/// sqrt(contact area), while their heat remains. A program with temperatures of its own beside LIGGGHTS' would leave the
/// difference as it was; one whose files of particles lack temperatures would begin with equal ones.
TEST(Heat, ContactsConductHeatByTheScript)
{
    constexpr double distance = 0.0019;
    constexpr double specificHeat = 500;
    const auto prepare = [](TestCase& test, double particleCp, double conductivity) {
        test.setTimes(0.01, 1e-3, 0.01);
        addHeat(test, particleCp);
        test.transport().set("kappa", conductivity);
        test.dem.fixed = true;
    };
    TestCase cooling;
    prepare(cooling, 5, 0.6);
    cooling.dem.particles = {{0.0091, 0.01, 0.02}, {0.0091 + distance, 0.01, 0.02}};
    cooling.dem.more = "set atom 2 density 250000";
    cooling.coupling().set("DEM/writeRestart", "\"DEM/end.restart\"");
    const Outcome first = cooling.run();
    ASSERT_TRUE(first.succeeded()) << first.output;

    TestCase test;
    prepare(test, specificHeat, 1e-9);
    test.coupling().remove("energy/particleCp").remove("energy/particleTemperature");
    test.dem.readRestart = (cooling.path() / "DEM/end.restart").string();
    test.dem.more = "fix conductivity all property/global thermalConductivity peratomtype 400 400\n"
                    "fix capacity all property/global thermalCapacity peratomtype 500 500\n"
                    "fix heat all heat/gran/conduction initial_temperature 300.\n"
                    "dump heat all custom 400 DEM/heat.dump id f_Temp\n"
                    "dump_modify heat sort id format \"%d %.15g\"";
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    std::vector<double> temperatures;
    for (const auto& row : test.table("DEM/heat.dump"))
    {
        if (row.size() == 2 && row[1] > 100)
        {
            temperatures.push_back(row[1]);
        }
    }
    // Of both particles at the first step of the dump and at the last
    ASSERT_EQ(temperatures.size(), 4U);
    const double atStart = temperatures[1] - temperatures[0];
    EXPECT_GT(atStart, 50);
    const double area = pi / 4 * (diameter * diameter - distance * distance);
    const double h = 2 * 400 * std::sqrt(area);
    const double light = particleMass() * specificHeat;
    const double difference = atStart * std::pow(1 - h * test.dem.timeStep * (1 / light + 1 / (100 * light)), 400);
    std::cout << "difference " << atStart << " K at the start, " << temperatures[3] - temperatures[2]
              << " K after 400 steps, expected " << difference << " K" << std::endl;
    EXPECT_NEAR(temperatures[3] - temperatures[2], difference, 1e-4 * atStart);
    EXPECT_LT(difference, 0.9 * atStart);
    EXPECT_NEAR(temperatures[2] + 100 * temperatures[3], temperatures[0] + 100 * temperatures[1], 1e-4);
    EXPECT_NEAR(heat(test, "heatEnd"), heat(test, "heatStart"), 1e-9 * heat(test, "heatStart"));
}

/// Particles from the file of another run have its temperatures, whatever the entry states, and a warning says so. There is none
/// where no particle has another temperature than that of the entry.
TEST(Heat, ParticlesFromAFileKeepTheirTemperatures)
{
    const auto prepare = [](TestCase& test) {
        test.setTimes(1e-3, 1e-3, 1e-3);
        addHeat(test, 840);
        test.dem.fixed = true;
    };
    TestCase first;
    prepare(first);
    first.dem.particles = {{0.0091, 0.01, 0.02}};
    first.coupling().set("DEM/writeRestart", "\"DEM/end.restart\"");
    const Outcome written = first.run();
    ASSERT_TRUE(written.succeeded()) << written.output;
    EXPECT_FALSE(written.says("'particleTemperature'")) << written.output;

    TestCase second;
    prepare(second);
    second.dem.readRestart = (first.path() / "DEM/end.restart").string();
    second.coupling().set("energy/particleTemperature", coldTemperature);
    const Outcome read = second.run();
    ASSERT_TRUE(read.succeeded()) << read.output;
    EXPECT_TRUE(
        read.says("entry 'particleTemperature' of energy in constant/couplingProperties, 300 K, is for all others"))
        << read.output;
    EXPECT_GT(heat(second, "heatInParticles"), 0.99 * heat(first, "heatInParticles"));
}

} // namespace clepsydra::tests
