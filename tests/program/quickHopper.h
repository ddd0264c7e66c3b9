/// \file
/// cases/hopperQuick in a temporary folder, with parameters of one's own: the case's generator, scripts and stages.
#pragma once

#include "support/testCase.h"

#include <map>
#include <string>
#include <vector>

namespace clepsydra::tests
{

/// One bead of a VTK file.
struct DrawnBead
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
    Outcome pour();

    /// Runs one stage of the case.
    Outcome run(const std::string& stage);

    /// Runs a stage under another name, with more entries in its file `stage`.
    Outcome runVariant(const std::string& stage, const std::string& name, const std::string& entries);

    /// Rows of postProcessing/<observable>/0/<file> of a stage.
    std::vector<std::vector<double>> table(const std::string& stage, const std::string& file) const;

    /// postProcessing/ledger/0/summary.json of a stage.
    nlohmann::json ledger(const std::string& stage) const;

    /// Beads in the last VTK file of a stage, by the order in the file.
    std::vector<DrawnBead> lastBeads(const std::string& stage) const;

    /// A number of the case's file `parameters`, overrides included.
    double parameter(const std::string& name) const;

private:
    /// Runs commands in the case, after the functions of its Allrun.
    Outcome withAllrun(const std::string& commands);

    TestCase folder_;
};

} // namespace clepsydra::tests
