#include "quickHopper.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include <fstream>
#include <stdexcept>

namespace clepsydra::tests
{

namespace
{

const std::string caseFolder = "cases/hopperQuick/";

} // namespace

QuickHopper::QuickHopper(const std::map<std::string, std::string>& parameters)
{
    std::string commands =
        "set -euo pipefail\n"
        "mkdir -p cases/hopperQuick\n"
        "ln -s \"$CLEPSYDRA/meshes\" \"$CLEPSYDRA/scripts\" .\n"
        "cd \"$CLEPSYDRA/cases/hopperQuick\"\n"
        "cp -r 0 constant system DEM parameters stage.* Allrun Allclean \"$OLDPWD/cases/hopperQuick\"\n"
        "cd \"$OLDPWD/cases/hopperQuick\"\n"
        // All of Allrun but its last line, which calls main.
        "sed '$d' Allrun > functions\n";
    for (const auto& [name, value] : parameters)
    {
        commands += "grep -q '^" + name + " ' parameters\n";
        commands += "sed -i 's|^" + name + " [^;]*;|" + name + " " + value + ";|' parameters\n";
    }
    folder_.extraFiles["copyCase"] = commands;
    const Outcome copied = folder_.runCommand("bash copyCase");
    if (!copied.succeeded())
    {
        throw std::runtime_error("cannot copy cases/hopperQuick: " + copied.output);
    }
}

Outcome QuickHopper::withAllrun(const std::string& commands)
{
    std::ofstream(folder_.path() / "runCase") << "set -euo pipefail\n"
                                                 "PATH=$(dirname \"$SOLVER\"):$PATH\n"
                                                 "cd "
                                                     + caseFolder + "\n. ./functions\nranks=1\n" + commands;
    return folder_.runCommand("bash runCase");
}

Outcome QuickHopper::pour()
{
    return withAllrun("startAfresh\nmakeMesh\nrunStages pour\nrequireAllBeads\n");
}

Outcome QuickHopper::run(const std::string& stage)
{
    return withAllrun("runStages " + stage + '\n');
}

Outcome QuickHopper::runVariant(const std::string& stage, const std::string& name, const std::string& entries)
{
    return withAllrun("prepareStage " + stage + "\ncp -r stages/" + stage + " stages/" + name + "\ncat >> stages/"
                      + name + "/stage << 'END'\n" + entries + "\nEND\nrunStages " + name + '\n');
}

std::vector<std::vector<double>> QuickHopper::table(const std::string& stage, const std::string& file) const
{
    return folder_.table(caseFolder + "stages/" + stage + "/postProcessing/" + file);
}

nlohmann::json QuickHopper::ledger(const std::string& stage) const
{
    std::ifstream is(folder_.path() / caseFolder / "stages" / stage / "postProcessing/ledger/0/summary.json");
    if (!is)
    {
        throw std::runtime_error("no summary of the ledger of stage " + stage);
    }
    return nlohmann::json::parse(is);
}

std::vector<DrawnBead> QuickHopper::lastBeads(const std::string& stage) const
{
    std::filesystem::path last;
    double latest = -1;
    for (const auto& entry :
        std::filesystem::directory_iterator(folder_.path() / caseFolder / "stages" / stage / "VTK"))
    {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() == ".vtp" && std::stod(name.substr(name.find('_') + 1)) > latest)
        {
            latest = std::stod(name.substr(name.find('_') + 1));
            last = entry.path();
        }
    }
    const auto reader = vtkSmartPointer<vtkXMLPolyDataReader>::New();
    reader->SetFileName(last.c_str());
    reader->Update();
    vtkPolyData& drawn = *reader->GetOutput();
    vtkDataArray* const id = drawn.GetPointData()->GetArray("id");
    std::vector<DrawnBead> beads(static_cast<std::size_t>(drawn.GetNumberOfPoints()));
    for (std::size_t bead = 0; bead < beads.size(); ++bead)
    {
        const auto point = static_cast<vtkIdType>(bead);
        beads[bead].id = static_cast<int>(id->GetTuple1(point));
        drawn.GetPoint(point, beads[bead].position.data());
    }
    return beads;
}

double QuickHopper::parameter(const std::string& name) const
{
    std::ifstream is(folder_.path() / caseFolder / "parameters");
    for (std::string word; is >> word;)
    {
        double value = 0;
        if (word == name && is >> value)
        {
            return value;
        }
    }
    throw std::runtime_error("no number " + name + " in parameters");
}

} // namespace clepsydra::tests
