#pragma once

#include <Eigen/Dense>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace clepsydra::tests
{

/// A dictionary file of OpenFOAM, as entries that a test overrides by name. An entry in a sub-dictionary is named by
/// its path: "DEM/variables/dt". Values are the text before the semicolon.
class FoamFile
{
public:
    explicit FoamFile(std::string foamClass = "dictionary")
        : foamClass_(std::move(foamClass))
    {}

    /// Replaces the entry or adds it at the end.
    FoamFile& set(const std::string& path, const std::string& value);
    FoamFile& set(const std::string& path, double value);

    /// Removes the entry, or all of a sub-dictionary.
    FoamFile& remove(const std::string& path);

    std::string text(const std::string& object) const;

private:
    std::string foamClass_;
    std::vector<std::pair<std::string, std::string>> entries_;
};

/// "(x y z)"
std::string vectorText(const Eigen::Vector3d& v);

/// The values in the cells of an ascii field file of OpenFOAM, components x cells; a uniform field has one column.
/// \throws std::runtime_error
Eigen::MatrixXd readInternalField(const std::filesystem::path& file);

} // namespace clepsydra::tests
