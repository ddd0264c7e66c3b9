/// \file
/// A bed that rests and one that settles, in still water: what the pressure carries.

#include "bed.h"

#include <iostream>

namespace
{

using namespace clepsydra::tests;

TEST(RestingBed, StaysStill)
{
    TestCase test;
    test.dem.diameter = 0.002;
    test.dem.density = 2500;
    test.box.upper = {0.012, 0.012, 0.036};
    test.cells = {4, 4, 12};
    Box poured = test.box;
    poured.upper.z() = 0.024;
    test.dem.beads = simpleLattice(poured, {5, 5, 11});
    jitter(test.dem.beads, 5e-5, 1);
    const auto beads = static_cast<Eigen::Index>(test.dem.beads.size());
    test.dem.timeStep = 2e-5;
    test.dem.dumpEvery = 500;
    startFromRelaxedBed(test, 0.6);
    test.setTimes(0.2, 1e-3, 0.01);
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const auto history = test.beadHistory();
    std::cout << outcome.wallSeconds << " s, N " << beads << std::endl;
    for (const auto& s : history)
    {
        std::cout << s.step << ' ' << s.velocity.colwise().norm().maxCoeff() << ' ' << s.position.row(2).maxCoeff()
                  << ' ' << (s.position - history.front().position).colwise().norm().maxCoeff() << std::endl;
    }
    const double area = test.box.upper.x() * test.box.upper.y();
    const double weight = buoyantWeight(beads, 0.002, 2500, 1000) / area;
    for (const auto& t : test.times())
    {
        const Eigen::VectorXd p = 1000 * test.layerMeans("p", t);
        std::cout << t << " U " << test.field("U", t).colwise().norm().maxCoeff() << " dp " << p[0] - p[p.size() - 1]
                  << " of " << weight << std::endl;
    }
    std::cout << test.layerMeans("voidFraction", test.times().back()).transpose() << std::endl;
}

TEST(SettlingCloud, X)
{
    TestCase test;
    test.dem.diameter = 0.001;
    test.dem.density = 2500;
    test.setFluid(1000, 1e-5);
    test.box.upper = {0.008, 0.008, 0.04};
    test.cells = {4, 4, 20};
    test.file("0/U").set("boundaryField/walls/type", "slip");
    test.coupling().set("constDiffSmoothingProps/smoothingLength", 0.003);
    Box cloud = test.box;
    cloud.lower.z() = 0.018;
    cloud.upper.z() = 0.036;
    test.dem.beads = simpleLattice(cloud, {5, 5, 11});
    jitter(test.dem.beads, 5e-5, 1);
    const auto beads = static_cast<Eigen::Index>(test.dem.beads.size());
    test.dem.timeStep = 1e-5;
    test.dem.dumpEvery = 1000;
    test.setTimes(1.5, 1e-3, 0.01);
    const Outcome outcome = test.run();
    ASSERT_TRUE(outcome.succeeded()) << outcome.output;
    const auto history = test.beadHistory();
    const double area = test.box.upper.x() * test.box.upper.y();
    const double weight = buoyantWeight(beads, 0.001, 2500, 1000) / area;
    std::cout << outcome.wallSeconds << " s, N " << beads << std::endl;
    int i = 0;
    for (const auto& t : test.times())
    {
        const auto& s = history[++i];
        const Eigen::VectorXd p = 1000 * test.layerMeans("p", t);
        std::cout << t << " U " << test.field("U", t).colwise().norm().maxCoeff() << " dp " << p[0] - p[p.size() - 1]
                  << " of " << weight << " v " << s.velocity.row(2).mean() << ' ' << s.velocity.row(2).minCoeff() << ' '
                  << s.velocity.row(2).maxCoeff() << " z " << s.position.row(2).minCoeff() << ' '
                  << s.position.row(2).maxCoeff() << std::endl;
        if (i % 10 == 0)
            std::cout << test.layerMeans("voidFraction", t).transpose() << std::endl;
    }
}

} // namespace
