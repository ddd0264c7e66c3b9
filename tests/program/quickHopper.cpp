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

const std::string caseFolder = "cases/tutorials/hopperQuick/";

} // namespace

QuickHopper::QuickHopper(const std::map<std::string, std::string>& parameters)
{
    std::string commands =
        "set -euo pipefail\n"
        "mkdir -p cases/tutorials/hopperQuick\n"
        "ln -s \"$CLEPSYDRA/meshes\" \"$CLEPSYDRA/scripts\" .\n"
        "cd \"$CLEPSYDRA/cases/tutorials/hopperQuick\"\n"
        "cp -r 0 constant system DEM parameters parameters.rules template.yaml step.* Allrun Allclean "
        "\"$OLDPWD/cases/tutorials/hopperQuick\"\n"
        "cd \"$OLDPWD/cases/tutorials/hopperQuick\"\n";
    for (const auto& [name, value] : parameters)
    {
        commands += "grep -q '^" + name + " ' parameters\n";
        commands += "sed -i 's|^" + name + " [^;]*;|" + name + " " + value + ";|' parameters\n";
    }
    folder_.extraFiles["copyCase"] = commands;
    const Outcome copied = folder_.runCommand("bash copyCase");
    if (!copied.succeeded())
    {
        throw std::runtime_error("cannot copy cases/tutorials/hopperQuick: " + copied.output);
    }
}

Outcome QuickHopper::inCase(const std::string& commands)
{
    std::ofstream(folder_.path() / "runCase") << "set -euo pipefail\n"
                                                 "CLEPSYDRA_BUILD=$(dirname \"$(dirname \"$SOLVER\")\")\n"
                                                 "export CLEPSYDRA_BUILD\n"
                                                 "cd "
                                                     + caseFolder + '\n' + commands;
    return folder_.runCommand("bash runCase");
}

Outcome QuickHopper::filling()
{
    return inCase("./Allrun -np 1 mesh filling\n");
}

Outcome QuickHopper::run(const std::string& step)
{
    return inCase("./Allrun -np 1 " + step + '\n');
}

Outcome QuickHopper::runVariant(const std::string& step, const std::string& name, const std::string& entries)
{
    return inCase("./Allrun -np 1 -prepare " + step + "\ncp -r steps/" + step + " steps/" + name + "\ncat >> steps/"
                  + name + "/step << 'END'\n" + entries + "\nEND\n./Allrun -np 1 " + name + '\n');
}

std::vector<std::vector<double>> QuickHopper::table(const std::string& step, const std::string& file) const
{
    return folder_.table(caseFolder + "steps/" + step + "/postProcessing/" + file);
}

nlohmann::json QuickHopper::conservation(const std::string& step) const
{
    std::ifstream is(folder_.path() / caseFolder / "steps" / step / "postProcessing/conservation/0/summary.json");
    if (!is)
    {
        throw std::runtime_error("no summary of the conservation check of step " + step);
    }
    return nlohmann::json::parse(is);
}

std::vector<DrawnParticle> QuickHopper::lastParticles(const std::string& step) const
{
    std::filesystem::path last;
    double latest = -1;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / caseFolder / "steps" / step / "VTK"))
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
    std::vector<DrawnParticle> particles(static_cast<std::size_t>(drawn.GetNumberOfPoints()));
    for (std::size_t particle = 0; particle < particles.size(); ++particle)
    {
        const auto point = static_cast<vtkIdType>(particle);
        particles[particle].id = static_cast<int>(id->GetTuple1(point));
        drawn.GetPoint(point, particles[particle].position.data());
    }
    return particles;
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
