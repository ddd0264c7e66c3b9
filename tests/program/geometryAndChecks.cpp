/// \file
/// What a user meets at the edges of mesh, bed and fluid: particles that leave the mesh, that come in on top of others,
/// that move with the water, beds that are low for their smoothing, thin cells, long arms.

#include <gmock/gmock.h>

#include "support/testCase.h"

#include <gtest/gtest.h>

namespace clepsydra::tests
{

namespace
{

constexpr double interval = 1e-3;

/// Water that rises in a box through which particles of its density move with it; the DEM box goes on above the mesh.
void upwards(TestCase& test, double waterSpeed)
{
    test.box.upper = {0.01, 0.01, 0.02};
    test.cells = {5, 5, 10};
    test.setThroughFlow("uniform (0 0 " + std::to_string(waterSpeed) + ')');
    test.file("0/U").set("internalField", "uniform (0 0 " + std::to_string(waterSpeed) + ')');
    test.coupling().set("constDiffSmoothingProps/bandwidth", "3e-3");
    test.dem.diameter = 0.001;
    test.dem.density = 1000;
    test.dem.timeStep = 1e-5;
    test.dem.particles = simpleLattice(Box{{0, 0, 0.01}, {0.01, 0.01, 0.014}}, {2, 2, 1});
    test.dem.more = "velocity all set 0 0 0.1 units box";
    test.setTimes(0.02, interval, 0.02);
}

/// The DEM box and its walls reach so far above the mesh that no particle is lost.
void openAbove(TestCase& test)
{
    Box tall = test.box;
    tall.upper.z() = 0.05;
    test.extraFiles["DEM/in.particles"] = test.dem.text(tall);
}

/// Lines that insert spheres at rest, every 200 DEM steps, into a region that another line defines.
std::string insertion(
    const std::string& radius, const std::string& count, const std::string& checked, const std::string& region)
{
    return "fix sphere all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius constant " + radius
           + "\nfix spheres all particledistribution/discrete 32452843 1 sphere 1.0\n"
             "fix feed all insert/rate/region seed 86028121 distributiontemplate spheres nparticles "
           + count + " particlerate 500 insert_every 200 overlapcheck " + checked + " all_in " + checked
           + " vel constant 0. 0. 0. region " + region + '\n';
}

} // namespace

/// A particle as heavy as the water that moves exactly with it: nothing is exchanged but rounding, of drag times velocity.
/// Relative to what is exchanged that rounding is everything, and stopped the run.
TEST(GeometryAndChecks, ParticlesThatMoveWithTheWaterRun)
{
    TestCase test;
    upwards(test, 0.1);
    test.setTimes(0.005, interval, 0.005);
    const Outcome outcome = test.run();
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
    EXPECT_LT(test.conservationSummary()["momentumError"].get<double>(), 1e-9);
}

/// The fluid passes 1.5 cells in a coupling step. Gas does so before its particles travel far, and nothing was said.
TEST(GeometryAndChecks, AFluidThatPassesMoreThanACellInACouplingStepIsWarnedOf)
{
    for (const bool fast : {true, false})
    {
        TestCase test;
        upwards(test, fast ? 3 : 1);
        test.setFluid(1.2, 1.5e-5);
        test.dem.fixed = true;
        test.setTimes(2 * interval, interval, 2 * interval);
        const Outcome outcome = test.run();
        EXPECT_TRUE(outcome.succeeded()) << outcome.output;
        EXPECT_EQ(outcome.says("The fluid passes more than a cell in a coupling step"), fast) << outcome.output;
        EXPECT_EQ(outcome.says("WARNING: the fluid passed more than a cell (Courant number above 1) in 2 of 2"), fast);
    }
}

/// Sand of 0.5 mm in air stops the air in 0.1 ms: the explicit reaction to drag is stable for coupling steps up to twice
/// that time. Longer ones ended with numbers that are no velocities, without a word on the reason.
TEST(GeometryAndChecks, ExplicitCouplingWithLongCouplingStepsIsWarnedOf)
{
    for (const bool longSteps : {true, false})
    {
        TestCase test;
        test.box.upper = {2.48084e-3, 2.48084e-3, 4.96168e-3};
        test.cells = {2, 2, 4};
        test.setFluid(1.2, 1.5e-5);
        test.setThroughFlow("uniform (0 0 0.2)");
        test.dem.diameter = 5e-4;
        test.dem.particles = bodyCentredLattice(test.box, {4, 4, 8});
        test.dem.fixed = true;
        test.dem.timeStep = 1e-6;
        test.coupling().set("momCoupleModels", "(explicitCouple)").set("constDiffSmoothingProps/bandwidth", "1.5e-3");
        test.coupling().set("forceModels", "(GidaspowDrag gradPForce viscForce Archimedes)");
        const double step = longSteps ? 1e-3 : 2e-5;
        test.setTimes(3 * step, step, 3 * step);
        const Outcome outcome = test.run();
        EXPECT_EQ(outcome.says("With momCoupleModels (explicitCouple)"), longSteps) << outcome.output;
        EXPECT_TRUE(longSteps || outcome.succeeded()) << outcome.output;
    }
}

/// In this bed Zuber's added mass is 2.8 times the mass of the fluid between the particles, so that its explicit reaction grows
/// from step to step. Such a run ended after a hundred steps, with words on the pressure's tolerance only.
TEST(GeometryAndChecks, ExplicitReactionToALargeAddedMassIsWarnedOf)
{
    for (const std::string law : {"Zuber", "constant"})
    {
        TestCase test;
        test.box.upper = {2.48084e-3, 2.48084e-3, 4.96168e-3};
        test.cells = {2, 2, 4};
        test.setThroughFlow("uniform (0 0 0.001)");
        test.dem.diameter = 5e-4;
        test.dem.particles = bodyCentredLattice(test.box, {4, 4, 8});
        test.dem.fixed = true;
        test.dem.timeStep = 1e-6;
        test.coupling()
            .set("momCoupleModels", "(explicitCouple)")
            .set("constDiffSmoothingProps/bandwidth", "1.5e-3")
            .set("forceModels", "(StokesDrag gradPForce viscForce Archimedes virtualMassForce)")
            .set("virtualMassForceProps/law", law);
        test.setTimes(4e-5, 2e-5, 4e-5);
        const Outcome outcome = test.run();
        EXPECT_TRUE(outcome.succeeded()) << outcome.output;
        EXPECT_EQ(outcome.says("the reaction to the particles' added mass"), law == "Zuber") << outcome.output;
    }
}

/// Drag is explicit in the DEM step, so a step of more than two relaxation times, 0.11 ms for 20 um in water, turns the slip
/// into a larger one in each step. Contacts set a limit of the step that is usually shorter, but not for such particles. In the
/// 50 steps of one coupling step the particle would leave the box.
TEST(GeometryAndChecks, ADemStepThatIsTooLongForTheDragIsRefused)
{
    for (const bool tooLong : {true, false})
    {
        TestCase test;
        test.cells = {4, 4, 8};
        test.coupling()
            .set("forceModels", "(StokesDrag gradPForce viscForce Archimedes)")
            .set("DEM/maxRayleighFraction", "1000");
        test.dem.diameter = 2e-5;
        test.dem.timeStep = tooLong ? 2e-4 : 5e-5;
        test.dem.more = "atom_modify sort 0 0\nneigh_modify binsize 1e-3\n"; // the box is a thousand diameters wide
        test.dem.particles = {{0.0101, 0.0099, 0.02}};
        test.setTimes(2e-2, 1e-2, 2e-2);
        const Outcome outcome = test.run();
        EXPECT_EQ(outcome.succeeded(), !tooLong) << outcome.output;
        EXPECT_EQ(outcome.says("but the DEM step is 0.0002 s; allowed: a timestep in DEM/in.particles"), tooLong)
            << outcome.output;
    }
}

/// A low-pass filter over 10 coupling steps of 2 ms, each 16 relaxation times of sand of 0.1 mm in a dense bed in water, may let
/// errors grow. Sand of 2 mm has 0.1 relaxation times.
TEST(GeometryAndChecks, AFilterBesideCouplingStepsOfManyRelaxationTimesIsWarnedOf)
{
    for (const bool fine : {true, false})
    {
        const double diameter = fine ? 1e-4 : 2e-3;
        TestCase test;
        test.box.upper = diameter * Eigen::Vector3d(4.9, 4.9, 24.6);
        test.cells = {2, 2, 10};
        Box bed = test.box;
        bed.upper.z() = 9.8 * diameter;
        test.dem.diameter = diameter;
        test.dem.particles = bodyCentredLattice(bed, {4, 4, 8});
        test.dem.timeStep = fine ? 2e-6 : 2e-5;
        test.coupling()
            .set("forceModels", "(GidaspowDrag gradPForce viscForce Archimedes)")
            .set("constDiffSmoothingProps/bandwidth", 1.5 * diameter)
            .set("useDDTvoidfractionProps/smoothingTime", "0.02");
        test.setTimes(6e-3, 2e-3, 6e-3);
        const Outcome outcome = test.run();
        EXPECT_TRUE(outcome.succeeded()) << outcome.output;
        EXPECT_EQ(outcome.says("relaxation times of a particle in a dense bed"), fine) << outcome.output;
    }
}

/// Two layers of thin cells in a box of coarse ones make the smoothing ten times as expensive.
TEST(GeometryAndChecks, ThinCellsAreWarnedOf)
{
    TestCase test;
    test.box.upper = {0.02, 0.02, 0.04};
    test.dem.particles = {{0.01, 0.01, 0.01}};
    test.setTimes(2 * interval, interval, 2 * interval);
    EXPECT_FALSE(test.run().says("sweeps over the mesh in every coupling step because"));

    TestCase thin;
    thin.box = test.box;
    thin.dem.particles = test.dem.particles;
    thin.setTimes(2 * interval, interval, 2 * interval);
    thin.write();
    const Outcome outcome = thin.runCommand(
        "sed -i 's/simpleGrading (1 1 1)/simpleGrading (1 1 200)/' system/blockMeshDict && blockMesh && "
        "$SOLVER");
    EXPECT_TRUE(outcome.says("sweeps over the mesh in every coupling step because")) << outcome.output;
}

/// A bed of three bandwidths with clear water around it has half of its drag; one of twelve has not.
TEST(GeometryAndChecks, ALowBedIsWarnedOf)
{
    for (const bool low : {true, false})
    {
        TestCase test;
        test.box.upper = {0.01, 0.01, 0.04};
        test.cells = {10, 10, 40};
        test.coupling().set("constDiffSmoothingProps/bandwidth", low ? "3e-3" : "1e-3");
        test.dem.diameter = 0.001;
        test.dem.fixed = true;
        test.dem.timeStep = 1e-5;
        test.dem.particles = simpleLattice(Box{{0, 0, 0.01}, {0.01, 0.01, 0.021}}, {9, 9, 10});
        test.setTimes(2 * interval, interval, 2 * interval);
        const Outcome outcome = test.run();
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
        EXPECT_EQ(outcome.says("is within a smoothing bandwidth of clear fluid"), low) << outcome.output;
    }
}

/// Three arms of 26 m with 2 x 2 cells of 20 mm: memory in proportion to the cells, 2 GB of address space and not the bins
/// of the box around the arms.
TEST(GeometryAndChecks, LongArmsNeedMemoryForTheirCellsOnly)
{
    TestCase test;
    test.box.upper = {0.04, 0.04, 0.04};
    test.coupling().set("constDiffSmoothingProps/bandwidth", "4e-2");
    test.dem.particles = {{0.01, 0.011, 0.012}};
    test.setTimes(2 * interval, interval, 2 * interval);
    test.extraFiles["system/blockMeshDict"] =
        "FoamFile { version 2.0; format ascii; class dictionary; object blockMeshDict; }\n"
        "scale 1; w 0.04; L 26; n 1298;\n"
        "vertices ( (0 0 0) ($w 0 0) ($w $w 0) (0 $w 0) (0 0 $w) ($w 0 $w) ($w $w $w) (0 $w $w)\n"
        " ($L 0 0) ($L $w 0) ($L 0 $w) ($L $w $w) (0 $L 0) ($w $L 0) (0 $L $w) ($w $L $w)\n"
        " (0 0 $L) ($w 0 $L) ($w $w $L) (0 $w $L) );\n"
        "blocks ( hex (0 1 2 3 4 5 6 7) (2 2 2) simpleGrading (1 1 1)\n"
        " hex (1 8 9 2 5 10 11 6) ($n 2 2) simpleGrading (1 1 1)\n"
        " hex (3 2 13 12 7 6 15 14) (2 $n 2) simpleGrading (1 1 1)\n"
        " hex (4 5 6 7 16 17 18 19) (2 2 $n) simpleGrading (1 1 1) );\n"
        "defaultPatch { name walls; type wall; } boundary ();\n";
    const Outcome outcome = test.runCommand("ulimit -v 2000000; blockMesh > log.blockMesh 2>&1 && $SOLVER");
    EXPECT_TRUE(outcome.succeeded()) << outcome.output;
}

/// A particle that leaves where no outlet is listed: the message says which one, how fast, through which patch, and both words
/// that would allow it.
TEST(GeometryAndChecks, AParticleThatLeavesTheMeshIsNamedWithItsPatch)
{
    TestCase test;
    upwards(test, 0.1);
    test.setTimes(0.2, interval, 0.2);
    openAbove(test);
    const Outcome outcome = test.run();
    EXPECT_FALSE(outcome.succeeded());
    for (const char* word : {"Particle 1 at", "lies in no cell of the mesh", "m/s", "beyond patch 'outlet'",
             "particleOutlets", "allowParticlesOutsideMesh"})
    {
        EXPECT_THAT(outcome.output, testing::HasSubstr(word));
    }
}

/// With the word, they move on in the part of the DEM box that has no mesh, feel no water, and are counted; one that has begun
/// there falls back into the mesh. All balances close.
TEST(GeometryAndChecks, ParticlesOutsideTheMeshMayBeAllowed)
{
    for (const int ranks : {1, 2})
    {
        TestCase test;
        upwards(test, 0.1);
        test.coupling().set("allowParticlesOutsideMesh", "yes");
        test.dem.dumpEvery = 100;
        // It falls from above the mesh into it.
        test.dem.particles.emplace_back(0.005, 0.005, 0.022);
        openAbove(test);
        test.setTimes(0.15, interval, 0.15);
        const Outcome outcome = test.run(ranks);
        ASSERT_TRUE(outcome.succeeded()) << outcome.output;
        const auto balances = test.conservationSummary();
        EXPECT_EQ(balances["particlesLost"], 0);
        EXPECT_EQ(balances["particlesEnd"], 5);
        EXPECT_GE(balances["particlesThatLeftMesh"], 4);
        EXPECT_LT(balances["insertionError"].get<double>(), 1e-12);
        EXPECT_LT(balances["momentumError"].get<double>(), 1e-9);
        // The fifth begins at the others' upward 0.1 m/s: without water it falls freely until it is back in the mesh.
        const ParticleSnapshot early = test.particleHistory().at(10);
        EXPECT_NEAR(early.velocity(2, 4), 0.1 - 9.81 * 0.01, 1e-3);
    }
}

/// A particle that is inserted on top of another is refused as at the start: otherwise their contact force throws both out.
TEST(GeometryAndChecks, AnInsertionOnTopOfAnotherParticleIsRefused)
{
    TestCase test;
    test.dem.particles = {{0.01, 0.01, 0.001}};
    test.setTimes(0.02, interval, 0.02);
    test.dem.more = "region spot block 0.0098 0.0102 0.0098 0.0102 0.0005 0.0015 units box\n"
                    + insertion("0.001", "INF", "no", "spot");
    const Outcome outcome = test.run();
    EXPECT_FALSE(outcome.succeeded());
    EXPECT_THAT(outcome.output, testing::HasSubstr("allowed at the start and at an insertion"));
}

/// Particles ten times smaller than the first, for which the DEM step is too long, are inserted later: refused at the next
/// written time at the latest. The step was checked for the first particles only.
TEST(GeometryAndChecks, ADemStepTooLongForInsertedParticlesIsRefused)
{
    TestCase test;
    test.dem.particles = {{0.01, 0.01, 0.001}};
    test.setTimes(0.04, interval, 0.02);
    test.dem.more = "region top block 0.005 0.015 0.005 0.015 0.03 0.038 units box\n"
                    + insertion("0.0001", "3", "yes", "top") + "fix integrate all nve/sphere\n";
    const Outcome outcome = test.run();
    EXPECT_FALSE(outcome.succeeded());
    EXPECT_THAT(outcome.output, testing::HasSubstr("of the Rayleigh time"));
    EXPECT_THAT(outcome.output, testing::HasSubstr("Time = 0.01\n")) << "not refused at the start";
}

} // namespace clepsydra::tests
