#pragma once

#include <filesystem>
#include <map>

namespace clepsydra
{

/// A ParaView collection (.pvd): which file shows which time. Local.
class VtkSeries
{
public:
    /// Goes on with the series in `file` where there is one: its entries up to `startTime` [s] whose files exist stay,
    /// later ones belong to a run that is being overwritten.
    VtkSeries(std::filesystem::path file, double startTime);

    /// Adds `dataFile`, a path relative to the series, in place of the entry of the same time if there is one. The
    /// series is replaced as a whole: whoever reads it meanwhile sees the old one or the new one.
    /// \throws std::runtime_error or std::filesystem::filesystem_error naming the file where it cannot be written.
    void add(double time, const std::filesystem::path& dataFile);

private:
    void read(double startTime);
    void write() const;

    std::filesystem::path file_;
    std::map<double, std::filesystem::path> entries_;
};

} // namespace clepsydra
