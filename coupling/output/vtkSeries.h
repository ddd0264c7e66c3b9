#pragma once

#include <filesystem>
#include <map>

namespace clepsydra
{

/// A ParaView collection (.pvd): a list of files with their times. Local.
class VtkSeries
{
public:
    /// Continues the series in `file` where there is one. Entries up to `startTime` [s] whose files exist are kept;
    /// later ones belong to a run that is being overwritten.
    VtkSeries(std::filesystem::path file, double startTime);

    /// Adds `dataFile`, a path relative to the series, and replaces an entry of the same time. The file of the series
    /// is replaced as a whole, so a program that reads it sees either the old or the new one.
    /// \throws std::runtime_error or std::filesystem::filesystem_error that names the file where it cannot be written
    void add(double time, const std::filesystem::path& dataFile);

private:
    void read(double startTime);
    void write() const;

    std::filesystem::path file_;
    std::map<double, std::filesystem::path> entries_;
};

} // namespace clepsydra
