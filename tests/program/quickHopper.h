/// \file
/// cases/tutorials/hopperQuick in a temporary folder, with parameters of one's own: the case's generator, scripts and steps.
#pragma once

#include "support/testCase.h"

#include <map>
#include <string>
#include <vector>

namespace clepsydra::tests
{

/// One particle of a VTK file.
struct DrawnParticle
{
    int id = 0;
    Eigen::Vector3d position;
};

class QuickHopper
{
public:
    /// \param parameters  entries of the case's file `parameters` that differ, name -> value
    explicit QuickHopper(const std::map<std::string, std::string>& parameters);

    /// Mesh and packing. Call first.
    Outcome filling();

    /// Runs one step of the case.
    Outcome run(const std::string& step);

    /// Runs a step under another name, with more entries in its file `step`.
    Outcome runVariant(const std::string& step, const std::string& name, const std::string& entries);

    /// Rows of postProcessing/<observable>/0/<file> of a step.
    std::vector<std::vector<double>> table(const std::string& step, const std::string& file) const;

    /// postProcessing/conservation/0/summary.json of a step.
    nlohmann::json conservation(const std::string& step) const;

    /// Particles in the last VTK file of a step, by the order in the file.
    std::vector<DrawnParticle> lastParticles(const std::string& step) const;

    /// A number of the case's file `parameters`, overrides included.
    double parameter(const std::string& name) const;

private:
    /// Runs commands in the case; its Allrun starts the solver that is tested.
    Outcome inCase(const std::string& commands);

    TestCase folder_;
};

} // namespace clepsydra::tests
