#include "support/testCase.h"
#include "tokens/exactText.h"

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <numeric>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace clepsydra::tests
{

namespace
{

std::filesystem::path freshFolder()
{
    std::string name = "clepsydra";
    if (const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info())
    {
        name += std::string("-") + test->test_suite_name() + '.' + test->name();
    }
    std::replace(name.begin(), name.end(), '/', '-');
    std::string pattern = (std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string();
    if (!mkdtemp(pattern.data()))
    {
        throw std::runtime_error("cannot make the folder " + pattern);
    }
    return pattern;
}

void writeText(const std::filesystem::path& file, const std::string& text)
{
    std::filesystem::create_directories(file.parent_path());
    std::ofstream os(file);
    os << text;
    if (!os.flush())
    {
        throw std::runtime_error("cannot write " + file.string());
    }
}

std::string quoted(const std::string& text)
{
    return '\'' + std::regex_replace(text, std::regex("'"), R"('\'')") + '\'';
}

} // namespace

TestCase::TestCase()
    : path_(freshFolder())
{
    file("system/controlDict")
        .set("application", "pimpleDemFoam")
        .set("startFrom", "latestTime")
        .set("startTime", "0")
        .set("stopAt", "endTime")
        .set("writeControl", "runTime")
        .set("writeFormat", "ascii")
        .set("writePrecision", "16");
    setTimes(0.1, 1e-3, 0.05);

    file("system/fvSchemes")
        .set("ddtSchemes/default", "Euler")
        .set("gradSchemes/default", "Gauss linear")
        .set("divSchemes/default", "Gauss linear")
        .set("divSchemes/div(phi,U)", "Gauss linearUpwind grad(U)")
        .set("laplacianSchemes/default", "Gauss linear corrected")
        .set("interpolationSchemes/default", "linear")
        .set("snGradSchemes/default", "corrected");

    const std::string pressureSolver = "{ solver PCG; preconditioner DIC; tolerance 1e-10; relTol 0; }";
    file("system/fvSolution")
        .set("solvers/p", pressureSolver)
        .set("solvers/pFinal", pressureSolver)
        .set("solvers/\"U|UFinal\"", "{ solver smoothSolver; smoother symGaussSeidel; tolerance 1e-10; relTol 0; }")
        .set("PIMPLE/nOuterCorrectors", "1")
        .set("PIMPLE/nCorrectors", "2")
        .set("PIMPLE/nNonOrthogonalCorrectors", "0")
        .set("PIMPLE/pRefCell", "0")
        .set("PIMPLE/pRefValue", "0");

    file("constant/couplingProperties")
        .set("fluid", "incompressible")
        .set("modelType", "A")
        .set("voidFractionModel", "divided")
        .set("smoothingModel", "constDiffSmoothing")
        .set("constDiffSmoothingProps/bandwidth", "6e-3")
        .set("forceModels", "(DiFeliceDrag gradPForce viscForce Archimedes)")
        .set("momCoupleModels", "(implicitCouple)")
        .set("DEM/engine", "liggghts")
        .set("DEM/script", "\"DEM/in.particles\"");

    setFluid(1000, 1e-6);

    files_["constant/g"] = FoamFile("uniformDimensionedVectorField");
    file("constant/g").set("dimensions", "[0 1 -2 0 0 0 0]").set("value", "(0 0 -9.81)");

    files_["0/U"] = FoamFile("volVectorField");
    file("0/U")
        .set("dimensions", "[0 1 -1 0 0 0 0]")
        .set("internalField", "uniform (0 0 0)")
        .set("boundaryField/walls/type", "noSlip");

    files_["0/p"] = FoamFile("volScalarField");
    file("0/p")
        .set("dimensions", "[0 2 -2 0 0 0 0]")
        .set("internalField", "uniform 0")
        .set("boundaryField/walls/type", "zeroGradient");
}

TestCase::~TestCase()
{
    if (testing::Test::HasFailure() || std::getenv("CLEPSYDRA_KEEP_CASES"))
    {
        std::cout << "The case is kept: " << path_.string() << std::endl;
        return;
    }
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

void TestCase::setTimes(double endTime, double deltaT, double writeInterval)
{
    control().set("endTime", endTime).set("deltaT", deltaT).set("writeInterval", writeInterval);
    coupling().set("couplingTimeStep", deltaT);
}

void TestCase::setFluid(double density, double kinematicViscosity)
{
    transport().set("rho", density).set("nu", kinematicViscosity);
}

void TestCase::setThroughFlow(const std::string& velocity, const std::string& type)
{
    throughFlow_ = true;
    const std::string valueName = type == "fixedValue" ? "value" : "uniformValue";
    file("0/U")
        .set("boundaryField/walls/type", "slip")
        .set("boundaryField/inlet/type", type)
        .set("boundaryField/inlet/" + valueName, velocity)
        .set("boundaryField/outlet/type", "zeroGradient");
    file("0/p")
        // Drag acts right at the inlet: its share of the pressure gradient belongs to the boundary face as well.
        .set("boundaryField/inlet/type", "fixedFluxExtrapolatedPressure")
        .set("boundaryField/outlet/type", "fixedValue")
        .set("boundaryField/outlet/value", "uniform 0");
}

std::string TestCase::blockMeshDict() const
{
    std::ostringstream os;
    os << FoamFile().text("blockMeshDict") << "scale 1;\nvertices\n(\n";
    for (const double z : {box.lower.z(), box.upper.z()})
    {
        os << vectorText({box.lower.x(), box.lower.y(), z}) << vectorText({box.upper.x(), box.lower.y(), z})
           << vectorText({box.upper.x(), box.upper.y(), z}) << vectorText({box.lower.x(), box.upper.y(), z}) << '\n';
    }
    os << ");\nblocks (hex (0 1 2 3 4 5 6 7) (" << cells.x() << ' ' << cells.y() << ' ' << cells.z()
       << ") simpleGrading (1 1 1));\nedges ();\nboundary\n(\n";
    const std::array<std::array<std::string, 2>, 3> ends = {
        {{"(0 4 7 3)", "(1 2 6 5)"}, {"(0 1 5 4)", "(3 7 6 2)"}, {"(0 3 2 1)", "(4 5 6 7)"}}};
    const auto& [bottom, top] = ends[2];
    std::string walls;
    for (std::size_t axis = 0; axis < ends.size(); ++axis)
    {
        if (box.periodic[axis])
        {
            const std::string low = std::string(1, "xyz"[axis]) + "Low";
            const std::string high = std::string(1, "xyz"[axis]) + "High";
            os << low << " { type cyclic; neighbourPatch " << high << "; faces (" << ends[axis][0] << "); }\n"
               << high << " { type cyclic; neighbourPatch " << low << "; faces (" << ends[axis][1] << "); }\n";
        }
        else if (axis < 2 || !throughFlow_)
        {
            walls += ends[axis][0] + ends[axis][1];
        }
    }
    if (!walls.empty())
    {
        os << "walls { type wall; faces (" << walls << "); }\n";
    }
    if (throughFlow_)
    {
        os << "inlet { type patch; faces (" << bottom << "); }\noutlet { type patch; faces (" << top << "); }\n";
    }
    os << ");\n";
    return os.str();
}

void TestCase::write()
{
    if (const auto& along = box.periodic; along[0] || along[1] || along[2])
    {
        for (const char* field : {"0/U", "0/p"})
        {
            if (files_.count(field) > 0)
            {
                file(field).set("boundaryField/\"[xyz](Low|High)\"/type", "cyclic");
            }
        }
    }
    for (const auto& [name, dictionary] : files_)
    {
        writeText(path_ / name, dictionary.text(std::filesystem::path(name).filename().string()));
    }
    writeText(path_ / "system/blockMeshDict", blockMeshDict());
    writeText(path_ / "DEM/in.particles", dem.text(box));
    for (const auto& [name, text] : extraFiles)
    {
        writeText(path_ / name, text);
    }
    written_ = true;
}

std::string TestCase::sameFile(const std::string& file, const TestCase& other)
{
    return "cmp " + quoted(file) + ' ' + quoted((other.path() / file).string());
}

std::string TestCase::sameCheckpoint(const std::string& time, const TestCase& other)
{
    const std::string manifest = "checkpoints/" + time + "/complete";
    const auto contents = [](const std::string& file) {
        return "\"$(sed -E '/^run |^input |uniform.checkpoint$|^end /d' " + quoted(file) + ")\"";
    };
    return "[ -s " + manifest + " ] && [ " + contents(manifest) + " = " + contents((other.path() / manifest).string())
           + " ]";
}

Outcome TestCase::runCommand(const std::string& command)
{
    if (!written_)
    {
        write();
    }
    const std::string line = "cd " + quoted(path_.string()) + " && SOLVER=" + quoted(PIMPLE_DEM_FOAM)
                             + " && export SOLVER && " + quoted(IN_ENVIRONMENT) + ' ' + quoted(OPENFOAM_ROOT)
                             + " sh -c " + quoted(command) + " 2>&1";
    const auto start = std::chrono::steady_clock::now();

    FILE* pipe = popen(line.c_str(), "r");
    if (!pipe)
    {
        throw std::runtime_error("cannot run " + line);
    }
    Outcome outcome;
    std::array<char, 4096> buffer;
    for (std::size_t count; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    {
        outcome.output.append(buffer.data(), count);
    }
    const int status = pclose(pipe);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    outcome.wallSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return outcome;
}

Outcome TestCase::makeMesh()
{
    return runCommand("blockMesh");
}

void TestCase::divideAmong(int ranks)
{
    file("system/decomposeParDict")
        .set("numberOfSubdomains", exactText(ranks))
        .set("method", "simple")
        .set("simpleCoeffs/n", '(' + exactText(ranks) + " 1 1)")
        .set("simpleCoeffs/delta", "0.001");
}

Outcome TestCase::run(int ranks)
{
    if (ranks > 1 && files_.find("system/decomposeParDict") == files_.end())
    {
        divideAmong(ranks);
        written_ = false;
    }
    if (!std::filesystem::exists(path_ / "constant/polyMesh/faces"))
    {
        Outcome mesh = makeMesh();
        if (!mesh.succeeded())
        {
            return mesh;
        }
    }
    if (ranks == 1)
    {
        return runCommand("$SOLVER");
    }
    Outcome decomposed = runCommand("decomposePar -force");
    if (!decomposed.succeeded())
    {
        return decomposed;
    }
    Outcome solved = runCommand("mpirun -np " + exactText(ranks) + " $SOLVER -parallel");
    if (solved.succeeded())
    {
        Outcome reconstructed = runCommand("reconstructPar");
        // A run without fluid has no fields to put together.
        if (!reconstructed.succeeded() && !reconstructed.says("No times selected"))
        {
            return reconstructed;
        }
    }
    return solved;
}

nlohmann::json TestCase::conservationSummary(const std::string& startTime) const
{
    std::ifstream is(path_ / "postProcessing/conservation" / startTime / "summary.json");
    if (!is)
    {
        throw std::runtime_error("no summary of the conservation check in " + path_.string());
    }
    return nlohmann::json::parse(is);
}

std::vector<ParticleSnapshot> TestCase::particleHistory() const
{
    std::ifstream is(path_ / "DEM/particles.dump");
    if (!is)
    {
        throw std::runtime_error("no DEM/particles.dump in " + path_.string());
    }
    std::vector<ParticleSnapshot> history;
    Eigen::Index count = 0;
    for (std::string line; std::getline(is, line);)
    {
        if (line == "ITEM: TIMESTEP")
        {
            std::getline(is, line);
            history.emplace_back();
            history.back().step = std::stol(line);
        }
        else if (line == "ITEM: NUMBER OF ATOMS")
        {
            std::getline(is, line);
            count = std::stol(line);
        }
        else if (line.compare(0, 11, "ITEM: ATOMS") == 0)
        {
            ParticleSnapshot& particles = history.back();
            particles.position.resize(3, count);
            particles.velocity.resize(3, count);
            for (Eigen::Index i = 0; i < count && std::getline(is, line); ++i)
            {
                std::istringstream row(line);
                particles.id.emplace_back();
                row >> particles.id.back();
                for (Eigen::Index axis = 0; axis < 3; ++axis)
                {
                    row >> particles.position(axis, i);
                }
                for (Eigen::Index axis = 0; axis < 3; ++axis)
                {
                    row >> particles.velocity(axis, i);
                }
            }
        }
    }
    return history;
}

Eigen::MatrixXd TestCase::field(const std::string& name, const std::string& time) const
{
    const Eigen::MatrixXd values = readInternalField(path_ / time / name);
    const Eigen::Index cellCount = cells.prod();
    return values.cols() == 1 && cellCount > 1 ? Eigen::MatrixXd(values.replicate(1, cellCount)) : values;
}

std::vector<std::string> TestCase::times() const
{
    std::vector<std::pair<double, std::string>> found;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
    {
        const std::string name = entry.path().filename().string();
        char* end = nullptr;
        const double value = std::strtod(name.c_str(), &end);
        if (entry.is_directory() && *end == '\0' && value > 0)
        {
            found.emplace_back(value, name);
        }
    }
    std::sort(found.begin(), found.end());
    std::vector<std::string> names;
    names.reserve(found.size());
    for (const auto& time : found)
    {
        names.push_back(time.second);
    }
    return names;
}

std::vector<std::vector<double>> TestCase::table(const std::string& file) const
{
    std::ifstream is(path_ / file);
    if (!is)
    {
        throw std::runtime_error("no " + file + " in " + path_.string());
    }
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(is, line);)
    {
        if (line.empty() || line[0] == '#')
        {
            continue;
        }
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == '(' || c == ')'; }, ' ');
        std::istringstream numbers(line);
        rows.emplace_back();
        for (double value; numbers >> value;)
        {
            rows.back().push_back(value);
        }
    }
    return rows;
}

Eigen::VectorXd TestCase::layerMeans(const std::string& name, const std::string& time, Eigen::Index component) const
{
    const Eigen::MatrixXd values = field(name, time);
    const Eigen::Index perLayer = cells.x() * cells.y();
    Eigen::VectorXd means(cells.z());
    for (Eigen::Index k = 0; k < cells.z(); ++k)
    {
        means[k] = values.row(component).segment(k * perLayer, perLayer).mean();
    }
    return means;
}

} // namespace clepsydra::tests
