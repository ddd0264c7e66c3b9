#pragma once

#include "support/testCase.h"

namespace clepsydra::tests
{

/// Coupling step of pilingParticles() [s].
inline constexpr double interval = 1e-3;

/// 72 particles that fall and pile up on a floor: contacts with particles and walls, friction and its history. The
/// lowest come to rest for good. With fluid each has the history of its motion, and its drag depends on the sizes
/// around it.
inline void pilingParticles(TestCase& test, bool fluid)
{
    test.box.upper = {0.012, 0.012, 0.024};
    test.cells = {6, 6, 12};
    test.dem.particles = simpleLattice(Box{{0, 0, 0}, {0.012, 0.012, 0.02}}, {4, 4, 5});
    jitter(test.dem.particles, 2e-4, 11);
    test.dem.timeStep = 4e-5;
    test.dem.dumpEvery = 250;
    test.dem.fixed = true;
    test.dem.more = "group moving union all\ngroup resting initialize\nneigh_modify exclude group resting resting\n"
                    "fix integrate moving nve/sphere\n";
    test.coupling()
        .set("DEM/groupChanges/atRest/from", "moving")
        .set("DEM/groupChanges/atRest/to", "resting")
        .set("DEM/groupChanges/atRest/below", "5e-3")
        .set("DEM/groupChanges/atRest/slowerThan", "2e-2")
        .set("DEM/groupChanges/atRest/during", "0.01");
    test.setFluid(1000, 1e-6);
    test.coupling().set("forceModels", "(DiFeliceDrag gradPForce viscForce Archimedes virtualMassForce historyForce)");
    test.coupling().set("DiFeliceDragProps/polydispersity", "Beetstra");
    test.control()
        .set("startFrom", "latestTime")
        .set("writeFormat", "binary")
        .set("functions/massInHopper/type", "massInHopper")
        .set("functions/massInHopper/patch", "walls");
    if (!fluid)
    {
        test.coupling().set("fluid", "none");
    }
}

/// All rows of the table postProcessing/<name>, the parts of a resumed run joined in the order of their start times.
inline std::vector<std::vector<double>> rowsOfTable(const TestCase& test, const std::string& name)
{
    std::map<double, std::filesystem::path> parts;
    for (const auto& part : std::filesystem::directory_iterator(test.path() / "postProcessing" / name))
    {
        parts[std::stod(part.path().filename())] = part.path();
    }
    std::vector<std::vector<double>> rows;
    for (const auto& [start, folder] : parts)
    {
        const auto part = test.table("postProcessing/" + name + '/' + folder.filename().string() + '/' + name + ".dat");
        rows.insert(rows.end(), part.begin(), part.end());
    }
    return rows;
}

/// All rows of m(t).
inline std::vector<std::vector<double>> massRows(const TestCase& test)
{
    return rowsOfTable(test, "massInHopper");
}

} // namespace clepsydra::tests
