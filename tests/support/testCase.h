#pragma once

#include "support/demScript.h"
#include "support/foamFile.h"

#include <nlohmann/json.hpp>

#include <Eigen/Dense>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace clepsydra::tests
{

/// How a program ended.
struct Outcome
{
    int status = -1;
    std::string output; // stdout and stderr together
    double wallSeconds = 0;

    bool succeeded() const
    {
        return status == 0;
    }

    bool says(const std::string& text) const
    {
        return output.find(text) != std::string::npos;
    }
};

/// One entry of DEM/particles.dump, particles in the order of their ids.
struct ParticleSnapshot
{
    long step = 0;
    std::vector<long> id;
    Eigen::Matrix3Xd position;
    Eigen::Matrix3Xd velocity;
};

/// A small case of pimpleDemFoam in a fresh temporary folder: a box of water between walls with particles in it, complete
/// and ready to run. A test changes what it is about:
///
///     TestCase test;
///     test.box.upper = {0.04, 0.04, 0.08};
///     test.cells = {10, 10, 20};
///     test.dem.particles = {{0.02, 0.02, 0.07}};
///     test.coupling().set("forceModels", "(SchillerNaumannDrag gradPForce viscForce Archimedes)");
///     test.setTimes(0.2, 1e-3, 0.05);
///     const Outcome outcome = test.run();
///     ASSERT_TRUE(outcome.succeeded()) << outcome.output;
///
/// The folder is removed at the end, unless the test failed or CLEPSYDRA_KEEP_CASES is set; then its name is printed.
class TestCase
{
public:
    TestCase();
    ~TestCase();
    TestCase(const TestCase&) = delete;
    TestCase& operator=(const TestCase&) = delete;

    // What the case consists of

    Box box;
    Eigen::Vector3i cells = {8, 8, 16};
    DemScript dem;
    /// Written as they are, after everything else: path in the case -> text.
    std::map<std::string, std::string> extraFiles;

    FoamFile& coupling()
    {
        return file("constant/couplingProperties");
    }

    FoamFile& transport()
    {
        return file("constant/transportProperties");
    }

    FoamFile& control()
    {
        return file("system/controlDict");
    }

    FoamFile& solution()
    {
        return file("system/fvSolution");
    }

    /// Any dictionary of the case by its path: "system/fvSchemes", "0/U", ...
    FoamFile& file(const std::string& path)
    {
        return files_[path];
    }

    /// Leaves a dictionary out.
    void removeFile(const std::string& path)
    {
        files_.erase(path);
    }

    void setTimes(double endTime, double deltaT, double writeInterval);
    void setFluid(double density, double kinematicViscosity);

    /// Patches `inlet` (bottom) and `outlet` (top) instead of walls there; sides that let the fluid slip.
    /// \param velocity  upwards, as the value of U's inlet condition: "uniform (0 0 0.01)", "table (...)"
    /// \param type  of U's inlet condition: fixedValue, uniformFixedValue
    void setThroughFlow(const std::string& velocity, const std::string& type = "fixedValue");

    /// system/decomposeParDict: boxes of equal width beside each other along x, one for each rank.
    void divideAmong(int ranks);

    // Running it

    /// Writes everything; run() and runProgram() do it by themselves, once.
    void write();

    /// blockMesh, decomposePar where there are several ranks, the solver, reconstructPar.
    /// Returns the solver's outcome, or that of the first program that failed.
    Outcome run(int ranks = 1);

    /// The mesh only.
    Outcome makeMesh();

    /// Any command line in the case's folder and in OpenFOAM's environment; $SOLVER is pimpleDemFoam.
    Outcome runCommand(const std::string& command);

    // Reading what it has written

    const std::filesystem::path& path() const
    {
        return path_;
    }

    /// postProcessing/conservation/<startTime>/summary.json
    nlohmann::json conservationSummary(const std::string& startTime = "0") const;

    /// DEM/particles.dump, all entries.
    std::vector<ParticleSnapshot> particleHistory() const;

    /// Components x cells; cells in blockMesh's order, x fastest, then y, then z.
    Eigen::MatrixXd field(const std::string& name, const std::string& time) const;

    /// A shell condition that a file of the folder in which it is evaluated is that of another case, to the last bit.
    static std::string sameFile(const std::string& file, const TestCase& other);

    /// A shell condition that the folder in which it is evaluated, this case or a copy, has a checkpoint of a time with the
    /// same contents as that of another case, to the last bit. Only the random identifiers and the inputs may differ.
    static std::string sameCheckpoint(const std::string& time, const TestCase& other);

    /// The times that were written, as folders are called, without "0", in order.
    std::vector<std::string> times() const;

    /// Rows of a table with # comments, such as postProcessing/massInHopper/0/massInHopper.dat. Brackets are ignored.
    std::vector<std::vector<double>> table(const std::string& file) const;

    /// Middle of the cells' layers along z.
    double layerHeight(int k) const
    {
        return box.lower.z() + (k + 0.5) * box.size().z() / cells.z();
    }

    /// Mean of one component of a field over each layer of cells along z.
    Eigen::VectorXd layerMeans(const std::string& name, const std::string& time, Eigen::Index component = 0) const;

private:
    std::string blockMeshDict() const;

    std::filesystem::path path_;
    std::map<std::string, FoamFile> files_;
    bool throughFlow_ = false;
    bool written_ = false;
};

} // namespace clepsydra::tests
